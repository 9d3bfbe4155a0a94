// SPDX-License-Identifier: Apache-2.0
import type { Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { type GuideStep, poseAt } from "../guide.ts";
import { matrixOf } from "../pose.ts";

/// Shorter pieces of a trail are merged, as a fraction of the assembly's size.
const kMinPieceFraction = 0.002;

/// Lines along the paths that components have taken.
export class Trails {
  readonly object = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 1.6 }));

  constructor() {
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /// @param segments both ends of each piece, world frame [mm]
  show(segments: Vector3[], color: string): void {
    this.object.visible = segments.length > 0;
    if (segments.length === 0) return;
    // The buffers of a LineSegmentsGeometry cannot grow.
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry().setPositions(segments.flatMap((point) => point.toArray()));
    this.object.material.color.set(color);
  }
}

/// Trails of the components' centres up to a time [s] of a path: both ends of each piece. @param center of a component
/// when assembled; @param size of the assembly [mm]
export function trailsUntil(
  steps: GuideStep[],
  time: number,
  center: (component: number) => Vector3,
  size: number,
): Vector3[] {
  const segments: Vector3[] = [];
  let start = 0;
  for (const step of steps) {
    const local = time - start;
    start += step.duration;
    if (local <= 0) break;
    const poses = [...step.frames.filter(({ t }) => t < local).map(({ pose }) => pose), poseAt(step, local)];
    const matrices = poses.map((pose) => matrixOf(pose));
    for (const component of step.components) {
      const points = matrices.map((matrix) => center(component).applyMatrix4(matrix));
      segments.push(...piecesOf(points, kMinPieceFraction * size));
    }
  }
  return segments;
}

function piecesOf(points: Vector3[], minLength: number): Vector3[] {
  const pieces: Vector3[] = [];
  let from = points[0];
  points.forEach((point, i) => {
    const length = point.distanceTo(from);
    if (length === 0 || (length < minLength && i + 1 < points.length)) return;
    pieces.push(from, point);
    from = point;
  });
  return pieces;
}
