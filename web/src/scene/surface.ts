// SPDX-License-Identifier: Apache-2.0
import type { RawSurface } from "./glb.ts";

/// A surface ready to be drawn, in the component's own frame.
export interface Surface {
  /// Three corners a face [mm], shape [face_count, 3, 3].
  positions: Float32Array;
  /// Unit normals of the corners, smooth across edges flatter than kCreaseAngle.
  normals: Float32Array;
  /// Both ends of each feature edge [mm], shape [edge_count, 2, 3].
  edges: Float32Array;
  /// Every edge has two faces: the surface bounds a solid, and cuts through it can be filled.
  closed: boolean;
}

/// Above the angle between two chords of a round face at the importer's angular deflection (0.5 rad), below a chamfer.
export const kCreaseAngle = 0.62;

/// Splits a mesh at its creases.
export function surfaceFromMesh(raw: RawSurface): Surface {
  const mesh = weld(raw);
  const faceNormals = normalsOfFaces(mesh);
  const fans = facesAroundVertices(mesh);
  const { edges, closed } = featureEdges(mesh, faceNormals, fans);
  const positions = new Float32Array(9 * (mesh.corners.length / 3));
  for (let i = 0; i < mesh.corners.length; ++i) positions.set(vertexOf(mesh, mesh.corners[i]), 3 * i);
  return { positions, normals: creaseNormals(mesh, faceNormals, fans), edges, closed };
}

interface WeldedMesh {
  vertices: Float32Array;
  vertexCount: number;
  corners: Uint32Array;
}

interface Fans {
  begin: Uint32Array;
  face: Uint32Array;
}

function vertexOf(mesh: WeldedMesh, vertex: number): Float32Array {
  return mesh.vertices.subarray(3 * vertex, 3 * vertex + 3);
}

/// Vertices at the same place become one; faces that lose a corner by this go.
function weld(raw: RawSurface): WeldedMesh {
  const bits = new Uint32Array(raw.positions.buffer, raw.positions.byteOffset, raw.positions.length);
  const count = raw.positions.length / 3;
  const mask = 2 ** Math.ceil(Math.log2(2 * count + 1)) - 1;
  const slots = new Int32Array(mask + 1).fill(-1);
  const welded = new Uint32Array(count);
  for (let v = 0; v < count; ++v) {
    const [x, y, z] = [bits[3 * v], bits[3 * v + 1], bits[3 * v + 2]];
    let slot = (Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791)) >>> 0;
    slot = (slot ^ (slot >>> 15)) & mask;
    for (; slots[slot] >= 0; slot = (slot + 1) & mask) {
      const other = 3 * slots[slot];
      if (bits[other] === x && bits[other + 1] === y && bits[other + 2] === z) break;
    }
    if (slots[slot] < 0) slots[slot] = v;
    welded[v] = slots[slot];
  }
  const corners: number[] = [];
  for (let i = 0; i < raw.indices.length; i += 3) {
    const [a, b, c] = [welded[raw.indices[i]], welded[raw.indices[i + 1]], welded[raw.indices[i + 2]]];
    if (a !== b && b !== c && c !== a) corners.push(a, b, c);
  }
  return { vertices: raw.positions, vertexCount: count, corners: Uint32Array.from(corners) };
}

/// Normals with the face's doubled area as length, shape [face_count, 3].
function normalsOfFaces(mesh: WeldedMesh): Float32Array {
  const normals = new Float32Array(mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; i += 3) {
    const a = vertexOf(mesh, mesh.corners[i]);
    const b = vertexOf(mesh, mesh.corners[i + 1]);
    const c = vertexOf(mesh, mesh.corners[i + 2]);
    const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    normals[i] = uy * vz - uz * vy;
    normals[i + 1] = uz * vx - ux * vz;
    normals[i + 2] = ux * vy - uy * vx;
  }
  return normals;
}

function facesAroundVertices(mesh: WeldedMesh): Fans {
  const begin = new Uint32Array(mesh.vertexCount + 1);
  for (const vertex of mesh.corners) ++begin[vertex + 1];
  for (let v = 0; v < mesh.vertexCount; ++v) begin[v + 1] += begin[v];
  const next = begin.slice(0, mesh.vertexCount);
  const face = new Uint32Array(mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; ++i) face[next[mesh.corners[i]]++] = Math.floor(i / 3);
  return { begin, face };
}

/// Whether two faces' normals differ by less than the crease angle; faces without an area bend with any other.
function isSmooth(normals: Float32Array, f: number, g: number): boolean {
  const [a, b] = [3 * f, 3 * g];
  const dot = normals[a] * normals[b] + normals[a + 1] * normals[b + 1] + normals[a + 2] * normals[b + 2];
  const lengths =
    Math.hypot(normals[a], normals[a + 1], normals[a + 2]) * Math.hypot(normals[b], normals[b + 1], normals[b + 2]);
  return lengths === 0 || dot >= Math.cos(kCreaseAngle) * lengths;
}

function creaseNormals(mesh: WeldedMesh, faceNormals: Float32Array, fans: Fans): Float32Array {
  const normals = new Float32Array(3 * mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; ++i) {
    const own = Math.floor(i / 3);
    const vertex = mesh.corners[i];
    let [x, y, z] = [0, 0, 0];
    for (let k = fans.begin[vertex]; k < fans.begin[vertex + 1]; ++k) {
      const face = fans.face[k];
      if (face !== own && !isSmooth(faceNormals, own, face)) continue;
      x += faceNormals[3 * face];
      y += faceNormals[3 * face + 1];
      z += faceNormals[3 * face + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    normals[3 * i] = x / length;
    normals[3 * i + 1] = y / length;
    normals[3 * i + 2] = z / length;
  }
  return normals;
}

function featureEdges(
  mesh: WeldedMesh,
  faceNormals: Float32Array,
  fans: Fans,
): { edges: Float32Array; closed: boolean } {
  const ends: number[] = [];
  const facesToward = new Map<number, number[]>();
  let closed = true;
  for (let vertex = 0; vertex < mesh.vertexCount; ++vertex) {
    facesToward.clear();
    for (let k = fans.begin[vertex]; k < fans.begin[vertex + 1]; ++k) {
      const face = fans.face[k];
      for (let corner = 3 * face; corner < 3 * face + 3; ++corner) {
        const other = mesh.corners[corner];
        if (other <= vertex) continue;
        const faces = facesToward.get(other);
        if (faces) faces.push(face);
        else facesToward.set(other, [face]);
      }
    }
    for (const [other, faces] of facesToward) {
      closed &&= faces.length % 2 === 0;
      if (faces.length === 2 && isSmooth(faceNormals, faces[0], faces[1])) continue;
      ends.push(...vertexOf(mesh, vertex), ...vertexOf(mesh, other));
    }
  }
  return { edges: Float32Array.from(ends), closed };
}
