// SPDX-License-Identifier: Apache-2.0
import {
  BoxGeometry,
  type CanvasTexture,
  Color,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  OrthographicCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  type WebGLRenderer,
} from "three";
import { type TextKey, text } from "../strings.ts";
import type { CameraRig } from "./camera_rig.ts";
import { wordTexture } from "./word_texture.ts";

const kSize = 104;
const kMargin = 8;
/// Beyond this part of half an edge, a click means the edge or the corner.
const kRimBegin = 0.62;

/// The six standard views: where one looks from.
export const kStandardViews: { name: TextKey; key: string; direction: Vector3 }[] = [
  { name: "standard.front", key: "1", direction: new Vector3(0, -1, 0) },
  { name: "standard.right", key: "2", direction: new Vector3(1, 0, 0) },
  { name: "standard.top", key: "3", direction: new Vector3(0, 0, 1) },
  { name: "standard.back", key: "4", direction: new Vector3(0, 1, 0) },
  { name: "standard.left", key: "5", direction: new Vector3(-1, 0, 0) },
  { name: "standard.bottom", key: "6", direction: new Vector3(0, 0, -1) },
];

/// A cube in the upper right corner that shows how the view is turned, and turns it.
export class ViewCube {
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1.05, 1.05, 1.05, -1.05, 0.1, 10);
  private readonly cube: Mesh<BoxGeometry, MeshBasicMaterial[]>;
  private readonly rim: LineSegments<EdgesGeometry, LineBasicMaterial>;
  private readonly spot: Mesh<BoxGeometry, MeshBasicMaterial>;
  private colors = { face: "#ffffff", ink: "#20262e", rim: "#8a929c" };

  constructor() {
    const box = new BoxGeometry(1.1, 1.1, 1.1);
    this.cube = new Mesh(
      box,
      Array.from({ length: 6 }, () => new MeshBasicMaterial()),
    );
    this.rim = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial());
    this.spot = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ transparent: true, opacity: 0.45 }));
    this.spot.visible = false;
    const group = new Group();
    group.add(this.cube, this.rim, this.spot);
    this.scene.add(group);
    this.paint();
  }

  setColors(face: string, ink: string, rim: string, accent: string): void {
    this.colors = { face, ink, rim };
    this.spot.material.color.set(new Color(accent));
    this.paint();
  }

  render(renderer: WebGLRenderer, rig: CameraRig): void {
    this.camera.position.copy(rig.axis("back").multiplyScalar(4));
    this.camera.quaternion.copy(rig.camera.quaternion);
    this.camera.updateMatrixWorld(true);
    const { x, y } = this.corner(rig);
    renderer.setScissorTest(true);
    renderer.setViewport(x, rig.size.y - y - kSize, kSize, kSize);
    renderer.setScissor(x, rig.size.y - y - kSize, kSize, kSize);
    renderer.clearDepth();
    renderer.render(this.scene, this.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, rig.size.x, rig.size.y);
  }

  /// The direction (towards the eye) that a place on screen stands for, or null beside the cube.
  pick(rig: CameraRig, x: number, y: number): Vector3 | null {
    const corner = this.corner(rig);
    const device = new Vector2(((x - corner.x) / kSize) * 2 - 1, 1 - ((y - corner.y) / kSize) * 2);
    if (Math.abs(device.x) > 1 || Math.abs(device.y) > 1) return null;
    const caster = new Raycaster();
    caster.setFromCamera(device, this.camera);
    const hit = caster.intersectObject(this.cube)[0];
    if (!hit) return null;
    const half = 0.55 * kRimBegin;
    const sign = (value: number) => (Math.abs(value) > half ? Math.sign(value) : 0);
    return new Vector3(sign(hit.point.x), sign(hit.point.y), sign(hit.point.z));
  }

  /// Marks the face, edge or corner that stands for a direction. Returns whether the mark changed.
  hover(direction: Vector3 | null): boolean {
    const before = this.spot.visible ? this.spot.position.clone() : null;
    this.spot.visible = direction !== null;
    if (direction) {
      const extent = (value: number) => (value === 0 ? 1.1 * kRimBegin : 0.22);
      const place = (value: number) => Math.sign(value) * 0.46;
      this.spot.scale.set(extent(direction.x), extent(direction.y), extent(direction.z));
      this.spot.position.set(place(direction.x), place(direction.y), place(direction.z));
    }
    return direction === null ? before !== null : !before?.equals(this.spot.position);
  }

  private corner(rig: CameraRig): { x: number; y: number } {
    return { x: rig.size.x - kSize - kMargin, y: kMargin };
  }

  private paint(): void {
    const faces: { name: TextKey; turn: number }[] = [
      { name: "standard.right", turn: -Math.PI / 2 },
      { name: "standard.left", turn: Math.PI / 2 },
      { name: "standard.back", turn: Math.PI },
      { name: "standard.front", turn: 0 },
      { name: "standard.top", turn: 0 },
      { name: "standard.bottom", turn: Math.PI },
    ];
    faces.forEach(({ name, turn }, i) => {
      const material = this.cube.material[i];
      material.map?.dispose();
      material.map = this.label(text(name), turn);
      material.needsUpdate = true;
    });
    this.rim.material.color.set(this.colors.rim);
  }

  private label(name: string, turn: number): CanvasTexture {
    const ground = (brush: CanvasRenderingContext2D) => {
      brush.fillStyle = this.colors.face;
      brush.fillRect(-64, -64, 128, 128);
    };
    const texture = wordTexture(name, { size: 128, color: this.colors.ink, font: "600 27px", ground, turn });
    texture.anisotropy = 4;
    return texture;
  }
}
