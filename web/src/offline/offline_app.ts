// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { button, element, saveAs, setText } from "../dom.ts";
import { Drag } from "../input/drag.ts";
import { type Keyed, listenForKeys } from "../input/keys.ts";
import { PointerInput } from "../input/pointer.ts";
import { Toasts } from "../panels/banner.ts";
import { helpDialog } from "../panels/help.ts";
import { Measure } from "../panels/measure.ts";
import { SectionPanel } from "../panels/section_panel.ts";
import { TimelinePanel } from "../panels/timeline.ts";
import { TreePanel } from "../panels/tree.ts";
import { Gizmo } from "../scene/gizmo.ts";
import { Viewport, type ViewportOptions } from "../scene/viewport.ts";
import { Session } from "../session.ts";
import { kOfflineHelp, text } from "../strings.ts";
import { ThemeSwitch } from "../theme.ts";
import { OfflineBanner } from "./offline_banner.ts";
import { type Film, PathPlayer } from "./path_player.ts";
import { StepsPanel } from "./steps_panel.ts";

/// The page that needs no server: the viewer's parts, with a path that is played in the engine's place.
export class OfflineApp implements Keyed {
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
    private readonly film: Film,
  ) {
    document.documentElement.toggleAttribute("data-offline", true);
    const label = text("offline.view");
    const canvas = element("canvas", { id: "view", tabIndex: 0, role: "application", "aria-label": label });
    const stage = element("main", { id: "stage" }, canvas);
    document.body.append(stage);
    this.viewport = new Viewport(canvas, options);
    this.player = new PathPlayer(film);
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

    stage.append(new OfflineBanner(this.session).node, this.sections.node, this.measure.node, this.toasts.node);
    document.body.prepend(this.toolbar(), this.tree.node);
    document.body.append(this.steps.node, this.timeline.node, this.help);
    document.title = `${film.model.name} – ${text("title")}`;
    pointer.onClick = (pick) => this.measure.click(pick);
    this.session.onNote = (level, sentence) => this.toasts.show(level, sentence);
    this.session.onModel = () => this.viewport.rig.fit(this.viewport.model!.bounds(), new Vector3(1, -1.6, 0.9));
    listenForKeys(this);
    this.player.connect();
  }

  private makeActions() {
    return {
      fit: () => this.fit(),
      projection: () => {
        this.viewport.rig.orthographic = !this.viewport.rig.orthographic;
      },
      wholeScreen: () =>
        void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen()),
      section: () => this.sections.toggle(),
      measure: () => this.measure.toggle(),
      theme: () => this.theme.toggle(),
      help: () => this.help.showModal(),
      play: () => this.timeline.toggle(),
      nextStep: () => this.steps.go(1),
      previousStep: () => this.steps.go(-1),
      isolate: () => this.session.toggleIsolated(),
      toggleHidden: () => this.session.toggleHidden(),
      search: () => this.tree.focusSearch(),
      escape: () => (this.session.store.measuring ? this.measure.toggle() : this.session.select([])),
      screenshot: () => void this.viewport.screenshot().then((picture) => saveAs(picture, `${this.stem()}.png`)),
    };
  }

  private toolbar(): HTMLElement {
    const { actions } = this;
    const group = (...children: Node[]) => element("div", { class: "group" }, ...children);
    const name = element("span", { class: "model-name" });
    setText(name, this.film.model.name);
    return element(
      "header",
      { id: "toolbar", role: "toolbar", "aria-label": text("toolbar.label") },
      element("span", { class: "brand" }, text("title")),
      group(
        button({ icon: "section", label: text("section"), key: "S", id: "section", press: actions.section }),
        button({ icon: "measure", label: text("measure"), key: "M", id: "measure", press: actions.measure }),
      ),
      group(
        button({ icon: "fit", label: text("fit"), key: "F", id: "fit", press: actions.fit }),
        button({
          icon: "parallel",
          label: text("projection"),
          key: "O",
          id: "projection",
          press: actions.projection,
        }),
      ),
      name,
      group(
        button({ icon: "camera", label: text("screenshot"), id: "screenshot", press: actions.screenshot }),
        button({ icon: "theme", label: text("theme"), key: "T", id: "theme", press: actions.theme }),
        button({ icon: "help", label: text("help"), key: "H", id: "help", press: actions.help }),
      ),
    );
  }

  private fit(): void {
    const { selection } = this.session.store;
    const { model, rig } = this.viewport;
    if (model) rig.fit(selection.length > 0 ? model.boundsOf(selection) : model.bounds());
  }

  private stem(): string {
    return this.film.model.name.replace(/\.\w+$/, "");
  }
}
