// SPDX-License-Identifier: Apache-2.0
/// A sphere with two triangles for each of `rings` times 2 `rings` cells.
function ball(rings: number, radius: number): { points: number[]; corners: number[] } {
  const sectors = 2 * rings;
  const points: number[] = [];
  for (let i = 0; i <= rings; ++i)
    for (let k = 0; k < sectors; ++k) {
      const [polar, turn] = [(Math.PI * i) / rings, (2 * Math.PI * k) / sectors];
      points.push(
        radius * Math.sin(polar) * Math.cos(turn),
        radius * Math.sin(polar) * Math.sin(turn),
        radius * Math.cos(polar),
      );
    }
  const corners: number[] = [];
  for (let i = 0; i < rings; ++i)
    for (let k = 0; k < sectors; ++k) {
      const [a, b] = [i * sectors + k, i * sectors + ((k + 1) % sectors)];
      const [c, d] = [a + sectors, b + sectors];
      if (i > 0) corners.push(a, c, b);
      if (i + 1 < rings) corners.push(b, c, d);
    }
  return { points, corners };
}

/// A binary glTF file with `count` spheres that share a mesh.
export function ballsGlb(count: number, rings: number): { bytes: Buffer; triangles: number } {
  const { points, corners } = ball(rings, 0.008);
  const positions = Buffer.from(Float32Array.from(points).buffer);
  const indices = Buffer.from(Uint32Array.from(corners).buffer);
  const place = (i: number) => [0.02 * (i % 10), 0.02 * (Math.floor(i / 10) % 10), 0.02 * Math.floor(i / 100)];
  const document = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: Array.from({ length: count }, (_, i) => i) }],
    nodes: Array.from({ length: count }, (_, i) => ({ name: `ball ${i + 1}`, mesh: 0, translation: place(i) })),
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    buffers: [{ byteLength: positions.length + indices.length }],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: positions.length },
      { buffer: 0, byteOffset: positions.length, byteLength: indices.length },
    ],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        count: points.length / 3,
        type: "VEC3",
        min: [-0.008, -0.008, -0.008],
        max: [0.008, 0.008, 0.008],
      },
      { bufferView: 1, componentType: 5125, count: corners.length, type: "SCALAR" },
    ],
  };
  const json = Buffer.from(JSON.stringify(document));
  const text = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, " ")]);
  const head = Buffer.alloc(20);
  [0x46546c67, 2, 28 + text.length + positions.length + indices.length, text.length, 0x4e4f534a].forEach((word, i) => {
    head.writeUInt32LE(word, 4 * i);
  });
  const between = Buffer.alloc(8);
  between.writeUInt32LE(positions.length + indices.length, 0);
  between.writeUInt32LE(0x004e4942, 4);
  return { bytes: Buffer.concat([head, text, between, positions, indices]), triangles: (count * corners.length) / 3 };
}
