// SPDX-License-Identifier: Apache-2.0
import { element, makeStage, saveAs } from "../dom.ts";
import { kOfflineHelp } from "../help_texts.ts";
import { Drag } from "../input/drag.ts";
import { type KeyTarget, listenForKeys } from "../input/keys.ts";
import { PointerInput } from "../input/pointer.ts";
import { Toasts } from "../panels/banner.ts";
import { helpDialog } from "../panels/help.ts";
import { Measure } from "../panels/measure.ts";
import { SectionPanel } from "../panels/section_panel.ts";
import { TimelinePanel } from "../panels/timeline.ts";
import { type ToolName, toolButton, toolbarNode, toolGroup, unitButton } from "../panels/tool_button.ts";
import { TreePanel } from "../panels/tree.ts";
import { Gizmo } from "../scene/gizmo.ts";
import { Viewport, type ViewportOptions } from "../scene/viewport.ts";
import { Session } from "../session.ts";
import { text } from "../strings.ts";
import { ThemeSwitch } from "../theme.ts";
import { OfflineBanner } from "./offline_banner.ts";
import { type OfflineContent, PathPlayer } from "./path_player.ts";
import { StepsPanel } from "./steps_panel.ts";

/// The exported page, which needs no server: the viewer's parts, with a path player in place of the engine.
export class OfflineApp implements KeyTarget {
  readonly viewport: Viewport;
  readonly session: Session;
  readonly drag: Drag;
  readonly player: PathPlayer;
  readonly actions: ReturnType<OfflineApp["makeActions"]>;

  private readonly tree: TreePanel;
  private readonly timeline: TimelinePanel;
  private readonly sections: SectionPanel;
  private readonly measure: Measure;
  private readonly steps: StepsPanel;
  private readonly theme: ThemeSwitch;
  private readonly help = helpDialog(kOfflineHelp);
  private readonly toasts = new Toasts();

  constructor(
    options: ViewportOptions,
    private readonly content: OfflineContent,
  ) {
    document.documentElement.toggleAttribute("data-offline", true);
    const { stage, canvas } = makeStage(text("offline.view"));
    this.viewport = new Viewport(canvas, options);
    this.player = new PathPlayer(content);
    this.session = new Session(this.viewport, this.player);
    this.drag = new Drag(this.session);
    const pointer = new PointerInput(this.session, this.drag, new Gizmo());
    this.tree = new TreePanel(this.session);
    this.timeline = new TimelinePanel(this.session);
    this.sections = new SectionPanel(this.session);
    this.measure = new Measure(this.session);
    this.steps = new StepsPanel(this.session, this.player);
    this.theme = new ThemeSwitch(this.viewport);
    this.actions = this.makeActions();

    stage.append(new OfflineBanner(this.session).node, this.measure.node, pointer.boxNode, this.toasts.node);
    document.body.prepend(this.toolbar(), this.tree.node);
    document.body.append(
      element("div", { id: "side" }, this.sections.node, this.steps.node),
      this.timeline.node,
      this.help,
    );
    document.title = `${content.model.name} – ${text("title")}`;
    pointer.onClick = (pick) => this.sections.click(pick) || this.measure.click(pick);
    pointer.onHover = (pick) => this.measure.hover(pick);
    this.session.onNote = (level, message) => this.toasts.show(level, message);
    listenForKeys(this);
    this.player.connect();
  }

  private makeActions() {
    return {
      fit: () => this.session.fitView(),
      projection: () => {
        this.viewport.rig.orthographic = !this.viewport.rig.orthographic;
      },
      fullScreen: () =>
        void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen()),
      section: () => this.sections.toggle(),
      measure: () => this.measure.toggle(),
      theme: () => this.theme.toggle(),
      units: () => this.session.toggleUnit(),
      help: () => this.help.showModal(),
      play: () => this.timeline.toggle(),
      nextStep: () => this.steps.go(1),
      previousStep: () => this.steps.go(-1),
      isolate: () => this.session.toggleIsolated(),
      toggleHidden: () => this.session.toggleHidden(),
      search: () => this.tree.focusSearch(),
      escape: () => (this.session.store.measuring ? this.measure.toggle() : this.session.select([])),
      screenshot: () =>
        void this.viewport.screenshot().then((picture) => saveAs(picture, `${this.session.fileStem}.png`)),
    };
  }

  private toolbar(): HTMLElement {
    const group = (...tools: (ToolName & keyof typeof this.actions)[]) =>
      toolGroup(...tools.map((tool) => toolButton(tool, this.actions[tool])));
    return toolbarNode(
      group("section", "measure"),
      group("fit", "projection"),
      element("span", { class: "model-name" }, this.content.model.name),
      toolGroup(unitButton(this.session.notifier, this.actions.units)),
      group("screenshot", "theme", "help"),
    );
  }
}
