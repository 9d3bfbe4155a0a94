// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Vector3 } from "three";
import type { CameraRig } from "../scene/camera_rig.ts";
import type { Arrow } from "../scene/marks.ts";
import { setMatrixFromPose } from "../scene/model_view.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { type PoseFrame, targetMessage, type WirePose } from "../wire/structs.ts";
import { type DragMode, DragMotion, type PointerStep } from "./drag_motion.ts";

const kAssembled: WirePose = { position: [0, 0, 0], rotation: [1, 0, 0, 0] };
/// How long a let-go set may take to its last target.
const kSettle = 400;
/// Blocked for so long, the hand is told what is free.
const kStuck = 1000;
/// A ghost nearer than this to the component is not shown [px].
const kGhostGap = 3;
/// Contacts nearer than this to each other on screen share an arrow, which is so long [px].
const kArrowGap = 22;
const kArrowLength = 30;

/// A drag: the page sends targets, at most one a picture and the newest only; the engine answers with poses.
export class Drag {
  mode: DragMode = { kind: "plane", axis: null };

  private motion: DragMotion | null = null;
  private components: number[] = [];
  private startPose = kAssembled;
  private grabbed = new Vector3();
  private grip: number | null = null;
  private number = 0;
  private answered = 0;
  private unsent = false;
  private ending = false;
  private stuckSince = 0;
  private stuckAsked = false;

  constructor(private readonly session: Session) {
    session.onFrame.push((frame) => this.takeFrame(frame));
    session.viewport.beforePicture.push((now) => this.beforePicture(now));
  }

  get active(): boolean {
    return this.motion !== null;
  }

  /// Whether components may be taken in hand now.
  get allowed(): boolean {
    const { control, state } = this.session.store;
    return control && state?.playback == null;
  }

  /// The server has given a grip, and was not yet asked to take it back.
  get held(): boolean {
    return this.grip !== null && !this.ending;
  }

  /// The last target is neither reached nor blocked yet.
  get waits(): boolean {
    return this.motion !== null && (this.grip === null || this.unsent || this.ending || this.answered < this.number);
  }

  /// The grabbed point where the hand wants it.
  get anchor(): Vector3 {
    return this.motion?.grabbedTarget() ?? this.grabbed.clone();
  }

  /// Takes components in hand at a point of the world. Gives whether they could be.
  async begin(components: number[], grabbed: Vector3): Promise<boolean> {
    if (this.active || !this.allowed) return false;
    const { viewport, store } = this.session;
    this.components = components;
    this.grabbed = grabbed.clone();
    this.startPose = this.session.poseOf(components[0]) ?? kAssembled;
    const views = components.map((c) => viewport.model!.components[c]);
    const center = viewport.model!.boundsOf(components).getCenter(new Vector3());
    this.motion = new DragMotion(this.startPose, center, grabbed);
    [this.grip, this.number, this.answered, this.unsent, this.ending] = [null, 0, 0, false, false];
    [this.stuckSince, this.stuckAsked] = [0, false];
    store.leastClearance = Number.NaN;
    store.stuck = null;
    viewport.ghost.show(views);

    const answer = await this.session.ask("hold", { components });
    if (!answer) {
      this.clear();
      return false;
    }
    this.grip = answer.grip;
    viewport.invalidate();
    return true;
  }

  move(step: PointerStep): void {
    if (!this.motion || this.ending) return;
    this.motion.move(step, this.mode);
    this.unsent = true;
    this.hint();
    this.session.viewport.invalidate();
  }

  /// A target given by numbers: so far from the start [mm], turned about world axes [rad].
  moveBy(offset: Vector3, turn: Vector3): void {
    if (!this.motion) return;
    this.motion.offset.copy(offset);
    this.motion.turn.setFromAxisAngle(turn.clone().normalize(), turn.length());
    this.unsent = true;
    this.session.viewport.invalidate();
  }

  /// The wish as a rigid motion of the world since the grab.
  follow(motion: Matrix4): void {
    if (!this.motion || this.ending) return;
    if (this.motion.follow(motion)) this.unsent = true;
    this.session.viewport.invalidate();
  }

  /// Lets go, once the engine has answered the last target.
  async end(): Promise<void> {
    if (!this.motion || this.ending) return;
    this.ending = true;
    this.session.viewport.invalidate();
    const limit = performance.now() + kSettle;
    while (
      this.motion &&
      performance.now() < limit &&
      (this.grip === null || this.unsent || this.answered < this.number)
    )
      await new Promise((resolve) => setTimeout(resolve, 4));
    if (!this.motion) return;
    const { store } = this.session;
    const blocking = [...store.blocking];
    const stuck = this.stuckAsked && blocking.length > 0 ? { components: this.components, blocking } : null;
    await this.session.ask("release", {});
    store.stuck = stuck;
    this.clear();
  }

  /// Back to where the drag began.
  async cancel(): Promise<void> {
    if (!this.motion) return;
    this.clear();
    await this.session.ask("cancel_drag", {});
  }

  /// Undo in mid-drag: ends the drag at its start.
  async undo(): Promise<void> {
    if (!this.motion) return;
    this.clear();
    await this.session.ask("undo", {});
  }

  /// The server ended the drag, or the connection did: then the server is told to let go when it is back.
  drop(): void {
    this.clear();
    if (this.session.store.state?.hand) void this.session.ask("release", {});
  }

  /// What was found for a set that was stuck goes when it is not.
  private forgetStuck(): void {
    if (this.stuckAsked)
      this.session.change(() => {
        this.session.store.directions = null;
      });
    [this.stuckSince, this.stuckAsked] = [0, false];
  }

  private clear(): void {
    this.forgetStuck();
    this.motion = null;
    this.grip = null;
    this.mode = { kind: "plane", axis: null };
    this.session.viewport.ghost.clear();
    this.session.viewport.contacts.arrows = [];
    this.session.block(new Set());
    this.session.change(() => {
      this.session.store.dragHint = "";
    });
    this.session.viewport.invalidate();
  }

  private beforePicture(now: number): boolean {
    if (!this.motion) return false;
    if (this.unsent && this.grip !== null) {
      this.unsent = false;
      this.session.connection.sendStruct(targetMessage(this.grip, ++this.number, this.motion.target()));
    }
    this.showGhost();
    this.watchStuck(now);
    return this.stuckSince > 0 && !this.stuckAsked;
  }

  private takeFrame(frame: PoseFrame): void {
    const { store, viewport } = this.session;
    const shown = this.motion !== null || frame.automatic || frame.playback;
    viewport.contacts.arrows = shown ? contactArrows(frame, viewport.rig) : [];
    if (!this.motion || frame.grip !== this.grip) return;
    if (frame.number === this.number && (frame.reached || frame.blocked)) this.answered = frame.number;
    if (!Number.isNaN(frame.clearance) && !(store.leastClearance <= frame.clearance))
      store.leastClearance = frame.clearance;
    this.session.block(new Set(frame.blocked ? frame.contacts.map(({ fixed }) => fixed) : []));
    if (!frame.blocked) this.forgetStuck();
    else if (this.stuckSince === 0) this.stuckSince = performance.now();
  }

  private showGhost(): void {
    const { viewport } = this.session;
    const pose = this.session.poseOf(this.components[0]) ?? kAssembled;
    const worldFromStart = setMatrixFromPose(new Matrix4(), this.startPose).invert();
    const real = this.grabbed.clone().applyMatrix4(worldFromStart).applyMatrix4(setMatrixFromPose(new Matrix4(), pose));
    const wanted = this.motion!.target();
    const pixel = viewport.rig.pixelSize(real);
    const ends = { from: real, to: this.motion!.grabbedTarget() };
    const apart = ends.from.distanceTo(ends.to) > kGhostGap * pixel || turnBetween(pose, wanted) > 0.02;
    if (apart) viewport.ghost.place(setMatrixFromPose(new Matrix4(), wanted), ends, pixel);
    else viewport.ghost.hide();
  }

  private watchStuck(now: number): void {
    if (this.stuckSince === 0 || this.stuckAsked || now - this.stuckSince < kStuck) return;
    this.stuckAsked = true;
    const { store } = this.session;
    void this.session.connection.command("free_directions", { components: this.components }).then(
      ({ directions }) => {
        if (this.motion)
          this.session.change(() => {
            store.directions = { components: this.components, directions };
          });
      },
      () => {},
    );
  }

  private hint(): void {
    const { kind, axis } = this.mode;
    const words = [
      kind === "turn" ? text("drag.turn") : kind === "depth" ? text("drag.depth") : "",
      axis === null ? "" : text("drag.locked", { axis: "XYZ"[axis] }),
    ];
    const hint = words.filter((word) => word !== "").join(" ");
    if (hint !== this.session.store.dragHint)
      this.session.change(() => {
        this.session.store.dragHint = hint;
      });
  }
}

/// The contacts as arrows; of those that would cover each other on screen, the one with the least gap.
function contactArrows(frame: PoseFrame, rig: CameraRig): Arrow[] {
  const arrows: Arrow[] = [];
  const places: Vector3[] = [];
  for (const contact of frame.contacts) {
    const point = new Vector3(...contact.point);
    const direction = new Vector3(...contact.normal);
    const place = rig.project(point).setZ(0);
    const covered = arrows.some(
      (other, i) => places[i].distanceTo(place) < kArrowGap && other.direction.dot(direction) > 0.9,
    );
    if (covered) continue;
    arrows.push({ point, direction, length: kArrowLength });
    places.push(place);
  }
  return arrows;
}

function turnBetween(a: WirePose, b: WirePose): number {
  const dot = a.rotation.reduce((sum, value, i) => sum + value * b.rotation[i], 0);
  return 2 * Math.acos(Math.min(1, Math.abs(dot)));
}
