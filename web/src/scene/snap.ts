// SPDX-License-Identifier: Apache-2.0
import { Line3, Vector3 } from "three";
import { type EdgeCurve, edgeCurves } from "./edge_curves.ts";
import { FaceFinder } from "./face_feature.ts";
import { type OutlinedFeature, transformed } from "./feature.ts";
import type { ModelView, Pick } from "./model_view.ts";
import type { Surface } from "./surface.ts";

/// How near the cursor has to be to a corner and to an edge [px].
const kCornerReach = 9;
const kEdgeReach = 7;

/// Edges and faces of surfaces; found when a surface is first measured.
const known = new WeakMap<Surface, { curves: EdgeCurve[]; faces: FaceFinder }>();

function featuresOf(surface: Surface) {
  const found = known.get(surface) ?? {
    curves: edgeCurves(surface.edges),
    faces: new FaceFinder(surface.positions),
  };
  known.set(surface, found);
  return found;
}

/// The feature at a picked point, world frame: a corner or an edge that is near on screen, else the face, else the point.
/// @param pixel size of a pixel there [mm]
export function snap(model: ModelView, { component, point, face }: Pick, pixel: number): OutlinedFeature {
  const view = model.components[component];
  const { curves, faces } = featuresOf(view.shape.surface);
  const local = point.clone().applyMatrix4(view.object.matrix.clone().invert());
  const found = cornerNear(curves, local, kCornerReach * pixel) ??
    curveNear(curves, local, kEdgeReach * pixel) ??
    faces.at(face) ?? { feature: { kind: "point", point: local }, outline: [] };
  return transformed(found, view.object.matrix);
}

/// The face at a picked point, world frame; null if it is neither a plane nor a cylinder.
export function faceAt(model: ModelView, { component, face }: Pick): OutlinedFeature | null {
  const view = model.components[component];
  const found = featuresOf(view.shape.surface).faces.at(face);
  return found && transformed(found, view.object.matrix);
}

function cornerNear(curves: EdgeCurve[], point: Vector3, reach: number): OutlinedFeature | null {
  let [best, least]: [Vector3 | null, number] = [null, reach];
  for (const { points, isClosed } of curves) {
    if (isClosed) continue;
    for (const corner of [points[0], points[points.length - 1]]) {
      const distance = corner.distanceTo(point);
      if (distance < least) [best, least] = [corner, distance];
    }
  }
  return best && { feature: { kind: "point", point: best }, outline: [] };
}

function curveNear(curves: EdgeCurve[], point: Vector3, reach: number): OutlinedFeature | null {
  let [best, least]: [EdgeCurve | null, number] = [null, reach];
  const nearest = new Vector3();
  for (const curve of curves)
    for (let i = 0; i + 1 < curve.points.length; ++i) {
      new Line3(curve.points[i], curve.points[i + 1]).closestPointToPoint(point, true, nearest);
      const distance = nearest.distanceTo(point);
      if (distance < least) [best, least] = [curve, distance];
    }
  return best;
}
