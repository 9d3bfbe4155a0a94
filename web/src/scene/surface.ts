// SPDX-License-Identifier: Apache-2.0
import type { RawSurface } from "./glb.ts";

/// A surface prepared for drawing, in the component's own frame.
export interface Surface {
  /// Three corners for each face [mm], shape [face_count, 3, 3].
  positions: Float32Array;
  /// Unit normals of the corners, smooth across edges that bend by less than kCreaseAngle.
  normals: Float32Array;
  /// Both ends of each feature edge [mm], shape [edge_count, 2, 3].
  edges: Float32Array;
  /// True if every edge has an even number of faces: the surface bounds a solid, and sections of it can be capped.
  closed: boolean;
}

/// Larger than the angle between two facets of a curved face at the importer's angular deflection (0.5 rad), smaller
/// than that of a chamfer [rad].
export const kCreaseAngle = 0.62;
const kSmooth = Math.cos(kCreaseAngle);

/// Computes what is drawn of a mesh: normals, feature edges, and whether it is closed.
export function surfaceFromMesh(raw: RawSurface): Surface {
  const mesh = weld(raw);
  const faces = computeFaces(mesh);
  const fans = computeFans(mesh);
  const { edges, closed } = featureEdges(mesh, faces, fans);
  const positions = new Float32Array(3 * mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; ++i)
    for (let k = 0; k < 3; ++k) positions[3 * i + k] = mesh.vertices[3 * mesh.corners[i] + k];
  return { positions, normals: creaseNormals(mesh, faces, fans), edges, closed };
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

/// Unit normals (zero for degenerate faces), shape [face_count, 3], and doubled areas.
interface Faces {
  normals: Float32Array;
  areas: Float32Array;
}

/// Merges vertices at equal positions and drops faces that degenerate.
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
  const corners = new Uint32Array(raw.indices.length);
  let end = 0;
  for (let i = 0; i < raw.indices.length; i += 3) {
    const [a, b, c] = [welded[raw.indices[i]], welded[raw.indices[i + 1]], welded[raw.indices[i + 2]]];
    if (a === b || b === c || c === a) continue;
    corners.set([a, b, c], end);
    end += 3;
  }
  return { vertices: raw.positions, vertexCount: count, corners: corners.subarray(0, end) };
}

function computeFaces({ vertices, corners }: WeldedMesh): Faces {
  const normals = new Float32Array(corners.length);
  const areas = new Float32Array(corners.length / 3);
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [3 * corners[i], 3 * corners[i + 1], 3 * corners[i + 2]];
    const ux = vertices[b] - vertices[a];
    const uy = vertices[b + 1] - vertices[a + 1];
    const uz = vertices[b + 2] - vertices[a + 2];
    const vx = vertices[c] - vertices[a];
    const vy = vertices[c + 1] - vertices[a + 1];
    const vz = vertices[c + 2] - vertices[a + 2];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const area = Math.sqrt(x * x + y * y + z * z);
    areas[i / 3] = area;
    if (area === 0) continue;
    normals[i] = x / area;
    normals[i + 1] = y / area;
    normals[i + 2] = z / area;
  }
  return { normals, areas };
}

function computeFans(mesh: WeldedMesh): Fans {
  const begin = new Uint32Array(mesh.vertexCount + 1);
  for (const vertex of mesh.corners) ++begin[vertex + 1];
  for (let v = 0; v < mesh.vertexCount; ++v) begin[v + 1] += begin[v];
  const next = begin.slice(0, mesh.vertexCount);
  const face = new Uint32Array(mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; ++i) face[next[mesh.corners[i]]++] = Math.floor(i / 3);
  return { begin, face };
}

/// True if the normals of two faces differ by less than the crease angle. Degenerate faces are smooth with any other.
function isSmooth({ normals, areas }: Faces, f: number, g: number): boolean {
  if (areas[f] === 0 || areas[g] === 0) return true;
  const [a, b] = [3 * f, 3 * g];
  const dot = normals[a] * normals[b] + normals[a + 1] * normals[b + 1] + normals[a + 2] * normals[b + 2];
  return dot >= kSmooth;
}

function creaseNormals(mesh: WeldedMesh, faces: Faces, fans: Fans): Float32Array {
  const normals = new Float32Array(3 * mesh.corners.length);
  for (let i = 0; i < mesh.corners.length; ++i) {
    const own = Math.floor(i / 3);
    const vertex = mesh.corners[i];
    let [x, y, z] = [0, 0, 0];
    for (let k = fans.begin[vertex]; k < fans.begin[vertex + 1]; ++k) {
      const face = fans.face[k];
      if (face !== own && !isSmooth(faces, own, face)) continue;
      x += faces.areas[face] * faces.normals[3 * face];
      y += faces.areas[face] * faces.normals[3 * face + 1];
      z += faces.areas[face] * faces.normals[3 * face + 2];
    }
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    normals[3 * i] = x / length;
    normals[3 * i + 1] = y / length;
    normals[3 * i + 2] = z / length;
  }
  return normals;
}

/// Sharp and boundary edges, found at their vertex of lower index.
function featureEdges(mesh: WeldedMesh, faces: Faces, fans: Fans): { edges: Float32Array; closed: boolean } {
  const ends: number[] = [];
  const seenFrom = new Int32Array(mesh.vertexCount).fill(-1);
  const uses = new Uint32Array(mesh.vertexCount);
  const first = new Uint32Array(mesh.vertexCount);
  const last = new Uint32Array(mesh.vertexCount);
  let closed = true;
  for (let vertex = 0; vertex < mesh.vertexCount; ++vertex) {
    const others: number[] = [];
    for (let k = fans.begin[vertex]; k < fans.begin[vertex + 1]; ++k) {
      const face = fans.face[k];
      for (let corner = 3 * face; corner < 3 * face + 3; ++corner) {
        const other = mesh.corners[corner];
        if (other <= vertex) continue;
        if (seenFrom[other] !== vertex) {
          seenFrom[other] = vertex;
          uses[other] = 0;
          first[other] = face;
          others.push(other);
        }
        last[other] = face;
        ++uses[other];
      }
    }
    for (const other of others) {
      closed &&= uses[other] % 2 === 0;
      if (uses[other] === 2 && isSmooth(faces, first[other], last[other])) continue;
      ends.push(vertex, other);
    }
  }
  return { edges: pointsOf(mesh, ends), closed };
}

function pointsOf({ vertices }: WeldedMesh, indices: number[]): Float32Array {
  const points = new Float32Array(3 * indices.length);
  indices.forEach((vertex, i) => {
    for (let k = 0; k < 3; ++k) points[3 * i + k] = vertices[3 * vertex + k];
  });
  return points;
}
