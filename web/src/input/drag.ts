// SPDX-License-Identifier: Apache-2.0
import { type Matrix4, Vector3 } from "three";
import { kAxisNames } from "../axes.ts";
import { kIdentityPose, matrixOf, rotationOf } from "../pose.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { type PoseFrame, targetMessage } from "../wire/structs.ts";
import { type DragMode, DragMotion, type PointerStep } from "./drag_motion.ts";
import { Feedback } from "./feedback.ts";

/// Time that a released set is given to reach its last target [ms].
const kSettleTime = 400;
/// The ghost is hidden while it is nearer to the component than this [px, rad].
const kGhostGap = 3;
const kGhostAngle = 0.02;

/// A drag of a set of components. Sends targets to the engine, at most one a render and only the newest; the engine
/// replies with poses.
export class Drag {
  mode: DragMode = { kind: "plane", axis: null };

  private motion: DragMotion | null = null;
  private components: number[] = [];
  private startPose = kIdentityPose;
  private grabbedPoint = new Vector3();
  private grip: number | null = null;
  private number = 0;
  private settledNumber = 0;
  private unsent = false;
  private ending = false;
  private readonly feedback: Feedback;

  constructor(private readonly session: Session) {
    this.feedback = new Feedback(session);
    session.onFrame.push((frame) => this.receiveFrame(frame));
    session.viewport.beforeRender.push(() => this.beforeRender());
  }

  /// True during a drag.
  get active(): boolean {
    return this.motion !== null;
  }

  /// True if components may be grabbed now.
  get allowed(): boolean {
    const { control, state, quickExplode } = this.session.store;
    return control && state?.playback == null && quickExplode === 0;
  }

  /// True if the server has granted a grip that was not released since.
  get held(): boolean {
    return this.grip !== null && !this.ending;
  }

  /// True while the engine has neither reached the last target nor reported it blocked.
  get pending(): boolean {
    return (
      this.motion !== null && (this.grip === null || this.unsent || this.ending || this.settledNumber < this.number)
    );
  }

  /// The target of the grabbed point, world frame [mm].
  get anchor(): Vector3 {
    return this.motion?.grabbedTarget() ?? this.grabbedPoint.clone();
  }

  /// Grabs components at a point of the world. Returns false if that was refused.
  async begin(components: number[], grabbedPoint: Vector3): Promise<boolean> {
    if (this.active || !this.allowed) return false;
    const { viewport } = this.session;
    this.components = components;
    this.grabbedPoint = grabbedPoint.clone();
    this.startPose = this.session.poseOf(components[0]) ?? kIdentityPose;
    const views = components.map((c) => viewport.model!.components[c]);
    const center = viewport.model!.boundsOf(components).getCenter(new Vector3());
    this.motion = new DragMotion(this.startPose, center, grabbedPoint);
    [this.grip, this.number, this.settledNumber, this.unsent, this.ending] = [null, 0, 0, false, false];
    viewport.ghost.show(views);

    const reply = await this.session.send("hold", { components });
    if (!reply) {
      this.clear();
      return false;
    }
    this.grip = reply.grip;
    viewport.invalidate();
    return true;
  }

  /// Moves the target by a pointer motion.
  move(step: PointerStep): void {
    if (!this.motion || this.ending) return;
    this.motion.move(step, this.mode);
    this.unsent = true;
    this.showHint();
    this.session.viewport.invalidate();
  }

  /// Sets the target by numbers: offset from the start [mm], and a rotation vector about world axes [rad].
  moveBy(offset: Vector3, turn: Vector3): void {
    if (!this.motion) return;
    this.motion.offset.copy(offset);
    this.motion.turn.setFromAxisAngle(turn.clone().normalize(), turn.length());
    this.unsent = true;
    this.session.viewport.invalidate();
  }

  /// Sets the target to the start pose moved by a rigid motion of the world.
  follow(motion: Matrix4): void {
    if (!this.motion || this.ending) return;
    if (this.motion.follow(motion)) this.unsent = true;
    this.session.viewport.invalidate();
  }

  /// Releases the set once the engine has processed the last target.
  async end(): Promise<void> {
    if (!this.motion || this.ending) return;
    this.ending = true;
    this.session.viewport.invalidate();
    const limit = performance.now() + kSettleTime;
    while (
      this.motion &&
      performance.now() < limit &&
      (this.grip === null || this.unsent || this.settledNumber < this.number)
    )
      await new Promise((resolve) => setTimeout(resolve, 4));
    if (!this.motion) return;
    const { store } = this.session;
    const stuck = this.feedback.stuck ? { components: this.components, blocking: [...store.blocking] } : null;
    await this.session.send("release", {});
    store.stuck = stuck;
    this.clear();
  }

  /// Cancels the drag: the set returns to its start.
  async cancel(): Promise<void> {
    if (!this.motion) return;
    this.clear();
    await this.session.send("cancel_drag", {});
  }

  /// Undo during a drag: ends it at its start.
  async undo(): Promise<void> {
    if (!this.motion) return;
    this.clear();
    await this.session.send("undo", {});
  }

  /// Ends a drag that the server or a lost connection has ended; releases the set when the connection is back.
  drop(): void {
    this.clear();
    if (this.session.store.state?.hand) void this.session.send("release", {});
  }

  private clear(): void {
    this.motion = null;
    this.grip = null;
    this.mode = { kind: "plane", axis: null };
    this.session.viewport.ghost.clear();
    this.feedback.clear();
    this.session.change(() => {
      this.session.store.dragHint = "";
    });
    this.session.viewport.invalidate();
  }

  private beforeRender(): boolean {
    if (!this.motion) return false;
    if (this.unsent && this.grip !== null) {
      const sent = this.session.connection.sendStruct(targetMessage(this.grip, this.number + 1, this.motion.target()));
      if (sent) ++this.number;
      else this.session.viewport.requestFrame(); // it may be the last target: it is sent when the connection has caught up
      this.unsent = !sent;
    }
    this.showGhost();
    return false;
  }

  private receiveFrame(frame: PoseFrame): void {
    if (!this.motion || frame.grip !== this.grip) return;
    if (frame.number === this.number && (frame.reached || frame.blocked)) this.settledNumber = frame.number;
  }

  private showGhost(): void {
    const { viewport } = this.session;
    const pose = this.session.poseOf(this.components[0]) ?? kIdentityPose;
    const worldFromStart = matrixOf(this.startPose).invert();
    const real = this.grabbedPoint.clone().applyMatrix4(worldFromStart).applyMatrix4(matrixOf(pose));
    const target = this.motion!.target();
    const pixel = viewport.rig.pixelSize(real);
    const band = { from: real, to: this.motion!.grabbedTarget() };
    const apart =
      band.from.distanceTo(band.to) > kGhostGap * pixel || rotationOf(pose).angleTo(rotationOf(target)) > kGhostAngle;
    if (apart) viewport.ghost.place(matrixOf(target), band, pixel);
    else viewport.ghost.hide();
  }

  private showHint(): void {
    const { kind, axis } = this.mode;
    const parts = [
      kind === "turn" ? text("drag.turn") : kind === "depth" ? text("drag.depth") : "",
      axis === null ? "" : text("drag.locked", { axis: kAxisNames[axis] }),
    ];
    const hint = parts.filter((part) => part !== "").join(" ");
    if (hint !== this.session.store.dragHint)
      this.session.change(() => {
        this.session.store.dragHint = hint;
      });
  }
}
