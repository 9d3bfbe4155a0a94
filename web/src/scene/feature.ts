// SPDX-License-Identifier: Apache-2.0
import { type Matrix4, Vector3 } from "three";

/// What a point of a surface belongs to, and can be measured: a corner or another point, an edge, or a face.
export type Feature =
  | { kind: "point"; point: Vector3 }
  | { kind: "line"; from: Vector3; to: Vector3 }
  | { kind: "circle"; center: Vector3; axis: Vector3; radius: number; isWhole: boolean }
  | { kind: "curve"; length: number; point: Vector3 }
  | { kind: "plane"; point: Vector3; normal: Vector3 }
  | { kind: "cylinder"; point: Vector3; axis: Vector3; radius: number };

/// A feature, and the lines that show it: both ends of each [mm].
export interface OutlinedFeature {
  feature: Feature;
  outline: Vector3[];
}

/// A feature in another frame. @param matrix a rigid motion
export function transformed({ feature, outline }: OutlinedFeature, matrix: Matrix4): OutlinedFeature {
  const point = (p: Vector3) => p.clone().applyMatrix4(matrix);
  const direction = (d: Vector3) => d.clone().transformDirection(matrix);
  const moved = outline.map(point);
  switch (feature.kind) {
    case "point":
    case "curve":
      return { feature: { ...feature, point: point(feature.point) }, outline: moved };
    case "line":
      return { feature: { ...feature, from: point(feature.from), to: point(feature.to) }, outline: moved };
    case "circle":
      return {
        feature: { ...feature, center: point(feature.center), axis: direction(feature.axis) },
        outline: moved,
      };
    case "plane":
      return {
        feature: { ...feature, point: point(feature.point), normal: direction(feature.normal) },
        outline: moved,
      };
    case "cylinder":
      return { feature: { ...feature, point: point(feature.point), axis: direction(feature.axis) }, outline: moved };
  }
}

/// Numbers points at equal positions equally.
export class PointIds {
  private readonly ids = new Map<string, number>();

  /// @param points shape [point_count, 3]
  constructor(private readonly points: Float32Array) {}

  /// The number of the point at an index.
  of(index: number): number {
    const key = `${this.points[3 * index]} ${this.points[3 * index + 1]} ${this.points[3 * index + 2]}`;
    const known = this.ids.get(key);
    if (known !== undefined) return known;
    this.ids.set(key, this.ids.size);
    return this.ids.size - 1;
  }
}

/// The point at an index of shape [point_count, 3].
export function pointAt(points: Float32Array, index: number): Vector3 {
  return new Vector3(points[3 * index], points[3 * index + 1], points[3 * index + 2]);
}
