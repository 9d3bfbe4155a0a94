// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { type OutlinedFeature, PointIds, pointAt } from "./feature.ts";

/// Edges go on where they turn by less [rad]: more than between two chords of an arc, less than at a corner.
const kMaxTurn = 0.62;
/// Edges end where the length of their pieces changes by more: a straight edge goes over into an arc.
const kMaxLengthRatio = 2.5;
/// A curve is a line or an arc if its points are this near, as a fraction of its length or radius.
const kLineFit = 1e-3;
const kCircleFit = 2e-3;
/// Pieces of an arc at least.
const kMinArcPieces = 3;

/// An edge of a surface, from corner to corner: its points in their order.
export interface EdgeCurve extends OutlinedFeature {
  points: Vector3[];
  isClosed: boolean;
}

/// The edges of a surface: straight ones, arcs and circles, and others. @param edges shape [edge_count, 2, 3]
export function edgeCurves(edges: Float32Array): EdgeCurve[] {
  const graph = new EdgeGraph(edges);
  return graph.chains().map(({ points, isClosed }) => ({
    points,
    isClosed,
    feature: featureOf(points, isClosed),
    outline: points.slice(1).flatMap((point, i) => [points[i], point]),
  }));
}

interface Chain {
  points: Vector3[];
  isClosed: boolean;
}

/// Pieces of edges, connected at equal points.
class EdgeGraph {
  private readonly ends: [number, number][] = []; // of each piece
  private readonly pieces: number[][] = []; // at each point
  private readonly positions: Vector3[] = [];

  constructor(edges: Float32Array) {
    const ids = new PointIds(edges);
    for (let i = 0; i < edges.length / 6; ++i) {
      const [a, b] = [ids.of(2 * i), ids.of(2 * i + 1)];
      this.positions[a] ??= pointAt(edges, 2 * i);
      this.positions[b] ??= pointAt(edges, 2 * i + 1);
      if (a === b) continue;
      this.ends.push([a, b]);
      for (const point of [a, b]) {
        this.pieces[point] ??= [];
        this.pieces[point].push(this.ends.length - 1);
      }
    }
  }

  chains(): Chain[] {
    const used = new Set<number>();
    const chains: Chain[] = [];
    // From corners first; what is left has none.
    const starts = this.ends.map((_, piece) => piece).sort((a, b) => Number(this.isInner(a)) - Number(this.isInner(b)));
    for (const piece of starts) {
      if (used.has(piece)) continue;
      const [a, b] = this.ends[piece];
      const first = this.next(a, piece) === null ? a : b;
      chains.push(this.walk(first, piece, used));
    }
    return chains;
  }

  /// True if a piece goes on at both ends.
  private isInner(piece: number): boolean {
    return this.ends[piece].every((point) => this.next(point, piece) !== null);
  }

  private walk(start: number, piece: number, used: Set<number>): Chain {
    const points = [start];
    let at = start;
    for (let now: number | null = piece; now !== null && !used.has(now); now = this.next(at, now)) {
      used.add(now);
      at = this.otherEnd(now, at);
      points.push(at);
    }
    return { points: points.map((point) => this.positions[point]), isClosed: at === start };
  }

  private otherEnd(piece: number, point: number): number {
    const [a, b] = this.ends[piece];
    return a === point ? b : a;
  }

  /// The piece with which an edge goes on at the end of another one; null: there is a corner.
  private next(point: number, piece: number): number | null {
    const others = this.pieces[point];
    if (others.length !== 2) return null;
    const other = others[0] === piece ? others[1] : others[0];
    const before = this.positions[point].clone().sub(this.positions[this.otherEnd(piece, point)]);
    const after = this.positions[this.otherEnd(other, point)].clone().sub(this.positions[point]);
    const ratio = before.length() / after.length();
    if (before.angleTo(after) > kMaxTurn || ratio > kMaxLengthRatio || ratio < 1 / kMaxLengthRatio) return null;
    return other;
  }
}

function featureOf(points: Vector3[], isClosed: boolean): EdgeCurve["feature"] {
  const [from, to] = [points[0], points[points.length - 1]];
  const length = points.slice(1).reduce((sum, point, i) => sum + point.distanceTo(points[i]), 0);
  if (!isClosed && points.every((point) => distanceToLine(point, from, to) <= kLineFit * length))
    return { kind: "line", from, to };
  return circleOf(points, isClosed) ?? { kind: "curve", length, point: points[Math.floor(points.length / 2)] };
}

function circleOf(points: Vector3[], isClosed: boolean): EdgeCurve["feature"] | null {
  if (points.length - 1 < kMinArcPieces) return null;
  const last = isClosed ? points.length - 1 - Math.floor(points.length / 3) : points.length - 1;
  const circle = circleThrough(points[0], points[Math.floor(last / 2)], points[last]);
  if (!circle) return null;
  const { center, axis, radius } = circle;
  const fits = points.every((point) => {
    const arm = point.clone().sub(center);
    return Math.hypot(arm.length() - radius, arm.dot(axis)) <= kCircleFit * radius;
  });
  return fits ? { kind: "circle", center, axis, radius, isWhole: isClosed } : null;
}

/// The circle through three points; null if they are in a line.
function circleThrough(a: Vector3, b: Vector3, c: Vector3) {
  const [u, v] = [b.clone().sub(a), c.clone().sub(a)];
  const axis = new Vector3().crossVectors(u, v);
  const area = axis.lengthSq();
  if (area <= 1e-12 * u.lengthSq() * v.lengthSq()) return null;
  const toCenter = new Vector3()
    .crossVectors(axis, u)
    .multiplyScalar(v.lengthSq())
    .add(new Vector3().crossVectors(v, axis).multiplyScalar(u.lengthSq()))
    .multiplyScalar(1 / (2 * area));
  return { center: a.clone().add(toCenter), axis: axis.normalize(), radius: toCenter.length() };
}

function distanceToLine(point: Vector3, from: Vector3, to: Vector3): number {
  const along = to.clone().sub(from).normalize();
  const arm = point.clone().sub(from);
  return arm.addScaledVector(along, -arm.dot(along)).length();
}
