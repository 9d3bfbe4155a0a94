// SPDX-License-Identifier: Apache-2.0
import { BatchedMesh, type BufferGeometry, type Color, Group, type Matrix4, type ShaderMaterial } from "three";
import { batchedBodyMaterial, batchedEdgeMaterial } from "./materials.ts";

/// Geometry that is drawn for each component that uses it.
interface Shape {
  readonly body: BufferGeometry;
  readonly edges: BufferGeometry;
}

/// Components drawn in one batch: one draw call for all faces and one for all edges. Shared shapes are stored once.
/// Holds opaque, uncut components; others are drawn separately.
export class ComponentBatch {
  readonly object = new Group();
  private readonly bodies: BatchedMesh;
  private readonly edges: BatchedMesh;
  /// Instance of each component; -1 if its shape has no faces, or no edges.
  private readonly bodyOf: number[] = [];
  private readonly edgeOf: number[] = [];

  /// @param shapes all shapes in use; @param shapeOfComponent the shape of each component
  constructor(shapes: Shape[], shapeOfComponent: Shape[]) {
    this.bodies = batch(
      shapes.map(({ body }) => body),
      shapeOfComponent.length,
      batchedBodyMaterial(),
    );
    this.edges = batch(
      shapes.map(({ edges }) => edges),
      shapeOfComponent.length,
      batchedEdgeMaterial(),
    );
    // BatchedMesh draws triangles; the edges are line segments.
    Object.assign(this.edges, { isMesh: false, isLine: true, isLineSegments: true });
    this.edges.renderOrder = 1;
    this.object.add(this.bodies, this.edges);

    const ids = new Map(
      shapes.map((shape) => [shape, { body: add(this.bodies, shape.body), edges: add(this.edges, shape.edges) }]),
    );
    for (const shape of shapeOfComponent) {
      const { body, edges } = ids.get(shape)!;
      this.bodyOf.push(body >= 0 ? this.bodies.addInstance(body) : -1);
      this.edgeOf.push(edges >= 0 ? this.edges.addInstance(edges) : -1);
    }
  }

  setVisible(component: number, visible: boolean): void {
    this.forEachInstance(component, (mesh, instance) => mesh.setVisibleAt(instance, visible));
  }

  setMatrix(component: number, worldFromMesh: Matrix4): void {
    this.forEachInstance(component, (mesh, instance) => mesh.setMatrixAt(instance, worldFromMesh));
  }

  setColors(component: number, body: Color, edge: Color): void {
    this.forEachInstance(component, (mesh, instance) => mesh.setColorAt(instance, mesh === this.bodies ? body : edge));
  }

  private forEachInstance(component: number, apply: (mesh: BatchedMesh, instance: number) => void): void {
    if (this.bodyOf[component] >= 0) apply(this.bodies, this.bodyOf[component]);
    if (this.edgeOf[component] >= 0) apply(this.edges, this.edgeOf[component]);
  }

  dispose(): void {
    for (const mesh of [this.bodies, this.edges]) {
      mesh.dispose();
      (mesh.material as ShaderMaterial).dispose();
    }
  }
}

function batch(shapes: BufferGeometry[], count: number, material: ShaderMaterial): BatchedMesh {
  const vertices = shapes.reduce((sum, shape) => sum + shape.getAttribute("position").count, 0);
  const mesh = new BatchedMesh(Math.max(1, count), Math.max(1, vertices), 0, material);
  mesh.sortObjects = false;
  return mesh;
}

/// Id of a shape in a batch; -1 if it is empty.
function add(mesh: BatchedMesh, shape: BufferGeometry): number {
  return shape.getAttribute("position").count > 0 ? mesh.addGeometry(shape) : -1;
}
