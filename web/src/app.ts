// SPDX-License-Identifier: Apache-2.0
import { type Box3, Vector3 } from "three";
import { element, saveAs } from "./dom.ts";
import { Devices } from "./input/devices.ts";
import { Drag } from "./input/drag.ts";
import { listenForKeys } from "./input/keys.ts";
import { PointerInput } from "./input/pointer.ts";
import { RateHand } from "./input/rate_hand.ts";
import { Banner, Toasts } from "./panels/banner.ts";
import { ExplodePanel } from "./panels/explode_panel.ts";
import { ExportDialog } from "./panels/export_dialog.ts";
import { GuidePanel } from "./panels/guide_panel.ts";
import { helpDialog } from "./panels/help.ts";
import { Inspector } from "./panels/inspector.ts";
import { Measure } from "./panels/measure.ts";
import { OpenDialog } from "./panels/open_dialog.ts";
import { PlanPanel } from "./panels/plan_panel.ts";
import { SectionPanel } from "./panels/section_panel.ts";
import { StatusLine } from "./panels/status.ts";
import { TimelinePanel } from "./panels/timeline.ts";
import { Toolbar } from "./panels/toolbar.ts";
import { TreePanel } from "./panels/tree.ts";
import { Gizmo } from "./scene/gizmo.ts";
import type { Arrow } from "./scene/marks.ts";
import { kStereoModes } from "./scene/stereo.ts";
import { Viewport, type ViewportOptions } from "./scene/viewport.ts";
import { Session } from "./session.ts";
import { text } from "./strings.ts";
import { ThemeSwitch } from "./theme.ts";
import type { Triple } from "./wire/messages.ts";
import { Headset } from "./xr/headset.ts";

/// [px]
const kReasonArrow = 64;

/// The page: its parts, and what its buttons and keys do.
export class App {
  readonly viewport: Viewport;
  readonly session: Session;
  readonly drag: Drag;
  readonly gizmo = new Gizmo();
  readonly actions = this.makeActions();

  private readonly pointer: PointerInput;
  private readonly rateHand: RateHand;
  private readonly devices: Devices;
  private readonly inspector: Inspector;
  private readonly tree: TreePanel;
  private readonly timeline: TimelinePanel;
  private readonly sections: SectionPanel;
  private readonly measure: Measure;
  private readonly explode: ExplodePanel;
  readonly plan: PlanPanel;
  private readonly openDialog: OpenDialog;
  private readonly exports: ExportDialog;
  private readonly help = helpDialog();
  private readonly toasts = new Toasts();
  private readonly theme: ThemeSwitch;
  readonly headset: Headset;

  constructor(options: ViewportOptions) {
    const canvas = element("canvas", {
      id: "view",
      tabIndex: 0,
      role: "application",
      "aria-label": text("view.label"),
    });
    const stage = element("main", { id: "stage" }, canvas);
    document.body.append(stage);
    this.viewport = new Viewport(canvas, options);
    this.session = new Session(this.viewport);
    this.drag = new Drag(this.session);
    this.pointer = new PointerInput(this.session, this.drag, this.gizmo);
    this.rateHand = new RateHand(this.session, this.drag);
    this.devices = new Devices(this.rateHand, (sentence) => this.toasts.show("note", sentence));
    this.inspector = new Inspector(this.session, this.drag);
    this.tree = new TreePanel(this.session);
    this.timeline = new TimelinePanel(this.session);
    this.sections = new SectionPanel(this.session);
    this.measure = new Measure(this.session);
    this.explode = new ExplodePanel(this.session);
    this.plan = new PlanPanel(this.session);
    this.openDialog = new OpenDialog(this.session);
    this.exports = new ExportDialog(this.session);
    stage.append(
      new Banner(this.session).node,
      this.sections.node,
      this.explode.node,
      this.plan.node,
      this.measure.node,
      this.toasts.node,
    );
    document.body.prepend(new Toolbar(this).node, this.tree.node);
    document.body.append(
      this.inspector.node,
      new GuidePanel(this.session).node,
      this.timeline.node,
      new StatusLine(this.session).node,
    );
    document.body.append(this.openDialog.node, this.exports.node, this.help);
    this.connectParts();
    this.theme = new ThemeSwitch(this.viewport);
    this.headset = new Headset(this.session, this.drag, this.actions);
    this.session.connection.connect();
  }

  /// Keeps a drag to a world axis, or lets go of it.
  lockAxis(axis: 0 | 1 | 2): void {
    this.pointer.axisLock = this.pointer.axisLock === axis ? null : axis;
    const lock = this.pointer.axisLock;
    this.session.change(() => {
      this.session.store.dragHint = lock === null ? "" : text("drag.locked", { axis: "XYZ"[lock] });
    });
  }

  private connectParts(): void {
    const { session, viewport } = this;
    session.onNote = (level, sentence) => this.toasts.show(level, sentence);
    session.onModel = () => viewport.rig.fit(viewport.model!.bounds(), new Vector3(1, -1.6, 0.9));
    this.pointer.onClick = (pick) => this.measure.click(pick);
    viewport.scene.add(this.gizmo.object);
    viewport.beforePicture.push(() => this.placeMarks());
    session.notifier.subscribe(() => {
      if (this.drag.active && (session.store.link === "lost" || session.store.state?.hand === null) && this.drag.held)
        this.drag.drop();
    });
    listenForKeys(this);
  }

  /// Puts the gizmo and the arrows of free directions where the selection is.
  private placeMarks(): boolean {
    const { store } = this.session;
    const { model } = this.viewport;
    const shown = store.selection.filter((c) => model?.components[c]?.visible);
    const box = shown.length > 0 ? model!.boundsOf(shown) : null;
    const center = box?.getCenter(new Vector3()) ?? null;
    this.gizmo.place(store.gizmo && store.control ? center : null);
    this.gizmo.update(this.viewport.rig);
    const mine = center && store.directions?.components.join() === store.selection.join();
    const free = mine ? store.directions!.directions.filter((way) => way.free) : [];
    const idle = store.state?.automatic == null && store.state?.playback == null;
    this.viewport.directions.arrows = idle && box ? free.map(({ direction }) => arrowOutOf(box, direction)) : [];
    this.viewport.blocked.arrows = this.arrowsOfReason();
    return false;
  }

  /// Into what is in the way, where it is met.
  private arrowsOfReason(): Arrow[] {
    const { reason } = this.session;
    if (!reason) return [];
    const direction = new Vector3(...reason.direction);
    return reason.blockers.map(({ point: met }) => {
      const point = new Vector3(...met);
      const back = -kReasonArrow * this.viewport.rig.pixelSize(point);
      return { point: point.addScaledVector(direction, back), direction, length: kReasonArrow };
    });
  }

  private async findPath(): Promise<void> {
    if (this.drag.active) await this.drag.end();
    await this.session.findPath();
  }

  private makeActions() {
    const selected = () => ({ components: this.session.store.selection });
    const withSelection = (name: "take_out" | "put_back") => () => {
      if (selected().components.length > 0) void this.session.ask(name, selected());
    };
    return {
      open: () => this.openDialog.open(),
      save: () => void this.save(),
      export: () => this.exports.open(),
      undo: () => void (this.drag.active ? this.drag.undo() : this.session.ask("undo", {})),
      redo: () => void this.session.ask("redo", {}),
      reset: () => void this.session.ask("reset", {}),
      gizmo: () =>
        this.session.change(() => {
          this.session.store.gizmo = !this.session.store.gizmo;
        }),
      section: () => this.sections.toggle(),
      measure: () => this.measure.toggle(),
      explode: () => this.explode.toggle(),
      plan: () => this.plan.toggle(),
      findPath: () => void this.findPath(),
      why: () => void this.session.askWhy(),
      projection: () =>
        this.session.change(() => {
          this.viewport.rig.orthographic = !this.viewport.rig.orthographic;
        }),
      stereo: () =>
        this.session.change(() => {
          const next = (kStereoModes.indexOf(this.viewport.stereo) + 1) % kStereoModes.length;
          this.viewport.stereo = kStereoModes[next];
        }),
      wholeScreen: () =>
        void (document.fullscreenElement
          ? document.exitFullscreen()
          : this.viewport.canvas.parentElement!.requestFullscreen()),
      fit: () => this.fit(),
      screenshot: () => void this.viewport.screenshot().then((picture) => saveAs(picture, `${this.fileStem()}.png`)),
      theme: () => this.theme.toggle(),
      help: () => this.help.showModal(),
      play: () => this.timeline.toggle(),
      nextStep: () => this.timeline.step(1),
      previousStep: () => this.timeline.step(-1),
      directions: () => void this.inspector.find(),
      takeOut: withSelection("take_out"),
      putBack: withSelection("put_back"),
      isolate: () => this.session.toggleIsolated(),
      toggleHidden: () => this.session.toggleHidden(),
      device: () => void this.devices.choose(),
      headset: () => void this.headset.enter(),
      search: () => this.tree.focusSearch(),
      escape: () => this.escape(),
    };
  }

  private escape(): void {
    const { store } = this.session;
    if (this.drag.active) void this.drag.cancel();
    else if (this.rateHand.holds) void this.rateHand.cancel();
    else if (store.state?.automatic != null) void this.session.ask("halt", {});
    else if (store.measuring) this.measure.toggle();
    else if (store.directions)
      this.session.change(() => {
        store.directions = null;
      });
    else this.session.select([]);
  }

  private fit(): void {
    const { selection } = this.session.store;
    const { model, rig } = this.viewport;
    if (model) rig.fit(selection.length > 0 ? model.boundsOf(selection) : model.bounds());
  }

  private async save(): Promise<void> {
    try {
      const answer = await this.session.connection.request("/api/path.json");
      saveAs(await answer.blob(), `${this.fileStem()}.path.json`);
      this.toasts.show("note", text("saved"));
    } catch (error) {
      this.toasts.show("warning", (error as Error).message);
    }
  }

  private fileStem(): string {
    return (this.session.store.model?.name ?? "dismantle").replace(/\.\w+$/, "");
  }
}

/// An arrow from the side of a box that lies in a direction.
function arrowOutOf(box: Box3, direction: Triple): Arrow {
  const way = new Vector3(...direction);
  const half = box.getSize(new Vector3()).multiplyScalar(0.5);
  const reach = Math.min(...[0, 1, 2].map((k) => half.getComponent(k) / Math.max(1e-9, Math.abs(direction[k]))));
  return { point: box.getCenter(new Vector3()).addScaledVector(way, reach), direction: way, length: 80 };
}
