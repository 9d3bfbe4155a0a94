// SPDX-License-Identifier: Apache-2.0

import type { App } from "../app.ts";
import { button, element, setText } from "../dom.ts";
import { hasHid } from "../input/devices.ts";
import { text } from "../strings.ts";
import type { Response } from "../wire/messages.ts";
import { hasHeadset } from "../xr/headset.ts";

const kResponses: Response[] = ["slide", "touch", "stop"];

/// The line at the top.
export class Toolbar {
  readonly node: HTMLElement;
  private readonly name = element("span", { class: "model-name" });
  private readonly buttons: Record<
    | "undo"
    | "redo"
    | "section"
    | "measure"
    | "explode"
    | "plan"
    | "gizmo"
    | "projection"
    | "stereo"
    | "save"
    | "exports"
    | "reset",
    HTMLButtonElement
  >;
  private readonly responses: Map<Response, HTMLInputElement>;
  private readonly headset: HTMLButtonElement;

  constructor(private readonly app: App) {
    const { actions } = app;
    this.buttons = {
      undo: button({ icon: "undo", label: text("undo"), key: "Ctrl+Z", id: "undo", press: actions.undo }),
      redo: button({ icon: "redo", label: text("redo"), key: "Ctrl+Y", id: "redo", press: actions.redo }),
      gizmo: button({ icon: "move", label: text("gizmo"), key: "G", id: "gizmo", press: actions.gizmo }),
      section: button({ icon: "section", label: text("section"), key: "S", id: "section", press: actions.section }),
      measure: button({ icon: "measure", label: text("measure"), key: "M", id: "measure", press: actions.measure }),
      explode: button({ icon: "explode", label: text("explode"), key: "E", id: "explode", press: actions.explode }),
      plan: button({ icon: "route", label: text("plan"), key: "L", id: "plan", press: actions.plan }),
      projection: button({
        icon: "parallel",
        label: text("projection"),
        key: "O",
        id: "projection",
        press: actions.projection,
      }),
      stereo: button({ icon: "glasses", label: text("stereo"), key: "V", id: "stereo", press: actions.stereo }),
      exports: button({ icon: "share", label: text("export"), id: "export", press: actions.export }),
      save: button({ icon: "save", label: text("save"), id: "save", press: actions.save }),
      reset: button({ icon: "reset", label: text("reset"), id: "reset", press: actions.reset }),
    };
    this.headset = button({ icon: "headset", label: text("headset"), id: "headset", press: actions.headset });
    this.headset.hidden = true;
    void hasHeadset().then((there) => {
      this.headset.hidden = !there;
    });
    this.responses = new Map(kResponses.map((response) => [response, this.radio(response)]));
    const { undo, redo, gizmo, section, measure, explode, plan, projection, save, exports, reset, stereo } =
      this.buttons;
    const group = (...children: (Node | null)[]) => element("div", { class: "group" }, ...children);
    this.node = element(
      "header",
      { id: "toolbar", role: "toolbar", "aria-label": text("toolbar.label") },
      element("span", { class: "brand" }, text("title")),
      group(button({ icon: "open", label: text("open"), id: "open", wide: true, press: actions.open }), save, exports),
      group(undo, redo, reset),
      this.responseSwitch(),
      group(gizmo, section, measure, explode, plan),
      group(button({ icon: "fit", label: text("fit"), key: "F", id: "fit", press: actions.fit }), projection, stereo),
      this.name,
      group(
        this.headset,
        hasHid() ? button({ icon: "puck", label: text("device"), id: "device", press: actions.device }) : null,
        button({ icon: "camera", label: text("screenshot"), id: "screenshot", press: actions.screenshot }),
        button({ icon: "theme", label: text("theme"), key: "T", id: "theme", press: actions.theme }),
        button({ icon: "help", label: text("help"), key: "H", id: "help", press: actions.help }),
      ),
    );
    app.session.notifier.subscribe(() => this.update());
  }

  private radio(response: Response): HTMLInputElement {
    const press = () => void this.app.session.ask("set_response", { response });
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
    buttons.undo.title = state?.undo ? text("undo.of", { what: state.undo }) : text("undo");
    buttons.redo.title = state?.redo ? text("redo.of", { what: state.redo }) : text("redo");
    buttons.exports.disabled = !state;
    buttons.save.disabled = !state || state.moves.length === 0;
    buttons.reset.disabled = busy || !state || state.hand != null || state.moves.length === 0;
    buttons.gizmo.setAttribute("aria-pressed", String(gizmo));
    buttons.section.setAttribute("aria-pressed", String(planes.length > 0));
    buttons.measure.setAttribute("aria-pressed", String(measuring));
    buttons.explode.setAttribute("aria-pressed", String(exploding));
    this.headset.disabled = !state;
    this.headset.setAttribute("aria-pressed", String(this.app.headset.active));
    buttons.plan.disabled = !state;
    buttons.plan.setAttribute("aria-pressed", String(this.app.plan.opened));
    buttons.projection.setAttribute("aria-pressed", String(this.app.viewport.rig.orthographic));
    const { stereo } = this.app.viewport;
    buttons.stereo.setAttribute("aria-pressed", String(stereo !== "off"));
    buttons.stereo.title = text(`stereo.${stereo}`);
    for (const [response, radio] of this.responses) {
      radio.checked = (state?.response ?? "slide") === response;
      radio.disabled = !control || !state;
    }
    setText(this.name, model?.name ?? "");
    document.title = model ? `${model.name} – ${text("title")}` : text("title");
  }
}
