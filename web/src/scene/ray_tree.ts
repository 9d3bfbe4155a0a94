// SPDX-License-Identifier: Apache-2.0
import type { Ray, Vector3 } from "three";

/// The first intersection of a ray with a surface.
export interface RayHit {
  distance: number;
  face: number;
}

const kLeafFaces = 6;

/// A bounding volume hierarchy over the faces of a surface, for ray queries in the surface's own frame.
export class RayTree {
  private readonly order: Uint32Array;
  private readonly boxes: number[] = [];
  /// Leaf: first index in `order`, and the face count. Inner node: the right child, and 0; the left child follows the
  /// node.
  private readonly links: number[] = [];

  /// @param corners shape [face_count, 3, 3]
  constructor(private readonly corners: Float32Array) {
    const faceCount = corners.length / 9;
    this.order = Uint32Array.from({ length: faceCount }, (_, i) => i);
    const centers = new Float32Array(3 * faceCount);
    for (let f = 0; f < faceCount; ++f)
      for (let k = 0; k < 3; ++k)
        centers[3 * f + k] = corners[9 * f + k] + corners[9 * f + 3 + k] + corners[9 * f + 6 + k];
    if (faceCount > 0) this.build(0, faceCount, centers);
  }

  /// The first face along the ray, from either side, or null.
  cast(ray: Ray): RayHit | null {
    if (this.links.length === 0) return null;
    let best: RayHit | null = null;
    const stack = [0];
    while (stack.length > 0) {
      const node = stack.pop()!;
      if (this.entryDistance(node, ray) >= (best?.distance ?? Number.POSITIVE_INFINITY)) continue;
      const [link, count] = [this.links[2 * node], this.links[2 * node + 1]];
      if (count === 0) {
        stack.push(link, node + 1);
        continue;
      }
      for (let i = link; i < link + count; ++i) {
        const distance = this.intersectFace(this.order[i], ray.origin, ray.direction);
        if (distance < (best?.distance ?? Number.POSITIVE_INFINITY)) best = { distance, face: this.order[i] };
      }
    }
    return best;
  }

  private build(begin: number, end: number, centers: Float32Array): void {
    const node = this.links.length / 2;
    const box = this.bounds(begin, end);
    this.boxes.push(...box);
    this.links.push(begin, end - begin);
    if (end - begin <= kLeafFaces) return;
    const extent = [box[3] - box[0], box[4] - box[1], box[5] - box[2]];
    const axis = extent.indexOf(Math.max(...extent));
    this.order.subarray(begin, end).sort((a, b) => centers[3 * a + axis] - centers[3 * b + axis]);
    const middle = (begin + end) >>> 1;
    this.build(begin, middle, centers);
    this.links[2 * node] = this.links.length / 2;
    this.links[2 * node + 1] = 0;
    this.build(middle, end, centers);
  }

  private bounds(begin: number, end: number): number[] {
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (let i = begin; i < end; ++i) {
      for (let c = 0; c < 9; ++c) {
        const value = this.corners[9 * this.order[i] + c];
        box[c % 3] = Math.min(box[c % 3], value);
        box[3 + (c % 3)] = Math.max(box[3 + (c % 3)], value);
      }
    }
    return box;
  }

  /// Distance at which the ray enters a node's box; infinite if it misses.
  private entryDistance(node: number, ray: Ray): number {
    const origin = [ray.origin.x, ray.origin.y, ray.origin.z];
    const direction = [ray.direction.x, ray.direction.y, ray.direction.z];
    let [near, far] = [0, Number.POSITIVE_INFINITY];
    for (let k = 0; k < 3; ++k) {
      const low = this.boxes[6 * node + k] - origin[k];
      const high = this.boxes[6 * node + 3 + k] - origin[k];
      if (direction[k] === 0) {
        if (low > 0 || high < 0) return Number.POSITIVE_INFINITY;
        continue;
      }
      const [a, b] = [low / direction[k], high / direction[k]];
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    return near <= far ? near : Number.POSITIVE_INFINITY;
  }

  /// Möller-Trumbore test: distance to the face; infinite if the ray misses.
  private intersectFace(face: number, origin: Vector3, direction: Vector3): number {
    const c = this.corners.subarray(9 * face, 9 * face + 9);
    const [ux, uy, uz, vx, vy, vz] = [c[3] - c[0], c[4] - c[1], c[5] - c[2], c[6] - c[0], c[7] - c[1], c[8] - c[2]];
    const px = direction.y * vz - direction.z * vy;
    const py = direction.z * vx - direction.x * vz;
    const pz = direction.x * vy - direction.y * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) return Number.POSITIVE_INFINITY;
    const [tx, ty, tz] = [origin.x - c[0], origin.y - c[1], origin.z - c[2]];
    const u = (tx * px + ty * py + tz * pz) / determinant;
    const [qx, qy, qz] = [ty * uz - tz * uy, tz * ux - tx * uz, tx * uy - ty * ux];
    const v = (direction.x * qx + direction.y * qy + direction.z * qz) / determinant;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance >= 0 ? distance : Number.POSITIVE_INFINITY;
  }
}
