// SPDX-License-Identifier: Apache-2.0
import type { Vector3 } from "three";
import type { Feature } from "./scene/feature.ts";

/// Directions that differ by less are parallel [rad].
const kParallel = 1e-3;

/// A point, a line without ends or a plane, to which distances are measured.
type Primitive =
  | { kind: "point"; point: Vector3 }
  | { kind: "line"; point: Vector3; direction: Vector3 }
  | { kind: "plane"; point: Vector3; direction: Vector3 };

/// The measure between two features: a distance with the points where it is taken, or an angle [rad].
export type Measurement = { kind: "distance"; from: Vector3; to: Vector3 } | { kind: "angle"; angle: number };

/// Measures between two features: between centres of circles, axes of cylinders, lines and planes without ends; their
/// angle where they are not parallel.
export function measureBetween(a: Feature, b: Feature): Measurement {
  return between(primitiveOf(a), primitiveOf(b));
}

function primitiveOf(feature: Feature): Primitive {
  switch (feature.kind) {
    case "point":
    case "curve":
      return { kind: "point", point: feature.point };
    case "line":
      return { kind: "line", point: feature.from, direction: feature.to.clone().sub(feature.from).normalize() };
    case "circle":
      return { kind: "point", point: feature.center };
    case "plane":
      return { kind: "plane", point: feature.point, direction: feature.normal };
    case "cylinder":
      return { kind: "line", point: feature.point, direction: feature.axis };
  }
}

function between(a: Primitive, b: Primitive): Measurement {
  if (a.kind === "point" && b.kind === "point") return { kind: "distance", from: a.point, to: b.point };
  if (a.kind === "point") return { kind: "distance", from: a.point, to: projected(a.point, b) };
  if (b.kind === "point") return { kind: "distance", from: projected(b.point, a), to: b.point };
  const cosine = Math.min(1, Math.abs(a.direction.dot(b.direction)));
  const angle = Math.acos(cosine);
  if (a.kind === b.kind)
    return angle < kParallel
      ? { kind: "distance", from: projected(b.point, a), to: b.point }
      : { kind: "angle", angle };
  // A line and a plane.
  const slope = Math.PI / 2 - angle;
  const line = a.kind === "line" ? a : b;
  const plane = a.kind === "line" ? b : a;
  if (slope > kParallel) return { kind: "angle", angle: slope };
  return { kind: "distance", from: line.point, to: projected(line.point, plane) };
}

/// The nearest point of a line or a plane.
function projected(point: Vector3, { kind, point: origin, direction }: Primitive & { direction?: Vector3 }): Vector3 {
  const arm = point.clone().sub(origin);
  const along = direction!.clone().multiplyScalar(arm.dot(direction!));
  return kind === "line" ? origin.clone().add(along) : point.clone().sub(along);
}
