// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { readGlb } from "../../src/scene/glb.ts";

function glb(json: object, binary: Uint8Array): ArrayBuffer {
  let text = JSON.stringify(json);
  text += " ".repeat((4 - (text.length % 4)) % 4);
  const bytes = new Uint8Array(28 + text.length + binary.length);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, text.length, 0x4e4f534a].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  bytes.set(new TextEncoder().encode(text), 20);
  view.setUint32(20 + text.length, binary.length, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  bytes.set(binary, 28 + text.length);
  return bytes.buffer;
}

/// Two components of one triangle, the second under a node that is translated by 1 m.
function twoTriangles(): ArrayBuffer {
  const binary = new Uint8Array(44);
  new Float32Array(binary.buffer, 0, 9).set([0, 0, 0, 0.001, 0, 0, 0, 0.002, 0]);
  new Uint16Array(binary.buffer, 36, 3).set([0, 1, 2]);
  return glb(
    {
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [
        { name: "all", children: [1, 2], translation: [1, 0, 0] },
        { name: "b", mesh: 0, extras: { component: "b", index: 1 }, translation: [0, 0.5, 0] },
        { name: "a", mesh: 0, extras: { component: "a", index: 0 } },
      ],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
      materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.3, 0.5] } }],
      accessors: [
        { bufferView: 0, componentType: 5126, count: 3 },
        { bufferView: 1, componentType: 5123, count: 3 },
      ],
      bufferViews: [{ byteLength: 36 }, { byteOffset: 36, byteLength: 6 }],
    },
    binary,
  );
}

test("components are sorted by index, in millimetres, with shared surfaces", () => {
  const { surfaces, components } = readGlb(twoTriangles());
  assert.equal(surfaces.length, 1);
  assert.deepEqual(
    Array.from(surfaces[0].positions).map((value) => Number(value.toFixed(6))),
    [0, 0, 0, 1, 0, 0, 0, 2, 0],
  );
  assert.deepEqual(
    components.map(({ name, surface }) => [name, surface]),
    [
      ["a", 0],
      ["b", 0],
    ],
  );
  assert.deepEqual(components[1].assembledFromMesh.elements.slice(12, 15), [1000, 500, 0]);
  assert.deepEqual(components[0].color, [0.1, 0.2, 0.3, 0.5]);
});

test("other files are refused", () => {
  assert.throws(() => readGlb(new ArrayBuffer(40)), /not a binary glTF/);
  assert.throws(() => readGlb(new ArrayBuffer(3)), /not a binary glTF/);
});
