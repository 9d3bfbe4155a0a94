// SPDX-License-Identifier: Apache-2.0
import { type Matrix4, Quaternion, type Ray, Vector3 } from "three";
import type { WirePose } from "../wire/structs.ts";

/// What the hand may do: follow the pointer in the plane of the screen, go deeper, turn, or keep to an axis.
export interface DragMode {
  kind: "plane" | "depth" | "turn";
  /// A world axis to keep to, or to turn about.
  axis: 0 | 1 | 2 | null;
}

/// What a motion of the pointer means in the world.
export interface PointerStep {
  before: Ray;
  after: Ray;
  dx: number;
  dy: number;
  /// Of the screen, unit, in the world.
  right: Vector3;
  up: Vector3;
  back: Vector3;
  /// The size of a pixel at the grabbed point [mm].
  pixel: number;
}

/// A turn about an axis follows the pointer around it from so far [px], and where the axis goes so much along the line of sight.
const kLeastArm = 8;
const kLeastFacing = 0.3;
const kTurnSpeed = 0.01;
const kAxes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/// Where the hand wants a rigid set: its pose at the grab, turned about its centre and moved. Only ever a wish.
export class DragMotion {
  readonly offset = new Vector3();
  readonly turn = new Quaternion();

  /// @param center what turning is about; @param grabbed where the hand took hold; both in the world at the grab
  constructor(
    private readonly start: WirePose,
    private readonly center: Vector3,
    private readonly grabbed: Vector3,
  ) {}

  /// Moves the wish on by a motion of the pointer.
  move(step: PointerStep, mode: DragMode): void {
    if (mode.kind === "turn") this.turnBy(step, mode.axis);
    else if (mode.axis !== null) this.moveAlong(step, kAxes[mode.axis]);
    else if (mode.kind === "depth") this.offset.addScaledVector(step.back, step.dy * step.pixel);
    else this.moveInPlane(step);
  }

  /// The wish is what a rigid motion of the world makes of the pose at the grab. Gives whether that is another one.
  follow(motion: Matrix4): boolean {
    const [offset, turn] = [this.offset.clone(), this.turn.clone()];
    motion.decompose(this.offset, this.turn, new Vector3());
    this.turn.normalize();
    this.offset.add(this.center.clone().applyQuaternion(this.turn)).sub(this.center);
    return !offset.equals(this.offset) || !turn.equals(this.turn);
  }

  /// The grabbed point where the hand wants it.
  grabbedTarget(): Vector3 {
    return this.place(this.grabbed.clone());
  }

  target(): WirePose {
    const [w, x, y, z] = this.start.rotation;
    const rotation = this.turn
      .clone()
      .multiply(new Quaternion(x, y, z, w))
      .normalize();
    const position = this.place(new Vector3(...this.start.position));
    return {
      position: [position.x, position.y, position.z],
      rotation: [rotation.w, rotation.x, rotation.y, rotation.z],
    };
  }

  private place(point: Vector3): Vector3 {
    return point.sub(this.center).applyQuaternion(this.turn).add(this.center).add(this.offset);
  }

  private moveInPlane({ before, after, back }: PointerStep): void {
    const anchor = this.grabbedTarget();
    const a = meetPlane(before, anchor, back);
    const b = meetPlane(after, anchor, back);
    if (a && b) this.offset.add(b.sub(a));
  }

  private moveAlong(step: PointerStep, axis: Vector3): void {
    const anchor = this.grabbedTarget();
    const along = Math.abs(step.back.dot(axis));
    if (along > 0.97) {
      // The axis points at the eye: up on screen is away.
      this.offset.addScaledVector(axis, Math.sign(step.back.dot(axis)) * step.dy * step.pixel);
      return;
    }
    this.offset.addScaledVector(
      axis,
      nearestOnLine(anchor, axis, step.after) - nearestOnLine(anchor, axis, step.before),
    );
  }

  private turnBy(step: PointerStep, axis: 0 | 1 | 2 | null): void {
    const { dx, dy, right, up } = step;
    const turn = new Quaternion();
    if (axis === null) {
      turn.setFromAxisAngle(up, dx * kTurnSpeed);
      turn.premultiply(new Quaternion().setFromAxisAngle(right, dy * kTurnSpeed));
    } else {
      turn.setFromAxisAngle(kAxes[axis], this.angleAbout(kAxes[axis], step) ?? (dx - dy) * kTurnSpeed);
    }
    this.turn.premultiply(turn).normalize();
  }

  /// How far the pointer has gone about an axis through the centre; null where that cannot be told: too near to it, or the
  /// axis lies across the line of sight.
  private angleAbout(axis: Vector3, { before, after, pixel }: PointerStep): number | null {
    if (Math.abs(before.direction.dot(axis)) < kLeastFacing) return null;
    const center = this.center.clone().add(this.offset);
    const [a, b] = [before, after].map((ray) => meetPlane(ray, center, axis)?.sub(center));
    if (!a || !b || Math.min(a.length(), b.length()) < kLeastArm * pixel) return null;
    return Math.atan2(axis.dot(a.clone().cross(b)), a.dot(b));
  }
}

function meetPlane(ray: Ray, point: Vector3, normal: Vector3): Vector3 | null {
  const slope = ray.direction.dot(normal);
  if (Math.abs(slope) < 1e-9) return null;
  return ray.at(point.clone().sub(ray.origin).dot(normal) / slope, new Vector3());
}

/// The parameter of the point of the line nearest to the ray's line.
function nearestOnLine(point: Vector3, axis: Vector3, ray: Ray): number {
  const between = point.clone().sub(ray.origin);
  const cross = axis.dot(ray.direction);
  return (cross * ray.direction.dot(between) - axis.dot(between)) / Math.max(1e-6, 1 - cross * cross);
}
