// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { Axis } from "../axes.ts";
import { element } from "../dom.ts";
import { type BoxRule, componentsInBox, type ScreenBox } from "../scene/box_selection.ts";
import type { Gizmo } from "../scene/gizmo.ts";
import type { Pick } from "../scene/model_view.ts";
import { freeOf, type Session } from "../session.ts";
import type { Drag } from "./drag.ts";
import type { DragMode, PointerStep } from "./drag_motion.ts";

const kClickTolerance = 4;
const kZoomStep = 0.0012;

type Gesture =
  | { kind: "orbit"; pivot: Vector3 }
  | { kind: "pan"; grabbed: Vector3 }
  | { kind: "press"; pick: Pick; adds: boolean }
  | { kind: "arrow"; arrow: number; fallback: Gesture }
  | { kind: "box"; adds: boolean }
  | { kind: "drag"; mode: DragMode | null; ready: Promise<boolean> };

/// Pointer gestures in the 3D view. Left button: orbit on empty space (with Shift: select by a box), select and drag on a
/// component; right: always orbit, or a menu where it is only clicked; middle: pan; wheel: zoom to the cursor; double
/// click: focus. Two fingers pan and zoom.
export class PointerInput {
  /// Offers a click to a tool (measure) before it selects; returns true if the tool took it.
  onClick: (pick: Pick | null) => boolean = () => false;
  /// Tells a tool what is under the cursor.
  onHover: (pick: Pick | null) => void = () => {};
  /// Opens a menu for a component, or for the view, at a point of the page.
  onMenu: (pick: Pick | null, x: number, y: number) => void = () => {};
  /// The rectangle of a selection by a box.
  readonly boxNode = element("div", { id: "selection-box", hidden: true });
  /// World axis locked by the keyboard.
  axisLock: Axis | null = null;

  private gesture: Gesture | null = null;
  private moved = false;
  private down = { x: 0, y: 0 };
  private last = { x: 0, y: 0 };
  private readonly touches = new Map<number, { x: number; y: number }>();
  private hoverAt: { x: number; y: number } | null = null;

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
    private readonly gizmo: Gizmo,
  ) {
    const { canvas } = session.viewport;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.release(event));
    canvas.addEventListener("pointercancel", (event) => this.release(event));
    canvas.addEventListener("pointerleave", () => this.leave());
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("dblclick", (event) => this.focus(event));
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    session.viewport.beforeRender.push(() => this.showHover());
  }

  private positionOf(event: MouseEvent): { x: number; y: number } {
    const box = this.session.viewport.canvas.getBoundingClientRect();
    return this.session.viewport.positionInView(event.clientX - box.left, event.clientY - box.top);
  }

  private press(event: PointerEvent): void {
    const { viewport } = this.session;
    const { canvas } = viewport;
    const at = this.positionOf(event);
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") this.touches.set(event.pointerId, at);
    if (this.touches.size === 2) {
      if (this.gesture?.kind === "drag") void this.drag.end();
      this.gesture = { kind: "pan", grabbed: this.pivot(at) };
    }
    if (this.gesture) return;
    this.down = this.last = at;
    this.moved = false;
    if (event.button === 1) this.gesture = { kind: "pan", grabbed: this.pivot(at) };
    else if (event.button === 2) this.gesture = { kind: "orbit", pivot: this.orbitPivot(at) };
    else if (event.button === 0) this.pressLeft(event, at);
  }

  private pressLeft(event: PointerEvent, at: { x: number; y: number }): void {
    const { viewport } = this.session;
    const { rig } = viewport;
    const view = viewport.pickCube(at.x, at.y);
    if (view) return rig.lookFrom(view);
    const arrow = this.arrowAt(at);
    this.gesture = this.gestureFor(event, at);
    if (arrow >= 0 && this.gesture.kind !== "drag") this.gesture = { kind: "arrow", arrow, fallback: this.gesture };
  }

  private gestureFor(event: PointerEvent, at: { x: number; y: number }): Gesture {
    const { viewport, store } = this.session;
    const mode = this.handleAt(at);
    if (mode && store.selection.length > 0)
      return { kind: "drag", mode, ready: this.drag.begin(store.selection, this.selectionCenter()) };
    const pick = viewport.pick(at.x, at.y);
    if (pick) return { kind: "press", pick, adds: event.shiftKey || event.ctrlKey };
    if (event.shiftKey && !store.measuring) return { kind: "box", adds: event.ctrlKey };
    return { kind: "orbit", pivot: this.orbitPivot(at) };
  }

  private move(event: PointerEvent): void {
    const at = this.positionOf(event);
    if (event.pointerType === "touch" && this.touches.size === 2) return this.pinch(event.pointerId, at);
    if (!this.gesture) {
      this.hoverAt = at;
      this.session.viewport.invalidate();
      return;
    }
    if (!this.moved && Math.hypot(at.x - this.down.x, at.y - this.down.y) < kClickTolerance) return;
    const first = !this.moved;
    this.moved = true;
    this.continueGesture(event, at, first);
    this.last = at;
  }

  private continueGesture(event: PointerEvent, at: { x: number; y: number }, first: boolean): void {
    const { rig } = this.session.viewport;
    if (this.gesture?.kind === "arrow") this.gesture = this.gesture.fallback;
    if (first && this.gesture?.kind === "press") this.gesture = this.startDrag(this.gesture);
    const [dx, dy] = [at.x - this.last.x, at.y - this.last.y];
    if (this.gesture?.kind === "orbit") rig.orbit(dx, dy, this.gesture.pivot);
    else if (this.gesture?.kind === "pan") rig.pan(dx, dy, this.gesture.grabbed);
    else if (this.gesture?.kind === "box") this.showBox(at);
    else if (this.gesture?.kind === "drag") {
      const free = event.altKey ? "turn" : event.shiftKey ? "depth" : "plane";
      this.drag.mode = this.gesture.mode ?? { kind: free, axis: this.axisLock };
      this.drag.move(this.step(at, dx, dy));
    }
  }

  private step(at: { x: number; y: number }, dx: number, dy: number): PointerStep {
    const { rig } = this.session.viewport;
    return {
      before: rig.ray(this.last.x, this.last.y),
      after: rig.ray(at.x, at.y),
      dx,
      dy,
      right: rig.axis("right"),
      up: rig.axis("up"),
      back: rig.axis("back"),
      pixel: rig.pixelSize(this.drag.anchor),
    };
  }

  private startDrag(press: Gesture & { kind: "press" }): Gesture {
    const { store } = this.session;
    const { component, point } = press.pick;
    if (!this.drag.allowed || store.measuring) return { kind: "orbit", pivot: point };
    if (!store.selection.includes(component)) this.session.select([component]);
    return { kind: "drag", mode: null, ready: this.drag.begin([...store.selection], point) };
  }

  private release(event: PointerEvent): void {
    this.touches.delete(event.pointerId);
    const { gesture } = this;
    if (!gesture) return;
    const at = this.positionOf(event);
    const isUp = event.type === "pointerup";
    if (gesture.kind === "drag") void gesture.ready.then(() => this.drag.end());
    else if (gesture.kind === "box" && this.moved && isUp) this.selectBox(at, gesture.adds);
    else if (!this.moved && isUp && event.button === 0) this.click(gesture);
    else if (!this.moved && isUp && event.button === 2 && !this.drag.active)
      this.onMenu(this.session.viewport.pick(at.x, at.y), event.clientX, event.clientY);
    this.boxNode.hidden = true;
    this.gesture = null;
    this.hoverAt = at;
  }

  private boxTo({ x, y }: { x: number; y: number }): ScreenBox {
    const { down } = this;
    return {
      left: Math.min(down.x, x),
      top: Math.min(down.y, y),
      right: Math.max(down.x, x),
      bottom: Math.max(down.y, y),
    };
  }

  /// Drawn to the right, a box selects what is inside; to the left, also what it crosses.
  private ruleTo({ x }: { x: number }): BoxRule {
    return x >= this.down.x ? "inside" : "crossing";
  }

  private showBox(at: { x: number; y: number }): void {
    const { left, top, right, bottom } = this.boxTo(at);
    const { style } = this.boxNode;
    [style.left, style.top] = [`${left}px`, `${top}px`];
    [style.width, style.height] = [`${right - left}px`, `${bottom - top}px`];
    this.boxNode.dataset.rule = this.ruleTo(at);
    this.boxNode.hidden = false;
  }

  private selectBox(at: { x: number; y: number }, adds: boolean): void {
    const { model, rig } = this.session.viewport;
    if (!model) return;
    const found = componentsInBox(model, rig, this.boxTo(at), this.ruleTo(at));
    const before = adds ? this.session.store.selection : [];
    this.session.select([...before, ...found.filter((c) => !before.includes(c))]);
  }

  private click(gesture: Gesture): void {
    if (gesture.kind === "arrow") return this.takeOutAlong(gesture.arrow);
    const pick = gesture.kind === "press" ? gesture.pick : null;
    if (this.onClick(pick)) return;
    if (!pick) return this.session.select([]);
    const { selection } = this.session.store;
    if (gesture.kind !== "press" || !gesture.adds) return this.session.select([pick.component]);
    const has = selection.includes(pick.component);
    this.session.select(has ? selection.filter((c) => c !== pick.component) : [...selection, pick.component]);
  }

  /// Fits the view to the component under the cursor, or to everything.
  private focus(event: MouseEvent): void {
    const { viewport, store } = this.session;
    const at = this.positionOf(event);
    if (this.moved || store.measuring || !viewport.model) return;
    if (viewport.pickCube(at.x, at.y) || this.isOnHandle(at)) return;
    const pick = viewport.pick(at.x, at.y);
    viewport.rig.fit(pick ? viewport.model.components[pick.component].bounds() : viewport.model.bounds());
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const at = this.positionOf(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    const amount = Math.max(-400, Math.min(400, event.deltaY * lines));
    this.session.viewport.rig.zoom(Math.exp(amount * kZoomStep), this.pivot(at));
  }

  private pinch(id: number, at: { x: number; y: number }): void {
    const other = [...this.touches.entries()].find(([key]) => key !== id)![1];
    const before = this.touches.get(id)!;
    this.touches.set(id, at);
    const middle = { x: (at.x + other.x) / 2, y: (at.y + other.y) / 2 };
    const { rig } = this.session.viewport;
    const fixed = this.gesture?.kind === "pan" ? this.gesture.grabbed : this.pivot(middle);
    rig.pan((at.x - before.x) / 2, (at.y - before.y) / 2, fixed);
    const spread = (p: { x: number; y: number }) => Math.max(10, Math.hypot(p.x - other.x, p.y - other.y));
    rig.zoom(spread(before) / spread(at), this.pivot(middle));
    this.moved = true;
  }

  /// The point that a gesture refers to: on the surface under the cursor, or at the depth of the view's focus.
  private pivot(at: { x: number; y: number }): Vector3 {
    const { viewport } = this.session;
    const pick = viewport.pick(at.x, at.y);
    if (pick) return pick.point;
    const { focus } = viewport.rig.current;
    const ray = viewport.rig.ray(at.x, at.y);
    const back = viewport.rig.axis("back");
    return ray.at(focus.sub(ray.origin).dot(back) / ray.direction.dot(back), new Vector3());
  }

  private orbitPivot(at: { x: number; y: number }): Vector3 {
    const { viewport } = this.session;
    return viewport.pick(at.x, at.y)?.point ?? viewport.rig.current.focus;
  }

  private selectionCenter(): Vector3 {
    const { viewport, store } = this.session;
    return viewport.model!.boundsOf(store.selection).getCenter(new Vector3());
  }

  private takeOutAlong(arrow: number): void {
    const { directions } = this.session.store;
    const direction = freeOf(directions?.directions)[arrow]?.direction;
    if (!directions || !direction) return;
    void this.session.send("take_out", { components: directions.components, direction });
  }

  private leave(): void {
    this.hoverAt = null;
    this.session.viewport.cube.hover(null);
    if (!this.gesture) this.session.hover(null);
  }

  /// Index of the free direction's arrow under the cursor, or -1. While measuring, arrows do not take clicks.
  private arrowAt({ x, y }: { x: number; y: number }): number {
    const { viewport, store } = this.session;
    return store.measuring ? -1 : viewport.directions.pick(viewport.rig, x, y);
  }

  /// The drag that the gizmo's handle under the cursor starts; null: no handle.
  private handleAt({ x, y }: { x: number; y: number }): DragMode | null {
    const { viewport, store } = this.session;
    return store.measuring ? null : this.gizmo.pick(viewport.rig, x, y);
  }

  private isOnHandle(at: { x: number; y: number }): boolean {
    return this.arrowAt(at) >= 0 || this.handleAt(at) !== null;
  }

  private showHover(): boolean {
    const { viewport } = this.session;
    const at = this.hoverAt;
    this.hoverAt = null;
    if (!at || this.gesture) return false;
    const view = viewport.pickCube(at.x, at.y);
    viewport.cube.hover(view);
    const onHandle = this.isOnHandle(at);
    const pick = view || onHandle ? null : viewport.pick(at.x, at.y);
    this.session.hover(pick?.component ?? null);
    this.onHover(pick);
    viewport.canvas.classList.toggle("pointing", view !== null || onHandle);
    return false;
  }
}
