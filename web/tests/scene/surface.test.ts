// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { surfaceFromMesh } from "../../src/scene/surface.ts";

/// A cube of side 2 about the origin; each face has its own vertices, as in some files.
function cube(faces = 6) {
  const positions: number[] = [];
  const indices: number[] = [];
  for (let f = 0; f < faces; ++f) {
    const [axis, side] = [f >> 1, f % 2 === 0 ? 1 : -1];
    const corner = (u: number, v: number) => {
      const point = [0, 0, 0];
      point[axis] = side;
      point[(axis + 1) % 3] = u * side;
      point[(axis + 2) % 3] = v;
      return point;
    };
    const first = positions.length / 3;
    for (const [u, v] of [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ])
      positions.push(...corner(u, v));
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

/// The sides of a prism around z.
function prism(corners: number) {
  const positions: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i < corners; ++i) {
    const angle = (2 * Math.PI * i) / corners;
    positions.push(Math.cos(angle), Math.sin(angle), 0, Math.cos(angle), Math.sin(angle), 1);
    const [a, b] = [2 * i, 2 * ((i + 1) % corners)];
    indices.push(a, b, b + 1, a, b + 1, a + 1);
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

test("a cube has twelve feature edges, flat faces, and is closed", () => {
  const surface = surfaceFromMesh(cube());
  assert.equal(surface.edges.length, 12 * 6);
  assert.equal(surface.closed, true);
  for (let i = 0; i < surface.normals.length; i += 3) {
    const face = Array.from(surface.normals.subarray(i, i + 3))
      .map(Math.abs)
      .sort();
    assert.deepEqual(face, [0, 0, 1]);
  }
});

test("a cube without a side is open, and its boundary is an edge", () => {
  const surface = surfaceFromMesh(cube(5));
  assert.equal(surface.closed, false);
  assert.equal(surface.edges.length, 12 * 6);
});

test("a fine prism is smooth: edges only at its two rims, radial normals", () => {
  const surface = surfaceFromMesh(prism(16));
  assert.equal(surface.edges.length, 32 * 6);
  for (let i = 0; i < surface.normals.length; i += 3) {
    const outward = surface.normals[i] * surface.positions[i] + surface.normals[i + 1] * surface.positions[i + 1];
    assert.ok(outward > 0.97, `${outward}`);
  }
});

test("a prism of eight sides is not smooth", () => {
  assert.equal(surfaceFromMesh(prism(8)).edges.length, (16 + 8) * 6);
});
