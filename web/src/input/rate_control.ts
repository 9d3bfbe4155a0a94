// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { Session } from "../session.ts";
import type { Triple } from "../wire/messages.ts";
import { rateMessage } from "../wire/structs.ts";
import type { Drag } from "./drag.ts";

/// The deflection of a device in screen axes (right, up, towards the eye), each in [-1, 1].
export interface Deflection {
  linear: Vector3;
  angular: Vector3;
}

const kDeadZone = 0.08;
/// At full deflection: the fraction of the view's height travelled in a second, and the angular velocity [rad/s].
const kLinearSpeed = 0.6;
const kAngularSpeed = 1.6;
/// The set is released after this time at rest [ms].
const kRestTime = 350;

/// Rate control by devices that give a velocity: 3D mice and gamepads. Moves the selection, as one drag from deflection
/// to rest; without a selection, the view. The server integrates the velocity from the reached pose, so the target
/// cannot run ahead of a blocked component.
export class RateControl {
  private deflection: Deflection = { linear: new Vector3(), angular: new Vector3() };
  private lastMotion = 0;
  private lastRender = 0;
  private grip: number | null = null;
  private number = 0;
  private grabbing = false;
  /// A set that was refused, cancelled or released elsewhere is not grabbed again before the device has been at rest.
  private awaitsRest = false;

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
  ) {
    session.viewport.beforeRender.push((now) => this.beforeRender(now));
  }

  /// Sets the deflection of the device.
  deflect({ linear, angular }: Deflection): void {
    this.deflection = { linear: withDeadZone(linear), angular: withDeadZone(angular) };
    if (this.resting) this.awaitsRest = false;
    else this.session.viewport.invalidate();
  }

  /// True while a set is grabbed.
  get active(): boolean {
    return this.grip !== null || this.grabbing;
  }

  /// Cancels the motion: the set returns to its start.
  async cancel(): Promise<void> {
    this.grip = null;
    this.awaitsRest = true;
    await this.session.send("cancel_drag", {});
  }

  private get resting(): boolean {
    return this.deflection.linear.lengthSq() === 0 && this.deflection.angular.lengthSq() === 0;
  }

  private beforeRender(now: number): boolean {
    const elapsed = Math.min(0.1, (now - this.lastRender) / 1000);
    this.lastRender = now;
    if (!this.resting) this.lastMotion = now;
    const { selection, control, state } = this.session.store;
    const moves = selection.length > 0 && control && state !== null && state.playback === null && !this.drag.active;
    if (moves || this.grip !== null) this.moveSelection(now);
    else if (!this.resting) this.moveView(elapsed);
    return !this.resting || this.active;
  }

  private moveSelection(now: number): void {
    if (this.grip === null) {
      if (!this.resting && !this.grabbing && !this.awaitsRest) void this.grab();
      return;
    }
    if (this.session.store.state?.hand === null) [this.grip, this.awaitsRest] = [null, !this.resting];
    else if (now - this.lastMotion > kRestTime) void this.release();
    else this.send(this.grip);
  }

  private send(grip: number): void {
    const { rig, model } = this.session.viewport;
    const center = model!.boundsOf(this.session.store.selection).getCenter(new Vector3());
    const speed = kLinearSpeed * rig.size.y * rig.pixelSize(center);
    const linear = this.inWorld(this.deflection.linear).multiplyScalar(speed);
    const angular = this.inWorld(this.deflection.angular).multiplyScalar(kAngularSpeed);
    const message = rateMessage(grip, ++this.number, linear.toArray() as Triple, angular.toArray() as Triple);
    this.session.connection.sendStruct(message);
  }

  private async grab(): Promise<void> {
    this.grabbing = true;
    const reply = await this.session.send("hold", { components: [...this.session.store.selection] });
    this.grabbing = false;
    this.grip = reply?.grip ?? null;
    this.number = 0;
    this.awaitsRest = reply === null;
    this.session.viewport.invalidate();
  }

  private async release(): Promise<void> {
    this.grip = null;
    await this.session.send("release", {});
  }

  /// Moves the camera. Pushing right moves the scene to the left.
  private moveView(elapsed: number): void {
    const { rig } = this.session.viewport;
    const { focus } = rig.current;
    const { linear, angular } = this.deflection;
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

/// Applies the dead zone and reduces the response near rest.
function withDeadZone(values: Vector3): Vector3 {
  const shape = (value: number) => {
    const beyond = Math.max(0, Math.abs(value) - kDeadZone) / (1 - kDeadZone);
    return Math.sign(value) * beyond * (0.35 + 0.65 * beyond);
  };
  return new Vector3(shape(values.x), shape(values.y), shape(values.z));
}
