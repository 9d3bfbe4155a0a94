// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { measureBetween } from "../src/measurement.ts";
import type { Feature } from "../src/scene/feature.ts";

const plane = (z: number, normal = new Vector3(0, 0, 1)): Feature => ({
  kind: "plane",
  point: new Vector3(7, 8, z),
  normal,
});
const point = (x: number, y: number, z: number): Feature => ({ kind: "point", point: new Vector3(x, y, z) });
const cylinder = (x: number, axis = new Vector3(0, 0, 1)): Feature => ({
  kind: "cylinder",
  point: new Vector3(x, 0, 3),
  axis,
  radius: 1,
});
const circle = (x: number): Feature => ({
  kind: "circle",
  center: new Vector3(x, 0, 0),
  axis: new Vector3(0, 0, 1),
  radius: 2,
  isWhole: true,
});

const distance = (a: Feature, b: Feature): number => {
  const measured = measureBetween(a, b);
  assert.ok(measured.kind === "distance");
  return measured.from.distanceTo(measured.to);
};
const angle = (a: Feature, b: Feature): number => {
  const measured = measureBetween(a, b);
  assert.ok(measured.kind === "angle");
  return (measured.angle * 180) / Math.PI;
};

test("parallel faces have a distance, others an angle", () => {
  assert.equal(distance(plane(2), plane(12)), 10);
  assert.equal(distance(plane(2), plane(12, new Vector3(0, 0, -1))), 10);
  assert.ok(Math.abs(angle(plane(2), plane(0, new Vector3(0, 1, 1).normalize())) - 45) < 1e-9);
});

test("holes are measured between their axes, circles between their centres", () => {
  assert.equal(distance(cylinder(0), cylinder(25)), 25);
  assert.equal(distance(circle(0), circle(30)), 30);
  assert.equal(distance(circle(0), cylinder(4)), 4);
});

test("points are measured to faces and edges at right angles", () => {
  assert.equal(distance(point(0, 0, 5), plane(2)), 3);
  assert.equal(distance(plane(2), point(0, 0, 5)), 3);
  const edge: Feature = { kind: "line", from: new Vector3(1, 0, 0), to: new Vector3(2, 0, 0) };
  assert.equal(distance(point(50, 3, 4), edge), 5);
  assert.equal(distance(edge, plane(9)), 9);
  assert.ok(Math.abs(angle(edge, plane(0, new Vector3(1, 0, 0))) - 90) < 1e-9);
});
