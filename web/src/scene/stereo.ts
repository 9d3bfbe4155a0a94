// SPDX-License-Identifier: Apache-2.0
import { type PerspectiveCamera, type Scene, StereoCamera, type Vector2, type WebGLRenderer } from "three";

/// Off; both eyes side by side, each squeezed to half the width, as 3D projectors take them; or red and cyan glasses.
export type StereoMode = "off" | "sideBySide" | "anaglyph";

export const kStereoModes: StereoMode[] = ["off", "sideBySide", "anaglyph"];

/// The eyes are apart by this part of the distance to what is looked at: deep, and still easy on them.
const kEyeSeparation = 1 / 30;

/// Draws a scene for two eyes that both look at what is at `distance`.
export class StereoPicture {
  private readonly eyes = new StereoCamera();

  draw(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: PerspectiveCamera,
    distance: number,
    mode: StereoMode,
    size: Vector2,
  ): void {
    camera.focus = distance;
    this.eyes.eyeSep = distance * kEyeSeparation;
    this.eyes.update(camera);
    if (mode === "sideBySide") this.drawSideBySide(renderer, scene, size);
    else this.drawAnaglyph(renderer, scene);
  }

  private drawSideBySide(renderer: WebGLRenderer, scene: Scene, size: Vector2): void {
    const half = size.x / 2;
    renderer.setScissorTest(true);
    [this.eyes.cameraL, this.eyes.cameraR].forEach((eye, i) => {
      renderer.setViewport(i * half, 0, half, size.y);
      renderer.setScissor(i * half, 0, half, size.y);
      renderer.render(scene, eye);
    });
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, size.x, size.y);
  }

  /// The left eye's picture in red, the right one's in green and blue.
  private drawAnaglyph(renderer: WebGLRenderer, scene: Scene): void {
    const gl = renderer.getContext();
    gl.colorMask(true, false, false, true);
    renderer.render(scene, this.eyes.cameraL);
    renderer.clear(false, true, true);
    gl.colorMask(false, true, true, true);
    renderer.render(scene, this.eyes.cameraR);
    gl.colorMask(true, true, true, true);
  }
}
