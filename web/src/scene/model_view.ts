// SPDX-License-Identifier: Apache-2.0
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  FrontSide,
  Group,
  LineSegments,
  Matrix4,
  Mesh,
  type Ray,
  type ShaderMaterial,
  Vector3,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { matrixOf } from "../pose.ts";
import type { WirePose } from "../wire/structs.ts";
import { ComponentBatch } from "./component_batch.ts";
import type { RawAssembly, RawComponent } from "./glb.ts";
import { bodyMaterial, cutMaterial, edgeMaterial } from "./materials.ts";
import type { Palette } from "./palette.ts";
import { partColors } from "./part_colors.ts";
import { RayTree } from "./ray_tree.ts";
import { type Surface, surfaceFromMesh } from "./surface.ts";

/// The states that change how a component is drawn.
export interface Appearance {
  hovered: boolean;
  selected: boolean;
  blocking: boolean;
  xray: boolean;
  next: boolean;
}

const kPlainAppearance: Appearance = { hovered: false, selected: false, blocking: false, xray: false, next: false };
const kAppearanceKeys = Object.keys(kPlainAppearance) as (keyof Appearance)[];
const kXrayOpacity = 0.16;

/// A point on a component under the pointer or along a ray.
export interface Pick {
  component: number;
  point: Vector3;
  distance: number;
  /// The triangle of the component's drawn surface.
  face: number;
}

/// Geometry shared by components of the same shape.
class SurfaceView {
  readonly body = new BufferGeometry();
  readonly edges = new BufferGeometry();
  private wide: LineSegmentsGeometry | null = null;
  private tree: RayTree | null = null;

  constructor(readonly surface: Surface) {
    this.body.setAttribute("position", new BufferAttribute(surface.positions, 3));
    this.body.setAttribute("normal", new BufferAttribute(surface.normals, 3));
    this.body.computeBoundingBox();
    this.body.computeBoundingSphere();
    this.edges.setAttribute("position", new BufferAttribute(surface.edges, 3));
    this.edges.boundingSphere = this.body.boundingSphere;
  }

  get wideEdges(): LineSegmentsGeometry {
    this.wide ??= new LineSegmentsGeometry().setPositions(this.surface.edges);
    return this.wide;
  }

  get rayTree(): RayTree {
    this.tree ??= new RayTree(this.surface.positions);
    return this.tree;
  }

  dispose(): void {
    this.body.dispose();
    this.edges.dispose();
    this.wide?.dispose();
  }
}

/// The view of one component, always drawn at the engine's pose.
export class ComponentView {
  readonly object = new Group();
  /// The pose at which it is drawn.
  readonly worldFromAssembled = new Matrix4();
  /// Displacement in the quick exploded view [mm].
  private readonly displacement = new Vector3();
  /// Current appearance; see setAppearance.
  appearance: Readonly<Appearance> = kPlainAppearance;
  private readonly body: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly edges: LineSegments<BufferGeometry, ShaderMaterial>;
  private outline: LineSegments2 | null = null;
  private cut: Mesh<BufferGeometry, ShaderMaterial> | null = null;
  private readonly opacity: number;
  private planeCount = 0;

  constructor(
    readonly raw: RawComponent,
    readonly shape: SurfaceView,
    private readonly batch: ComponentBatch,
    private palette: Palette,
  ) {
    const [r, g, b, a] = raw.color;
    this.opacity = a;
    this.body = new Mesh(shape.body, bodyMaterial(new Color(r, g, b), a));
    this.edges = new LineSegments(shape.edges, edgeMaterial(new Color(palette.edge), 1));
    // Drawn after all faces: then the stencil tells which pixels are section caps.
    this.edges.renderOrder = 1;
    this.object.add(this.body, this.edges);
    this.object.matrixAutoUpdate = false;
    this.setPose(null);
    this.applyAppearance();
  }

  /// Index of the component in messages.
  get index(): number {
    return this.raw.index;
  }

  get visible(): boolean {
    return this.object.visible;
  }

  set visible(value: boolean) {
    this.object.visible = value;
    this.chooseRenderPath();
  }

  /// Sets the pose; null: assembled.
  setPose(pose: WirePose | null): void {
    this.worldFromAssembled.copy(matrixOf(pose));
    this.place();
  }

  /// Draws the component away from its pose.
  displace(by: Vector3): void {
    this.displacement.copy(by);
    this.place();
  }

  private place(): void {
    this.object.matrix.multiplyMatrices(this.worldFromAssembled, this.raw.assembledFromMesh);
    this.object.matrix.premultiply(new Matrix4().makeTranslation(this.displacement));
    this.object.matrixWorldNeedsUpdate = true;
    this.batch.setMatrix(this.index, this.object.matrix);
  }

  bounds(): Box3 {
    return this.shape.body.boundingBox!.clone().applyMatrix4(this.object.matrix);
  }

  /// Changes some states of the appearance.
  setAppearance(appearance: Partial<Appearance>): void {
    const before = this.appearance;
    this.appearance = { ...before, ...appearance };
    if (kAppearanceKeys.some((key) => this.appearance[key] !== before[key])) this.applyAppearance();
  }

  setPalette(palette: Palette): void {
    this.palette = palette;
    this.applyAppearance();
  }

  /// Sets the number of section planes that cut the component; closed solids are capped.
  setPlaneCount(count: number): void {
    if (count > 0 && !this.cut && this.shape.surface.closed) {
      this.cut = new Mesh(this.shape.body, cutMaterial(this.body.material, this.index % 2 === 0 ? 1 : -1));
      this.object.add(this.cut);
      this.object.matrixWorldNeedsUpdate = true;
    }
    if (this.cut) this.cut.visible = count > 0;
    this.planeCount = count;
    this.chooseRenderPath();
    this.body.material.side = count > 0 && this.cut ? FrontSide : DoubleSide;
    this.body.material.stencilWrite = this.edges.material.stencilWrite = count > 0;
    for (const material of [this.body.material, this.edges.material, this.cut?.material]) {
      if (!material) continue;
      material.defines.PLANES = count;
      material.needsUpdate = true;
    }
  }

  /// A second view of the component's faces, for the ghost.
  copyOfBody(material: ShaderMaterial): Group {
    const copy = new Group();
    copy.matrixAutoUpdate = false;
    copy.add(new Mesh(this.shape.body, material));
    return copy;
  }

  /// The first point of the component along a ray, world frame.
  cast(worldRay: Ray): Pick | null {
    const meshFromWorld = this.object.matrix.clone().invert();
    const ray = worldRay.clone().applyMatrix4(meshFromWorld);
    const hit = this.shape.rayTree.cast(ray);
    if (!hit) return null;
    const point = ray.at(hit.distance, new Vector3()).applyMatrix4(this.object.matrix);
    return { component: this.index, point, distance: point.distanceTo(worldRay.origin), face: hit.face };
  }

  dispose(): void {
    this.body.material.dispose();
    this.edges.material.dispose();
    this.cut?.material.dispose();
    this.outline?.material.dispose();
  }

  private applyAppearance(): void {
    const { appearance, palette } = this;
    const material = this.body.material;
    const opacity = appearance.xray ? Math.min(kXrayOpacity, this.opacity) : this.opacity;
    material.uniforms.uOpacity.value = opacity;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
    const emphasis = this.emphasis();
    const tint = new Color(emphasis?.color ?? palette.edge);
    material.uniforms.uTint.value.set(tint.r, tint.g, tint.b, emphasis?.tint ?? 0);
    const edge: Color = this.edges.material.uniforms.uColor.value.set(
      appearance.hovered ? palette.accent : palette.edge,
    );
    this.batch.setColors(this.index, material.uniforms.uColor.value.clone().lerp(tint, emphasis?.tint ?? 0), edge);
    this.chooseRenderPath();
    this.edges.material.uniforms.uOpacity.value = appearance.xray ? 0.35 : 1;
    this.edges.material.transparent = appearance.xray;
    if (this.cut) this.cut.material.transparent = material.transparent;
    this.setOutline(emphasis ? { color: emphasis.color, width: emphasis.width } : null);
  }

  /// Draws the component separately if it is translucent or cut, otherwise in the batch.
  private chooseRenderPath(): void {
    const separate = this.body.material.transparent || this.planeCount > 0;
    this.body.visible = this.edges.visible = separate;
    this.batch.setVisible(this.index, this.object.visible && !separate);
  }

  private emphasis(): { color: string; tint: number; width: number } | null {
    const { appearance, palette } = this;
    if (appearance.blocking) return { color: palette.blocking, tint: 0.28, width: 3.2 };
    if (appearance.selected) return { color: palette.selection, tint: 0.45, width: 2.2 };
    if (appearance.next) return { color: palette.next, tint: 0.4, width: 3 };
    if (appearance.hovered) return { color: palette.accent, tint: 0.07, width: 1.8 };
    return null;
  }

  private setOutline(style: { color: string; width: number } | null): void {
    if (style && !this.outline && this.shape.surface.edges.length > 0) {
      this.outline = new LineSegments2(this.shape.wideEdges, new LineMaterial({ linewidth: 1 }));
      this.outline.renderOrder = 2;
      this.object.add(this.outline);
    }
    if (!this.outline) return;
    this.outline.visible = style !== null;
    this.outline.matrixWorldNeedsUpdate = true;
    if (style) {
      this.outline.material.color.set(style.color);
      this.outline.material.linewidth = style.width;
    }
  }
}

/// The views of all components of an assembly.
export class ModelView {
  readonly root = new Group();
  readonly components: ComponentView[] = [];
  private readonly shapes: SurfaceView[];
  private readonly batch: ComponentBatch;

  constructor(raw: RawAssembly, palette: Palette) {
    this.shapes = raw.surfaces.map((surface) => new SurfaceView(surfaceFromMesh(surface)));
    this.batch = new ComponentBatch(
      this.shapes,
      raw.components.map(({ surface }) => this.shapes[surface]),
    );
    this.root.add(this.batch.object);
    const colors = partColors(raw.components.map(({ color }) => color));
    for (const [i, uncolored] of raw.components.entries()) {
      const component = { ...uncolored, color: colors[i] };
      const view = new ComponentView(component, this.shapes[component.surface], this.batch, palette);
      this.components.push(view);
      this.root.add(view.object);
    }
  }

  /// The first visible component along a ray that `accepts` accepts.
  cast(ray: Ray, accepts: (pick: Pick) => boolean = () => true): Pick | null {
    let best: Pick | null = null;
    const entry = new Vector3();
    for (const component of this.components) {
      if (!component.visible) continue;
      if (!ray.intersectBox(component.bounds(), entry)) continue;
      const pick = component.cast(ray);
      if (pick && pick.distance < (best?.distance ?? Infinity) && accepts(pick)) best = pick;
    }
    return best;
  }

  /// Bounding box of some components at their poses, world frame.
  boundsOf(components: number[]): Box3 {
    return components.reduce((box, c) => box.union(this.components[c].bounds()), new Box3());
  }

  /// Bounding box of all visible components, world frame.
  bounds(): Box3 {
    const box = new Box3();
    for (const component of this.components) if (component.visible) box.union(component.bounds());
    return box;
  }

  /// Draws components away from the centre of all of them, by `factor` times their distance from it.
  explode(factor: number): void {
    const center = new Box3();
    for (const component of this.components) {
      component.displace(new Vector3());
      center.union(component.bounds());
    }
    const middle = center.getCenter(new Vector3());
    for (const component of this.components)
      component.displace(component.bounds().getCenter(new Vector3()).sub(middle).multiplyScalar(factor));
  }

  setPalette(palette: Palette): void {
    for (const component of this.components) component.setPalette(palette);
  }

  setPlaneCount(count: number): void {
    for (const component of this.components) component.setPlaneCount(count);
  }

  dispose(): void {
    this.batch.dispose();
    for (const component of this.components) component.dispose();
    for (const shape of this.shapes) shape.dispose();
  }
}
