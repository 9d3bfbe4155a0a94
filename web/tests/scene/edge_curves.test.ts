// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { edgeCurves } from "../../src/scene/edge_curves.ts";

type Point = [number, number, number];

/// Pieces between points in their order.
function polyline(points: Point[]): number[] {
  return points.slice(1).flatMap((point, i) => [...points[i], ...point]);
}

/// Points of an arc about z, in single precision as in a surface.
function arc(radius: number, from: number, to: number, pieces: number, center: Point = [0, 0, 0]): Point[] {
  return Array.from({ length: pieces + 1 }, (_, i): Point => {
    const angle = from + ((to - from) * (i % (to - from === 2 * Math.PI ? pieces : pieces + 1))) / pieces;
    return [
      Math.fround(center[0] + radius * Math.cos(angle)),
      Math.fround(center[1] + radius * Math.sin(angle)),
      center[2],
    ];
  });
}

const curvesOf = (...pieces: number[][]) => edgeCurves(Float32Array.from(pieces.flat()));

test("the sides of a square are four lines", () => {
  const corners: Point[] = [
    [0, 0, 0],
    [3, 0, 0],
    [3, 3, 0],
    [0, 3, 0],
    [0, 0, 0],
  ];
  const curves = curvesOf(polyline(corners));
  assert.deepEqual(
    curves.map(({ feature }) => feature.kind),
    ["line", "line", "line", "line"],
  );
});

test("a line of several pieces is one", () => {
  const [curve, ...others] = curvesOf(
    polyline([
      [0, 0, 0],
      [1, 0, 0],
      [2, 0, 0],
      [3, 0, 0],
    ]),
  );
  assert.equal(others.length, 0);
  assert.ok(curve.feature.kind === "line");
  assert.equal(curve.feature.from.distanceTo(curve.feature.to), 3);
});

test("a circle has its centre, axis and radius", () => {
  const [curve, ...others] = curvesOf(polyline(arc(4, 0, 2 * Math.PI, 24, [10, 20, 30])));
  assert.equal(others.length, 0);
  assert.ok(curve.feature.kind === "circle" && curve.feature.isWhole);
  assert.ok(Math.abs(curve.feature.radius - 4) < 1e-5);
  assert.ok(curve.feature.center.distanceTo(curve.feature.center.clone().set(10, 20, 30)) < 1e-4);
  assert.ok(Math.abs(curve.feature.axis.z) > 1 - 1e-6);
});

test("the outline of a slot is two lines and two arcs", () => {
  const right = arc(2, -Math.PI / 2, Math.PI / 2, 12, [10, 0, 0]);
  const left = arc(2, Math.PI / 2, (3 * Math.PI) / 2, 12);
  const pieces = [...polyline(right), ...right[12], ...left[0], ...polyline(left), ...left[12], ...right[0]];
  const kinds = curvesOf(pieces).map(({ feature }) => feature.kind);
  assert.deepEqual(kinds.sort(), ["circle", "circle", "line", "line"]);
});

test("an arc of an ellipse is neither line nor circle", () => {
  const points = arc(4, 0, Math.PI, 24).map(([x, y, z]): Point => [Math.fround(2 * x), y, z]);
  assert.equal(curvesOf(polyline(points))[0].feature.kind, "curve");
});
