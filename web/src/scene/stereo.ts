// SPDX-License-Identifier: Apache-2.0
import { type PerspectiveCamera, type Scene, StereoCamera, type Vector2, type WebGLRenderer } from "three";

/// Off; side by side, each eye squeezed to half the width for 3D projectors; or anaglyph for red/cyan glasses.
export type StereoMode = "off" | "sideBySide" | "anaglyph";

/// All modes, in the order in which they are switched through.
export const kStereoModes: StereoMode[] = ["off", "sideBySide", "anaglyph"];

/// Eye separation as a fraction of the distance to the focus: clear depth without eye strain.
const kEyeSeparation = 1 / 30;

/// Draws a scene for two eyes that converge at `distance`.
export class StereoRenderer {
  private readonly eyes = new StereoCamera();

  /// @param distance of the focus [mm]; @param size of the view [px]
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

  /// Draws the left eye in red, the right eye in green and blue.
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
