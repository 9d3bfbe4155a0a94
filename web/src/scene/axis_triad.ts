// SPDX-License-Identifier: Apache-2.0
import {
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  OrthographicCamera,
  Scene,
  Sprite,
  SpriteMaterial,
  Vector3,
  type WebGLRenderer,
} from "three";
import { kAxes, kAxisNames } from "../axes.ts";
import type { CameraRig } from "./camera_rig.ts";
import { labelTexture } from "./label_texture.ts";

const kSize = 84;
const kMargin = 4;
/// Length of an axis, and the position of its letter.
const kLength = 0.72;
const kLetterAt = 0.98;
const kLetterSize = 0.42;
const kTexture = 64;

/// The directions of the axes on screen, in the lower left corner: texts name directions by axes.
export class AxisTriad {
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1.25, 1.25, 1.25, -1.25, 0.1, 10);
  private readonly lines = new LineSegments(
    new BufferGeometry().setFromPoints(
      kAxes.flatMap((axis) => [new Vector3(), new Vector3().setComponent(axis, kLength)]),
    ),
    new LineBasicMaterial(),
  );
  private readonly letters = kAxes.map((axis) => {
    const letter = new Sprite(new SpriteMaterial({ depthTest: false }));
    letter.position.setComponent(axis, kLetterAt);
    letter.scale.setScalar(kLetterSize);
    return letter;
  });

  constructor() {
    this.scene.add(new Group().add(this.lines, ...this.letters));
  }

  setColor(ink: string): void {
    this.lines.material.color.set(ink);
    for (const [axis, letter] of this.letters.entries()) {
      letter.material.map?.dispose();
      letter.material.map = labelTexture(kAxisNames[axis], {
        size: kTexture,
        color: ink,
        font: "600 50px",
        background: () => {},
      });
      letter.material.needsUpdate = true;
    }
  }

  /// Draws the axes over the view.
  render(renderer: WebGLRenderer, rig: CameraRig): void {
    this.camera.position.copy(rig.axis("back").multiplyScalar(4));
    this.camera.quaternion.copy(rig.camera.quaternion);
    this.camera.updateMatrixWorld(true);
    renderer.setScissorTest(true);
    renderer.setViewport(kMargin, kMargin, kSize, kSize);
    renderer.setScissor(kMargin, kMargin, kSize, kSize);
    renderer.clearDepth();
    renderer.render(this.scene, this.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, rig.size.x, rig.size.y);
  }
}
