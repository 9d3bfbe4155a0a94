// SPDX-License-Identifier: Apache-2.0

import type { App } from "../app.ts";
import { element, setText } from "../dom.ts";
import { hasHid } from "../input/devices.ts";
import { text } from "../strings.ts";
import type { Response } from "../wire/messages.ts";
import { hasHeadset } from "../xr/headset.ts";
import { type ToolName, toolButton, toolbarNode, toolGroup, unitButton } from "./tool_button.ts";

const kResponses: Response[] = ["slide", "touch", "stop"];

type ToggledTool = "section" | "measure" | "explode" | "plan" | "gizmo" | "projection" | "stereo";

/// The toolbar at the top of the page.
export class Toolbar {
  readonly node: HTMLElement;
  private readonly name = element("span", { class: "model-name" });
  private readonly buttons: Record<"undo" | "redo" | "save" | "export" | "reset" | ToggledTool, HTMLButtonElement>;
  private readonly responses: Map<Response, HTMLInputElement>;
  private readonly headset: HTMLButtonElement;
  /// The response that was chosen and not confirmed yet: states that come meanwhile are older.
  private chosen: Response | null = null;

  constructor(private readonly app: App) {
    const tool = (id: ToolName) => toolButton(id, app.actions[id]);
    this.buttons = {
      undo: tool("undo"),
      redo: tool("redo"),
      gizmo: tool("gizmo"),
      section: tool("section"),
      measure: tool("measure"),
      explode: tool("explode"),
      plan: tool("plan"),
      projection: tool("projection"),
      stereo: tool("stereo"),
      export: tool("export"),
      save: tool("save"),
      reset: tool("reset"),
    };
    this.headset = tool("headset");
    this.headset.hidden = true;
    void hasHeadset().then((available) => {
      this.headset.hidden = !available;
    });
    this.responses = new Map(kResponses.map((response) => [response, this.radio(response)]));
    const { undo, redo, gizmo, section, measure, explode, plan, projection, save, reset, stereo } = this.buttons;
    const units = unitButton(app.session.notifier, app.actions.units);
    this.node = toolbarNode(
      toolGroup(tool("open"), save, this.buttons.export),
      toolGroup(undo, redo, reset),
      this.responseSwitch(),
      toolGroup(gizmo, section, measure, explode, plan),
      toolGroup(tool("fit"), projection, stereo),
      this.name,
      toolGroup(this.headset, hasHid() ? tool("device") : null, tool("screenshot"), units, tool("theme"), tool("help")),
    );
    app.session.notifier.subscribe(() => this.update());
  }

  private radio(response: Response): HTMLInputElement {
    const press = async () => {
      this.chosen = response;
      try {
        await this.app.session.send("set_response", { response });
      } finally {
        if (this.chosen === response) this.chosen = null;
        this.update();
      }
    };
    return element("input", {
      type: "radio",
      name: "response",
      value: response,
      id: `response-${response}`,
      onchange: press,
    });
  }

  private responseSwitch(): HTMLElement {
    const choices = kResponses.map((response) =>
      element(
        "label",
        { title: text(`response.${response}.long`) },
        this.responses.get(response)!,
        element("span", {}, text(`response.${response}`)),
      ),
    );
    return element(
      "fieldset",
      { class: "segments", id: "response" },
      element("legend", { class: "visually-hidden" }, text("response")),
      ...choices,
    );
  }

  private update(): void {
    const { state, model, control, gizmo, planes, measuring, exploding } = this.app.session.store;
    const busy = !control || state?.automatic != null || state?.playback != null;
    const { buttons } = this;
    buttons.undo.disabled = busy || (state?.undo == null && !this.app.drag.active);
    buttons.redo.disabled = busy || state?.redo == null;
    buttons.undo.title = state?.undo ? text("undo.of", { move: state.undo }) : text("undo");
    buttons.redo.title = state?.redo ? text("redo.of", { move: state.redo }) : text("redo");
    buttons.export.disabled = !state;
    buttons.save.disabled = !state || state.moves.length === 0;
    buttons.reset.disabled = busy || !state || state.hand != null || state.moves.length === 0;
    const { rig, stereo } = this.app.viewport;
    const pressed: Record<ToggledTool, boolean> = {
      gizmo,
      section: planes.length > 0,
      measure: measuring,
      explode: exploding,
      plan: this.app.plan.opened,
      projection: rig.orthographic,
      stereo: stereo !== "off",
    };
    for (const tool of Object.keys(pressed) as ToggledTool[])
      buttons[tool].setAttribute("aria-pressed", String(pressed[tool]));
    buttons.plan.disabled = !state;
    buttons.stereo.title = text(`stereo.${stereo}`);
    this.headset.disabled = !state;
    this.headset.setAttribute("aria-pressed", String(this.app.headset.active));
    for (const [response, radio] of this.responses) {
      radio.checked = (this.chosen ?? state?.response ?? "slide") === response;
      radio.disabled = !control || !state?.responses.includes(response);
    }
    setText(this.name, model?.name ?? "");
    document.title = model ? `${model.name} – ${text("title")}` : text("title");
  }
}
