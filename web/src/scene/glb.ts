// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Quaternion, Vector3 } from "three";

/// A mesh of the file: positions [mm] in the component's own frame, shape [vertex_count, 3].
export interface RawSurface {
  positions: Float32Array;
  indices: Uint32Array;
}

/// A component of the file. Several may share a surface.
export interface RawComponent {
  /// Index of the component in messages.
  index: number;
  name: string;
  surface: number;
  assembledFromMesh: Matrix4;
  /// Linear RGBA.
  color: [number, number, number, number];
}

/// The content of a binary glTF file.
export interface RawAssembly {
  surfaces: RawSurface[];
  /// Sorted by index.
  components: RawComponent[];
}

interface GltfNode {
  name?: string;
  mesh?: number;
  children?: number[];
  translation?: [number, number, number];
  rotation?: [number, number, number, number];
  scale?: [number, number, number];
  matrix?: number[];
  extras?: { component?: string; index?: number };
}

interface Gltf {
  scene: number;
  scenes: { nodes: number[] }[];
  nodes: GltfNode[];
  meshes?: { primitives: { attributes: { POSITION: number }; indices: number; material?: number }[] }[];
  materials?: { pbrMetallicRoughness?: { baseColorFactor?: [number, number, number, number] } }[];
  accessors?: { bufferView: number; byteOffset?: number; componentType: number; count: number }[];
  bufferViews?: { byteOffset?: number; byteLength: number }[];
}

const kMillimetresPerMetre = 1000;
const kGlbMagic = 0x46546c67;
const kUnsignedShort = 5123;

/// Reads the binary glTF that the engine writes (one primitive a mesh, indexed triangles, no normals). Throws if the
/// bytes are not such a file.
export function readGlb(bytes: ArrayBuffer): RawAssembly {
  const header = new DataView(bytes);
  if (bytes.byteLength < 20 || header.getUint32(0, true) !== kGlbMagic) throw new Error("not a binary glTF file");
  const jsonLength = header.getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, jsonLength))) as Gltf;
  return new GlbReader(gltf, bytes, 20 + jsonLength + 8).read();
}

class GlbReader {
  private readonly surfaces: RawSurface[] = [];
  private readonly surfaceOfAccessors = new Map<string, number>();
  private readonly components: RawComponent[] = [];

  constructor(
    private readonly gltf: Gltf,
    private readonly bytes: ArrayBuffer,
    private readonly binaryBegin: number,
  ) {}

  read(): RawAssembly {
    for (const node of this.gltf.scenes[this.gltf.scene].nodes) this.readNode(node, new Matrix4());
    this.components.sort((a, b) => a.index - b.index);
    return { surfaces: this.surfaces, components: this.components };
  }

  private readNode(index: number, parent: Matrix4): void {
    const node = this.gltf.nodes[index];
    const transform = parent.clone().multiply(localTransform(node));
    if (node.mesh !== undefined) this.components.push(this.component(node, node.mesh, transform));
    for (const child of node.children ?? []) this.readNode(child, transform);
  }

  private component(node: GltfNode, mesh: number, transform: Matrix4): RawComponent {
    const primitive = this.gltf.meshes![mesh].primitives[0];
    const material = primitive.material === undefined ? undefined : this.gltf.materials![primitive.material];
    return {
      index: node.extras?.index ?? this.components.length,
      name: node.extras?.component ?? node.name ?? "",
      surface: this.surface(primitive.attributes.POSITION, primitive.indices),
      assembledFromMesh: transform,
      color: material?.pbrMetallicRoughness?.baseColorFactor ?? [0.5, 0.5, 0.5, 1],
    };
  }

  private surface(positions: number, indices: number): number {
    const key = `${positions} ${indices}`;
    const known = this.surfaceOfAccessors.get(key);
    if (known !== undefined) return known;
    const scaled = new Float32Array(this.slice(positions, 12));
    for (let i = 0; i < scaled.length; ++i) scaled[i] *= kMillimetresPerMetre;
    const short = this.gltf.accessors![indices].componentType === kUnsignedShort;
    const values = short ? new Uint16Array(this.slice(indices, 2)) : new Uint32Array(this.slice(indices, 4));
    this.surfaces.push({ positions: scaled, indices: short ? Uint32Array.from(values) : (values as Uint32Array) });
    this.surfaceOfAccessors.set(key, this.surfaces.length - 1);
    return this.surfaces.length - 1;
  }

  /// A copy of an accessor's data, with `stride` bytes an element.
  private slice(index: number, stride: number): ArrayBuffer {
    const accessor = this.gltf.accessors![index];
    const view = this.gltf.bufferViews![accessor.bufferView];
    const begin = this.binaryBegin + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    return this.bytes.slice(begin, begin + accessor.count * stride);
  }
}

function localTransform(node: GltfNode): Matrix4 {
  if (node.matrix) {
    const matrix = new Matrix4().fromArray(node.matrix);
    return matrix.setPosition(new Vector3().setFromMatrixPosition(matrix).multiplyScalar(kMillimetresPerMetre));
  }
  const position = new Vector3(...(node.translation ?? [0, 0, 0])).multiplyScalar(kMillimetresPerMetre);
  const rotation = new Quaternion(...(node.rotation ?? [0, 0, 0, 1]));
  return new Matrix4().compose(position, rotation, new Vector3(...(node.scale ?? [1, 1, 1])));
}
