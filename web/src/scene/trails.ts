// SPDX-License-Identifier: Apache-2.0
import { Matrix4, type Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { type GuideStep, poseAt } from "../guide.ts";
import { setMatrixFromPose } from "./model_view.ts";

/// Pieces of a trail shorter than this part of the assembly are left out.
const kFine = 0.002;

/// Lines along which components have come.
export class Trails {
  readonly object = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 1.6 }));

  constructor() {
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /// @param segments both ends of each piece, world [mm]
  show(segments: Vector3[], color: string): void {
    this.object.visible = segments.length > 0;
    if (segments.length === 0) return;
    // A geometry's buffers keep the size that they had first.
    this.object.geometry.dispose();
    this.object.geometry = new LineSegmentsGeometry().setPositions(segments.flatMap((point) => point.toArray()));
    this.object.material.color.set(color);
  }
}

/// The ways of the components' centres until a time [s] of a path: both ends of each piece.
/// @param center of a component, assembled; @param size of the assembly [mm]
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
    const matrices = poses.map((pose) => setMatrixFromPose(new Matrix4(), pose));
    for (const component of step.components) {
      const way = matrices.map((matrix) => center(component).applyMatrix4(matrix));
      segments.push(...piecesOf(way, kFine * size));
    }
  }
  return segments;
}

function piecesOf(way: Vector3[], least: number): Vector3[] {
  const pieces: Vector3[] = [];
  let from = way[0];
  way.forEach((point, i) => {
    const long = point.distanceTo(from);
    if (long === 0 || (long < least && i + 1 < way.length)) return;
    pieces.push(from, point);
    from = point;
  });
  return pieces;
}
