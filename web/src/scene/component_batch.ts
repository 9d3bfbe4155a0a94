// SPDX-License-Identifier: Apache-2.0
import { BatchedMesh, type BufferGeometry, type Color, Group, type Matrix4, type ShaderMaterial } from "three";
import { batchedBodyMaterial, batchedEdgeMaterial } from "./shade.ts";

/// The shapes of a batch: what is drawn once for each component that has it.
interface Shape {
  readonly body: BufferGeometry;
  readonly edges: BufferGeometry;
}

/// Components that are drawn together: one call for all their faces and one for all their edges, however many there are.
/// Shapes that several share are there once. Made for components that are opaque and whole; others are drawn by themselves.
export class ComponentBatch {
  readonly object = new Group();
  private readonly bodies: BatchedMesh;
  private readonly edges: BatchedMesh;
  /// Of each component, its instances; -1 where its shape has no faces, or no edges.
  private readonly bodyOf: number[] = [];
  private readonly edgeOf: number[] = [];

  /// @param shapes all that are used; @param used the shape of each component
  constructor(shapes: Shape[], used: Shape[]) {
    this.bodies = batch(
      shapes.map(({ body }) => body),
      used.length,
      batchedBodyMaterial(),
    );
    this.edges = batch(
      shapes.map(({ edges }) => edges),
      used.length,
      batchedEdgeMaterial(),
    );
    // Batches are meshes by themselves; these are pairs of points.
    Object.assign(this.edges, { isMesh: false, isLine: true, isLineSegments: true });
    this.edges.renderOrder = 1;
    this.object.add(this.bodies, this.edges);

    const ids = new Map(
      shapes.map((shape) => [shape, { body: add(this.bodies, shape.body), edges: add(this.edges, shape.edges) }]),
    );
    for (const shape of used) {
      const { body, edges } = ids.get(shape)!;
      this.bodyOf.push(body >= 0 ? this.bodies.addInstance(body) : -1);
      this.edgeOf.push(edges >= 0 ? this.edges.addInstance(edges) : -1);
    }
  }

  show(component: number, shown: boolean): void {
    this.each(component, (drawn, instance) => drawn.setVisibleAt(instance, shown));
  }

  place(component: number, worldFromMesh: Matrix4): void {
    this.each(component, (drawn, instance) => drawn.setMatrixAt(instance, worldFromMesh));
  }

  paint(component: number, body: Color, edge: Color): void {
    this.each(component, (drawn, instance) => drawn.setColorAt(instance, drawn === this.bodies ? body : edge));
  }

  private each(component: number, apply: (drawn: BatchedMesh, instance: number) => void): void {
    if (this.bodyOf[component] >= 0) apply(this.bodies, this.bodyOf[component]);
    if (this.edgeOf[component] >= 0) apply(this.edges, this.edgeOf[component]);
  }

  dispose(): void {
    for (const drawn of [this.bodies, this.edges]) {
      drawn.dispose();
      (drawn.material as ShaderMaterial).dispose();
    }
  }
}

function batch(shapes: BufferGeometry[], count: number, material: ShaderMaterial): BatchedMesh {
  const vertices = shapes.reduce((sum, shape) => sum + shape.getAttribute("position").count, 0);
  const made = new BatchedMesh(Math.max(1, count), Math.max(1, vertices), 0, material);
  made.sortObjects = false;
  return made;
}

/// The id of a shape in a batch; -1 where there is nothing of it.
function add(drawn: BatchedMesh, shape: BufferGeometry): number {
  return shape.getAttribute("position").count > 0 ? drawn.addGeometry(shape) : -1;
}
