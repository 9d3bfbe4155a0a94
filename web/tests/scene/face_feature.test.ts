// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { FaceFinder } from "../../src/scene/face_feature.ts";

/// A cylinder about z with its two ends: the triangles of the side first.
function cylinder(radius: number, height: number, sides: number): Float32Array {
  const corner = (i: number, z: number) => {
    const angle = (2 * Math.PI * (i % sides)) / sides;
    return [radius * Math.cos(angle), radius * Math.sin(angle), z];
  };
  const side: number[] = [];
  const ends: number[] = [];
  for (let i = 0; i < sides; ++i) {
    const [a, b, c, d] = [corner(i, 0), corner(i + 1, 0), corner(i + 1, height), corner(i, height)];
    side.push(...a, ...b, ...c, ...a, ...c, ...d);
    ends.push(0, 0, 0, ...b, ...a, 0, 0, height, ...d, ...c);
  }
  return Float32Array.from([...side, ...ends]);
}

test("the side of a cylinder has its radius and axis", () => {
  const faces = new FaceFinder(cylinder(5, 20, 32));
  for (const triangle of [0, 1, 17, 63]) {
    const feature = faces.at(triangle)?.feature;
    assert.ok(feature?.kind === "cylinder");
    assert.ok(Math.abs(feature.radius - 5) < 1e-4, `${feature.radius}`);
    assert.ok(Math.abs(feature.axis.z) > 1 - 1e-6);
    assert.ok(Math.hypot(feature.point.x, feature.point.y) < 1e-4);
  }
});

test("its end is a plane, outlined by its rim", () => {
  const found = new FaceFinder(cylinder(5, 20, 32)).at(64);
  assert.ok(found?.feature.kind === "plane");
  assert.equal(found.feature.normal.z, -1);
  assert.equal(found.outline.length, 2 * 32);
  assert.ok(found.outline.every(({ x, y }) => Math.abs(Math.hypot(x, y) - 5) < 1e-4));
});

test("the side of a cone is neither", () => {
  const corners = cylinder(5, 20, 32);
  for (let i = 0; i < corners.length; i += 3)
    if (corners[i + 2] > 0) corners.set([corners[i] / 2, corners[i + 1] / 2], i);
  assert.equal(new FaceFinder(corners).at(0), null);
});
