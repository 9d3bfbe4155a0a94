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
import { labelTexture } from "./label_texture.ts";

const kSize = 104;
const kMargin = 8;
/// Clicks beyond this fraction of half an edge mean the edge or the corner.
const kEdgeZone = 0.62;

/// The six standard views and their keys; `direction` points towards the eye.
export const kStandardViews: { name: TextKey; key: string; direction: Vector3 }[] = [
  { name: "standard.front", key: "1", direction: new Vector3(0, -1, 0) },
  { name: "standard.right", key: "2", direction: new Vector3(1, 0, 0) },
  { name: "standard.top", key: "3", direction: new Vector3(0, 0, 1) },
  { name: "standard.back", key: "4", direction: new Vector3(0, 1, 0) },
  { name: "standard.left", key: "5", direction: new Vector3(-1, 0, 0) },
  { name: "standard.bottom", key: "6", direction: new Vector3(0, 0, -1) },
];

/// A cube in the upper right corner that shows the orientation of the view and changes it when clicked.
export class ViewCube {
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1.05, 1.05, 1.05, -1.05, 0.1, 10);
  private readonly cube: Mesh<BoxGeometry, MeshBasicMaterial[]>;
  private readonly rim: LineSegments<EdgesGeometry, LineBasicMaterial>;
  private readonly highlight: Mesh<BoxGeometry, MeshBasicMaterial>;
  private colors = { face: "#ffffff", ink: "#20262e", rim: "#8a929c" };

  constructor() {
    const box = new BoxGeometry(1.1, 1.1, 1.1);
    this.cube = new Mesh(
      box,
      Array.from({ length: 6 }, () => new MeshBasicMaterial()),
    );
    this.rim = new LineSegments(new EdgesGeometry(box), new LineBasicMaterial());
    this.highlight = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial({ transparent: true, opacity: 0.45 }));
    this.highlight.visible = false;
    const group = new Group();
    group.add(this.cube, this.rim, this.highlight);
    this.scene.add(group);
    this.paint();
  }

  setColors(face: string, ink: string, rim: string, accent: string): void {
    this.colors = { face, ink, rim };
    this.highlight.material.color.set(new Color(accent));
    this.paint();
  }

  /// Draws the cube over the view.
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

  /// The view direction (towards the eye) of a position on screen; null if it is not on the cube.
  pick(rig: CameraRig, x: number, y: number): Vector3 | null {
    const corner = this.corner(rig);
    const device = new Vector2(((x - corner.x) / kSize) * 2 - 1, 1 - ((y - corner.y) / kSize) * 2);
    if (Math.abs(device.x) > 1 || Math.abs(device.y) > 1) return null;
    const caster = new Raycaster();
    caster.setFromCamera(device, this.camera);
    const hit = caster.intersectObject(this.cube)[0];
    if (!hit) return null;
    const half = 0.55 * kEdgeZone;
    const sign = (value: number) => (Math.abs(value) > half ? Math.sign(value) : 0);
    return new Vector3(sign(hit.point.x), sign(hit.point.y), sign(hit.point.z));
  }

  /// Highlights the face, edge or corner of a view direction. Returns true if the highlight changed.
  hover(direction: Vector3 | null): boolean {
    const before = this.highlight.visible ? this.highlight.position.clone() : null;
    this.highlight.visible = direction !== null;
    if (direction) {
      const extent = (value: number) => (value === 0 ? 1.1 * kEdgeZone : 0.22);
      const offset = (value: number) => Math.sign(value) * 0.46;
      this.highlight.scale.set(extent(direction.x), extent(direction.y), extent(direction.z));
      this.highlight.position.set(offset(direction.x), offset(direction.y), offset(direction.z));
    }
    return direction === null ? before !== null : !before?.equals(this.highlight.position);
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
    const background = (context: CanvasRenderingContext2D) => {
      context.fillStyle = this.colors.face;
      context.fillRect(-64, -64, 128, 128);
    };
    const texture = labelTexture(name, { size: 128, color: this.colors.ink, font: "600 27px", background, turn });
    texture.anisotropy = 4;
    return texture;
  }
}
