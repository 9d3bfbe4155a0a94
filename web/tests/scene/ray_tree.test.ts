// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Ray, Vector3 } from "three";
import { RayTree } from "../../src/scene/ray_tree.ts";

/// A generator of numbers in [0, 1), reproducible.
function random(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function triangles(count: number, next: () => number): Float32Array {
  const corners = new Float32Array(9 * count);
  for (let f = 0; f < count; ++f) {
    const center = [next() * 20, next() * 20, next() * 20];
    for (let k = 0; k < 9; ++k) corners[9 * f + k] = center[k % 3] + next() * 2 - 1;
  }
  return corners;
}

test("the tree finds what testing every face finds", () => {
  const next = random(7);
  const corners = triangles(500, next);
  const all = new RayTree(corners);
  const alone = Array.from({ length: 500 }, (_, f) => new RayTree(corners.subarray(9 * f, 9 * f + 9)));
  let hits = 0;
  for (let i = 0; i < 300; ++i) {
    const origin = new Vector3(next() * 60 - 20, next() * 60 - 20, -30);
    const ray = new Ray(origin, new Vector3(next() * 20, next() * 20, next() * 20).sub(origin).normalize());
    const distances = alone.map((tree) => tree.cast(ray)?.distance ?? Infinity);
    const nearest = Math.min(...distances);
    const found = all.cast(ray);
    assert.equal(found?.distance ?? Infinity, nearest);
    if (found) assert.equal(distances[found.face], nearest);
    hits += found ? 1 : 0;
  }
  assert.ok(hits > 50, `${hits}`);
});

test("faces behind the origin and degenerate faces are not hit", () => {
  const ray = new Ray(new Vector3(0.2, 0.2, 1), new Vector3(0, 0, 1));
  assert.equal(new RayTree(Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0])).cast(ray), null);
  assert.equal(new RayTree(Float32Array.from([0, 0, 2, 1, 1, 2, 2, 2, 2])).cast(ray), null);
  assert.equal(new RayTree(new Float32Array(0)).cast(ray), null);
});
