// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Vector3 } from "three";
import { setMatrixFromPose } from "../scene/model_view.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { type PoseFrame, targetMessage, type WirePose } from "../wire/structs.ts";
import { type DragMode, DragMotion, type PointerStep } from "./drag_motion.ts";
import { Feedback } from "./feedback.ts";

const kAssembled: WirePose = { position: [0, 0, 0], rotation: [1, 0, 0, 0] };
/// How long a let-go set may take to its last target.
const kSettle = 400;
/// A ghost nearer than this to the component is not shown [px].
const kGhostGap = 3;

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
  private readonly feedback: Feedback;

  constructor(private readonly session: Session) {
    this.feedback = new Feedback(session);
    session.onFrame.push((frame) => this.takeFrame(frame));
    session.viewport.beforePicture.push(() => this.beforePicture());
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
    const { viewport } = this.session;
    this.components = components;
    this.grabbed = grabbed.clone();
    this.startPose = this.session.poseOf(components[0]) ?? kAssembled;
    const views = components.map((c) => viewport.model!.components[c]);
    const center = viewport.model!.boundsOf(components).getCenter(new Vector3());
    this.motion = new DragMotion(this.startPose, center, grabbed);
    [this.grip, this.number, this.answered, this.unsent, this.ending] = [null, 0, 0, false, false];
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
    const stuck = this.feedback.stuck ? { components: this.components, blocking: [...store.blocking] } : null;
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

  private beforePicture(): boolean {
    if (!this.motion) return false;
    if (this.unsent && this.grip !== null) {
      this.unsent = false;
      this.session.connection.sendStruct(targetMessage(this.grip, ++this.number, this.motion.target()));
    }
    this.showGhost();
    return false;
  }

  private takeFrame(frame: PoseFrame): void {
    if (!this.motion || frame.grip !== this.grip) return;
    if (frame.number === this.number && (frame.reached || frame.blocked)) this.answered = frame.number;
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

function turnBetween(a: WirePose, b: WirePose): number {
  const dot = a.rotation.reduce((sum, value, i) => sum + value * b.rotation[i], 0);
  return 2 * Math.acos(Math.min(1, Math.abs(dot)));
}
