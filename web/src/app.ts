// SPDX-License-Identifier: Apache-2.0
import { type Box3, Vector3 } from "three";
import { type Axis, kAxes, kAxisNames } from "./axes.ts";
import { element, makeStage, saveAs } from "./dom.ts";
import { Devices } from "./input/devices.ts";
import { Drag } from "./input/drag.ts";
import { listenForKeys } from "./input/keys.ts";
import { PointerInput } from "./input/pointer.ts";
import { RateControl } from "./input/rate_control.ts";
import { Banner, Toasts } from "./panels/banner.ts";
import { ContextMenu } from "./panels/context_menu.ts";
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
import type { Arrow } from "./scene/arrow_field.ts";
import { Gizmo } from "./scene/gizmo.ts";
import { kStereoModes } from "./scene/stereo.ts";
import { Viewport, type ViewportOptions } from "./scene/viewport.ts";
import { freeOf, Session } from "./session.ts";
import { text } from "./strings.ts";
import { ThemeSwitch } from "./theme.ts";
import type { Triple } from "./wire/messages.ts";
import { Headset } from "./xr/headset.ts";

/// Lengths of the arrows at blockers and along free directions [px].
const kReasonArrow = 64;
const kFreeArrow = 80;
/// Blockers are pointed at up to this many, the nearest first.
const kMaxReasonArrows = 6;

/// The viewer page: builds its parts and connects them to buttons and keys.
export class App {
  readonly viewport: Viewport;
  readonly session: Session;
  readonly drag: Drag;
  readonly gizmo = new Gizmo();
  readonly actions = this.makeActions();

  private readonly pointer: PointerInput;
  private readonly rateControl: RateControl;
  private readonly devices: Devices;
  private readonly inspector: Inspector;
  private readonly tree: TreePanel;
  private readonly timeline: TimelinePanel;
  private readonly sections: SectionPanel;
  private readonly measure: Measure;
  private readonly explode: ExplodePanel;
  readonly plan: PlanPanel;
  private readonly menu: ContextMenu;
  private readonly openDialog: OpenDialog;
  private readonly exports: ExportDialog;
  private readonly help = helpDialog();
  private readonly toasts = new Toasts();
  private readonly theme: ThemeSwitch;
  readonly headset: Headset;

  constructor(options: ViewportOptions) {
    const { stage, canvas } = makeStage(text("view.label"));
    this.viewport = new Viewport(canvas, options);
    this.session = new Session(this.viewport);
    this.drag = new Drag(this.session);
    this.pointer = new PointerInput(this.session, this.drag, this.gizmo);
    this.rateControl = new RateControl(this.session, this.drag);
    this.devices = new Devices(this.rateControl, (message) => this.toasts.show("note", message));
    this.inspector = new Inspector(this.session, this.drag);
    this.tree = new TreePanel(this.session);
    this.timeline = new TimelinePanel(this.session);
    this.sections = new SectionPanel(this.session);
    this.measure = new Measure(this.session);
    this.explode = new ExplodePanel(this.session);
    this.plan = new PlanPanel(this.session);
    this.menu = new ContextMenu(this.session, this.actions);
    this.openDialog = new OpenDialog(this.session);
    this.exports = new ExportDialog(this.session);
    stage.append(new Banner(this.session).node, this.measure.node, this.pointer.boxNode, this.toasts.node);
    document.body.prepend(new Toolbar(this).node, this.tree.node);
    document.body.append(
      element("div", { id: "side" }, this.plan.node, this.sections.node, this.inspector.node),
      element("div", { id: "docks" }, this.explode.node, new GuidePanel(this.session).node),
      this.timeline.node,
      new StatusLine(this.session).node,
    );
    document.body.append(this.openDialog.node, this.exports.node, this.exports.preview, this.help, this.menu.node);
    this.connectParts();
    this.theme = new ThemeSwitch(this.viewport);
    this.headset = new Headset(this.session, this.drag, this.actions);
    this.session.connection.connect();
  }

  /// Locks dragging to a world axis; unlocks it where it is locked to that axis already.
  lockAxis(axis: Axis): void {
    this.pointer.axisLock = this.pointer.axisLock === axis ? null : axis;
    const lock = this.pointer.axisLock;
    this.session.change(() => {
      this.session.store.dragHint = lock === null ? "" : text("drag.locked", { axis: kAxisNames[lock] });
    });
  }

  private connectParts(): void {
    const { session, viewport } = this;
    session.onNote = (level, message) => this.toasts.show(level, message);
    this.pointer.onClick = (pick) => this.sections.click(pick) || this.measure.click(pick);
    this.pointer.onHover = (pick) => this.measure.hover(pick);
    this.pointer.onMenu = (pick, x, y) => this.menu.open(pick ? [pick.component] : [], x, y);
    this.tree.onMenu = (components, x, y) => this.menu.open(components, x, y);
    viewport.scene.add(this.gizmo.object);
    viewport.beforeRender.push(() => this.updateMarkers());
    session.notifier.subscribe(() => {
      if (this.drag.active && (session.store.link === "lost" || session.store.state?.hand === null) && this.drag.held)
        this.drag.drop();
    });
    listenForKeys(this);
  }

  /// Places the gizmo, the arrows of the free directions and those of the blockers.
  private updateMarkers(): boolean {
    const { store } = this.session;
    const { model } = this.viewport;
    const shown = store.selection.filter((c) => model?.components[c]?.visible);
    const box = shown.length > 0 ? model!.boundsOf(shown) : null;
    const center = box?.getCenter(new Vector3()) ?? null;
    this.gizmo.place(store.gizmo && store.control ? center : null);
    this.gizmo.update(this.viewport.rig);
    const free = box ? freeOf(this.session.directionsOf(store.selection)) : [];
    const idle = store.state?.automatic == null && store.state?.playback == null;
    this.viewport.directions.arrows = idle && box ? free.map(({ direction }) => arrowOutOf(box, direction)) : [];
    this.viewport.blocked.arrows = this.arrowsOfReason();
    return false;
  }

  /// Arrows that point at each blocker where it would be touched.
  private arrowsOfReason(): Arrow[] {
    const { reason } = this.session;
    if (!reason) return [];
    const direction = new Vector3(...reason.direction);
    return reason.blockers.slice(0, kMaxReasonArrows).map(({ point: contact }) => {
      const point = new Vector3(...contact);
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
      if (selected().components.length > 0) void this.session.send(name, selected());
    };
    return {
      open: () => this.openDialog.open(),
      save: () => void this.save(),
      export: () => this.exports.open(),
      undo: () => void (this.drag.active ? this.drag.undo() : this.session.send("undo", {})),
      redo: () => void this.session.send("redo", {}),
      reset: () => void this.session.send("reset", {}),
      gizmo: () =>
        this.session.change(() => {
          this.session.store.gizmo = !this.session.store.gizmo;
        }),
      section: () => this.sections.toggle(),
      measure: () => this.measure.toggle(),
      explode: () => this.explode.toggle(),
      plan: () => this.plan.toggle(),
      findPath: () => void this.findPath(),
      why: () => void this.session.requestReason(),
      projection: () =>
        this.session.change(() => {
          this.viewport.rig.orthographic = !this.viewport.rig.orthographic;
        }),
      stereo: () =>
        this.session.change(() => {
          const next = (kStereoModes.indexOf(this.viewport.stereo) + 1) % kStereoModes.length;
          this.viewport.stereo = kStereoModes[next];
        }),
      fullScreen: () =>
        void (document.fullscreenElement
          ? document.exitFullscreen()
          : this.viewport.canvas.parentElement!.requestFullscreen()),
      fit: () => this.session.fitView(),
      screenshot: () =>
        void this.viewport.screenshot().then((picture) => saveAs(picture, `${this.session.fileStem}.png`)),
      theme: () => this.theme.toggle(),
      units: () => this.session.toggleUnit(),
      help: () => this.help.showModal(),
      play: () => this.timeline.toggle(),
      nextStep: () => this.timeline.step(1),
      previousStep: () => this.timeline.step(-1),
      directions: () => void this.inspector.find(),
      takeOut: withSelection("take_out"),
      putBack: withSelection("put_back"),
      isolate: () => this.session.toggleIsolated(),
      toggleHidden: () => this.session.toggleHidden(),
      xray: () => this.session.toggleXray(this.session.store.selection),
      showAll: () => this.session.showAll(),
      selectSimilar: () => this.session.selectSimilar(),
      device: () => void this.devices.choose(),
      headset: () => void this.headset.enter(),
      search: () => this.tree.focusSearch(),
      escape: () => this.escape(),
    };
  }

  private escape(): void {
    const { store } = this.session;
    if (this.drag.active) void this.drag.cancel();
    else if (this.rateControl.active) void this.rateControl.cancel();
    else if (store.state?.automatic != null) void this.session.send("halt", {});
    else if (store.measuring) this.measure.toggle();
    else if (store.directions)
      this.session.change(() => {
        store.directions = null;
      });
    else this.session.select([]);
  }

  private async save(): Promise<void> {
    try {
      const response = await this.session.connection.request("/api/path.json");
      saveAs(await response.blob(), `${this.session.fileStem}.path.json`);
      this.toasts.show("note", text("saved"));
    } catch (error) {
      this.toasts.show("warning", (error as Error).message);
    }
  }
}

/// An arrow that starts where a ray from the box's centre leaves the box.
function arrowOutOf(box: Box3, direction: Triple): Arrow {
  const unit = new Vector3(...direction);
  const half = box.getSize(new Vector3()).multiplyScalar(0.5);
  const exit = Math.min(...kAxes.map((k) => half.getComponent(k) / Math.max(1e-9, Math.abs(direction[k]))));
  return { point: box.getCenter(new Vector3()).addScaledVector(unit, exit), direction: unit, length: kFreeArrow };
}
