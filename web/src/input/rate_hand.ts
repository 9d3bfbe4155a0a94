// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { Session } from "../session.ts";
import type { Triple } from "../wire/messages.ts";
import { rateMessage } from "../wire/structs.ts";
import type { Drag } from "./drag.ts";

/// What a device asks for, in the axes of the screen (right, up, towards the eye), each from -1 to 1.
export interface Deflection {
  linear: Vector3;
  angular: Vector3;
}

const kDeadZone = 0.08;
/// Full deflection crosses this part of the picture's height in a second, and turns so fast [rad/s].
const kLinearSpeed = 0.6;
const kAngularSpeed = 1.6;
/// At rest for so long, the hand lets go [ms].
const kRest = 350;

/// The hand of devices that give a speed, not a place: 3D mice and gamepads. It moves what is selected, as one drag from
/// deflection to rest, or else the view. The server integrates the speed from the pose reached, so that nothing runs ahead
/// of a component that is blocked.
export class RateHand {
  private wanted: Deflection = { linear: new Vector3(), angular: new Vector3() };
  private lastMotion = 0;
  private lastPicture = 0;
  private grip: number | null = null;
  private number = 0;
  private taking = false;
  /// What was refused, cancelled or taken out of the hand is not taken again until the device has been at rest.
  private awaitsRest = false;

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
  ) {
    session.viewport.beforePicture.push((now) => this.beforePicture(now));
  }

  deflect(deflection: Deflection): void {
    this.wanted = { linear: shaped(deflection.linear), angular: shaped(deflection.angular) };
    if (this.resting) this.awaitsRest = false;
    else this.session.viewport.invalidate();
  }

  get holds(): boolean {
    return this.grip !== null || this.taking;
  }

  /// Back to where the motion began.
  async cancel(): Promise<void> {
    this.grip = null;
    this.awaitsRest = true;
    await this.session.ask("cancel_drag", {});
  }

  private get resting(): boolean {
    return this.wanted.linear.lengthSq() === 0 && this.wanted.angular.lengthSq() === 0;
  }

  private beforePicture(now: number): boolean {
    const elapsed = Math.min(0.1, (now - this.lastPicture) / 1000);
    this.lastPicture = now;
    if (!this.resting) this.lastMotion = now;
    const { selection, control, state } = this.session.store;
    const moves = selection.length > 0 && control && state !== null && state.playback === null && !this.drag.active;
    if (moves || this.grip !== null) this.moveSelection(now);
    else if (!this.resting) this.moveView(elapsed);
    return !this.resting || this.holds;
  }

  private moveSelection(now: number): void {
    if (this.grip === null) {
      if (!this.resting && !this.taking && !this.awaitsRest) void this.take();
      return;
    }
    if (this.session.store.state?.hand === null) [this.grip, this.awaitsRest] = [null, !this.resting];
    else if (now - this.lastMotion > kRest) void this.letGo();
    else this.send(this.grip);
  }

  private send(grip: number): void {
    const { rig, model } = this.session.viewport;
    const center = model!.boundsOf(this.session.store.selection).getCenter(new Vector3());
    const speed = kLinearSpeed * rig.size.y * rig.pixelSize(center);
    const linear = this.inWorld(this.wanted.linear).multiplyScalar(speed);
    const angular = this.inWorld(this.wanted.angular).multiplyScalar(kAngularSpeed);
    const message = rateMessage(grip, ++this.number, linear.toArray() as Triple, angular.toArray() as Triple);
    this.session.connection.sendStruct(message);
  }

  private async take(): Promise<void> {
    this.taking = true;
    const answer = await this.session.ask("hold", { components: [...this.session.store.selection] });
    this.taking = false;
    this.grip = answer?.grip ?? null;
    this.number = 0;
    this.awaitsRest = answer === null;
    this.session.viewport.invalidate();
  }

  private async letGo(): Promise<void> {
    this.grip = null;
    await this.session.ask("release", {});
  }

  /// The view goes against the device: what one pushes right comes from the right.
  private moveView(elapsed: number): void {
    const { rig } = this.session.viewport;
    const { focus } = rig.current;
    const { linear, angular } = this.wanted;
    const reach = kLinearSpeed * rig.size.y * elapsed;
    rig.pan(linear.x * reach, -linear.y * reach, focus);
    rig.zoom(Math.exp(-linear.z * elapsed), focus);
    rig.orbit(angular.y * elapsed * 200, angular.x * elapsed * 200, focus);
  }

  private inWorld(screen: Vector3): Vector3 {
    const { rig } = this.session.viewport;
    return rig
      .axis("right")
      .multiplyScalar(screen.x)
      .addScaledVector(rig.axis("up"), screen.y)
      .addScaledVector(rig.axis("back"), screen.z);
  }
}

/// Nothing near rest, gentle near it.
function shaped(values: Vector3): Vector3 {
  const shape = (value: number) => {
    const beyond = Math.max(0, Math.abs(value) - kDeadZone) / (1 - kDeadZone);
    return Math.sign(value) * beyond * (0.35 + 0.65 * beyond);
  };
  return new Vector3(shape(values.x), shape(values.y), shape(values.z));
}
