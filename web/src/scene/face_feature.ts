// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { type OutlinedFeature, PointIds, pointAt } from "./feature.ts";
import { kCreaseAngle } from "./surface.ts";

/// Triangles whose normals differ by less are of one plane [rad].
const kSamePlane = 0.01;
/// Normals of a cylinder are perpendicular to its axis up to this much [rad].
const kPerpendicular = 0.02;
/// The corners of a cylinder are this near to it, as a fraction of its radius.
const kCylinderFit = 0.01;
/// Different normals that make a cylinder.
const kMinFacets = 4;

/// The faces of a surface: planes and cylinders, found around a triangle. In the surface's own frame.
export class FaceFinder {
  private readonly corners: Uint32Array; // ids of points, shape [triangle_count, 3]
  private readonly normals: Vector3[];
  private readonly sides = new Map<string, number[]>(); // the triangles at each side

  /// @param positions shape [triangle_count, 3, 3]
  constructor(private readonly positions: Float32Array) {
    const ids = new PointIds(positions);
    const count = positions.length / 9;
    this.corners = Uint32Array.from({ length: 3 * count }, (_, i) => ids.of(i));
    this.normals = Array.from({ length: count }, (_, t) => this.computeNormal(t));
    for (let t = 0; t < count; ++t)
      for (const side of this.sidesOf(t)) this.sides.set(side, [...(this.sides.get(side) ?? []), t]);
  }

  /// The face that a triangle belongs to; null if it is neither plane nor cylinder.
  at(triangle: number): OutlinedFeature | null {
    const normal = this.normals[triangle];
    const smooth = this.grow(triangle, (t, from) => this.normals[t].angleTo(this.normals[from]) < kCreaseAngle);
    const plane = this.grow(triangle, (t) => this.normals[t].angleTo(normal) < kSamePlane);
    if (plane.length < smooth.length) {
      const cylinder = this.cylinder(triangle, smooth);
      if (cylinder) return cylinder;
      // One facet of a curved face is no plane to measure.
      if (plane.length <= 2) return null;
    }
    const point = pointAt(this.positions, 3 * triangle);
    return { feature: { kind: "plane", point, normal }, outline: this.outline(plane) };
  }

  private cylinder(triangle: number, smooth: number[]): OutlinedFeature | null {
    const normal = this.normals[triangle];
    const other = smooth.find((t) => this.normals[t].angleTo(normal) > kSamePlane);
    if (other === undefined) return null;
    const axis = new Vector3().crossVectors(normal, this.normals[other]).normalize();
    const isAround = (t: number) => Math.abs(this.normals[t].dot(axis)) < kPerpendicular;
    const around = this.grow(
      triangle,
      (t, from) => isAround(t) && this.normals[t].angleTo(this.normals[from]) < kCreaseAngle,
    );
    const facets = new Set(
      around.map((t) =>
        this.normals[t]
          .toArray()
          .map((value) => Math.round(50 * value))
          .join(),
      ),
    );
    if (facets.size < kMinFacets) return null;
    const points = around.flatMap((t) => [0, 1, 2].map((k) => pointAt(this.positions, 3 * t + k)));
    const circle = fitCircle(points, axis);
    if (!circle) return null;
    return { feature: { kind: "cylinder", axis, ...circle }, outline: this.outline(around) };
  }

  /// The triangles that are connected with one, in the order in which they are reached.
  private grow(triangle: number, accepts: (triangle: number, from: number) => boolean): number[] {
    const found = [triangle];
    const seen = new Set(found);
    for (const from of found)
      for (const side of this.sidesOf(from))
        for (const t of this.sides.get(side) ?? []) {
          if (seen.has(t) || !accepts(t, from)) continue;
          seen.add(t);
          found.push(t);
        }
    return found;
  }

  /// The sides that only one of some triangles has.
  private outline(triangles: number[]): Vector3[] {
    const inside = new Set(triangles);
    return triangles.flatMap((t) =>
      this.sidesOf(t).flatMap((side, k) => {
        const isInner = (this.sides.get(side) ?? []).some((other) => other !== t && inside.has(other));
        return isInner ? [] : [pointAt(this.positions, 3 * t + k), pointAt(this.positions, 3 * t + ((k + 1) % 3))];
      }),
    );
  }

  private sidesOf(triangle: number): string[] {
    const corner = (k: number) => this.corners[3 * triangle + (k % 3)];
    return [0, 1, 2].map((k) => {
      const [a, b] = [corner(k), corner(k + 1)];
      return a < b ? `${a} ${b}` : `${b} ${a}`;
    });
  }

  private computeNormal(triangle: number): Vector3 {
    const [a, b, c] = [0, 1, 2].map((k) => pointAt(this.positions, 3 * triangle + k));
    return b.sub(a).cross(c.sub(a)).normalize();
  }
}

/// The circle through points seen along an axis, by least squares; null if they are not near one.
function fitCircle(points: Vector3[], axis: Vector3): { point: Vector3; radius: number } | null {
  const u = (Math.abs(axis.x) < 0.8 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).cross(axis).normalize();
  const v = new Vector3().crossVectors(axis, u);
  const origin = points.reduce((sum, p) => sum.add(p), new Vector3()).multiplyScalar(1 / points.length);
  const flat = points.map((p) => {
    const arm = p.clone().sub(origin);
    return [arm.dot(u), arm.dot(v)] as const;
  });
  // x^2 + y^2 = 2 a x + 2 b y + c about the centroid, where the sums of x and of y are 0.
  let [xx, xy, yy, xr, yr, r] = [0, 0, 0, 0, 0, 0];
  for (const [x, y] of flat) {
    const square = x * x + y * y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xr += x * square;
    yr += y * square;
    r += square;
  }
  const determinant = 4 * (xx * yy - xy * xy);
  if (determinant <= 1e-12 * r * r) return null;
  const a = (2 * (xr * yy - yr * xy)) / determinant;
  const b = (2 * (yr * xx - xr * xy)) / determinant;
  const radius = Math.sqrt(r / flat.length + a * a + b * b);
  if (flat.some(([x, y]) => Math.abs(Math.hypot(x - a, y - b) - radius) > kCylinderFit * radius)) return null;
  return { point: origin.addScaledVector(u, a).addScaledVector(v, b), radius };
}
