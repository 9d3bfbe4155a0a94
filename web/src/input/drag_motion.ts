// SPDX-License-Identifier: Apache-2.0
import { type Matrix4, Quaternion, type Ray, Vector3 } from "three";
import { type Axis, kAxisVectors } from "../axes.ts";
import { rotationOf } from "../pose.ts";
import type { WirePose } from "../wire/structs.ts";

/// Interpretation of pointer motion: in the plane of the screen, in depth, as rotation, or locked to an axis.
export interface DragMode {
  kind: "plane" | "depth" | "turn";
  /// World axis that locks the translation or the rotation.
  axis: Axis | null;
}

/// A pointer motion, in terms of the world.
export interface PointerStep {
  before: Ray;
  after: Ray;
  dx: number;
  dy: number;
  /// Unit axes of the screen, world frame.
  right: Vector3;
  up: Vector3;
  back: Vector3;
  /// Size of a pixel at the grabbed point [mm].
  pixel: number;
}

/// Rotation about an axis follows the pointer around it only from this distance [px], and only if the cosine of the
/// axis with the line of sight is at least this.
const kMinLeverArm = 8;
const kMinFacing = 0.3;
/// Rotation for a pixel of pointer motion [rad].
const kTurnSpeed = 0.01;
/// Axes whose cosine with the line of sight exceeds this cannot be followed on screen.
const kMaxAlignment = 0.97;

/// The target pose of a dragged set: its start pose rotated about its centre and translated. It is only ever sent,
/// never drawn as the component's pose.
export class DragMotion {
  /// Translation and rotation of the target since the start, world frame.
  readonly offset = new Vector3();
  readonly turn = new Quaternion();

  /// @param center of rotation; @param grabbed point; both in the world frame when the drag starts
  constructor(
    private readonly start: WirePose,
    private readonly center: Vector3,
    private readonly grabbed: Vector3,
  ) {}

  /// Moves the target by a pointer motion.
  move(step: PointerStep, mode: DragMode): void {
    if (mode.kind === "turn") this.rotateBy(step, mode.axis);
    else if (mode.axis !== null) this.moveAlong(step, kAxisVectors[mode.axis]);
    else if (mode.kind === "depth") this.offset.addScaledVector(step.back, step.dy * step.pixel);
    else this.moveInPlane(step);
  }

  /// Sets the target to the start pose moved by a rigid motion of the world. Returns true if the target changed.
  follow(motion: Matrix4): boolean {
    const [offset, turn] = [this.offset.clone(), this.turn.clone()];
    motion.decompose(this.offset, this.turn, new Vector3());
    this.turn.normalize();
    this.offset.add(this.center.clone().applyQuaternion(this.turn)).sub(this.center);
    return !offset.equals(this.offset) || !turn.equals(this.turn);
  }

  /// The target of the grabbed point, world frame [mm].
  grabbedTarget(): Vector3 {
    return this.moved(this.grabbed.clone());
  }

  /// The target pose.
  target(): WirePose {
    const rotation = this.turn.clone().multiply(rotationOf(this.start)).normalize();
    const position = this.moved(new Vector3(...this.start.position));
    return {
      position: [position.x, position.y, position.z],
      rotation: [rotation.w, rotation.x, rotation.y, rotation.z],
    };
  }

  private moved(point: Vector3): Vector3 {
    return point.sub(this.center).applyQuaternion(this.turn).add(this.center).add(this.offset);
  }

  private moveInPlane({ before, after, back }: PointerStep): void {
    const anchor = this.grabbedTarget();
    const a = intersectPlane(before, anchor, back);
    const b = intersectPlane(after, anchor, back);
    if (a && b) this.offset.add(b.sub(a));
  }

  private moveAlong(step: PointerStep, axis: Vector3): void {
    const anchor = this.grabbedTarget();
    const along = Math.abs(step.back.dot(axis));
    if (along > kMaxAlignment) {
      // The axis points at the eye: upwards on screen means away.
      this.offset.addScaledVector(axis, Math.sign(step.back.dot(axis)) * step.dy * step.pixel);
      return;
    }
    this.offset.addScaledVector(
      axis,
      closestOnLine(anchor, axis, step.after) - closestOnLine(anchor, axis, step.before),
    );
  }

  private rotateBy(step: PointerStep, axis: Axis | null): void {
    const { dx, dy, right, up } = step;
    const turn = new Quaternion();
    if (axis === null) {
      turn.setFromAxisAngle(up, dx * kTurnSpeed);
      turn.premultiply(new Quaternion().setFromAxisAngle(right, dy * kTurnSpeed));
    } else {
      turn.setFromAxisAngle(kAxisVectors[axis], this.angleAbout(kAxisVectors[axis], step) ?? (dx - dy) * kTurnSpeed);
    }
    this.turn.premultiply(turn).normalize();
  }

  /// Rotation of the pointer about an axis through the centre [rad]; null if the pointer is too close to it, or the
  /// axis is nearly perpendicular to the line of sight.
  private angleAbout(axis: Vector3, { before, after, pixel }: PointerStep): number | null {
    if (Math.abs(before.direction.dot(axis)) < kMinFacing) return null;
    const center = this.center.clone().add(this.offset);
    const [a, b] = [before, after].map((ray) => intersectPlane(ray, center, axis)?.sub(center));
    if (!a || !b || Math.min(a.length(), b.length()) < kMinLeverArm * pixel) return null;
    return Math.atan2(axis.dot(a.clone().cross(b)), a.dot(b));
  }
}

function intersectPlane(ray: Ray, point: Vector3, normal: Vector3): Vector3 | null {
  const slope = ray.direction.dot(normal);
  if (Math.abs(slope) < 1e-9) return null;
  return ray.at(point.clone().sub(ray.origin).dot(normal) / slope, new Vector3());
}

/// Parameter of the point of the line that is closest to the ray's line.
function closestOnLine(point: Vector3, axis: Vector3, ray: Ray): number {
  const between = point.clone().sub(ray.origin);
  const cross = axis.dot(ray.direction);
  return (cross * ray.direction.dot(between) - axis.dot(between)) / Math.max(1e-6, 1 - cross * cross);
}
