// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Vector3 } from "three";
import type { CameraRig } from "./camera_rig.ts";
import type { ComponentView, ModelView } from "./model_view.ts";

/// A rectangle on screen [px].
export interface ScreenBox {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/// Which components a box selects: those that are inside, or those of which any part is.
export type BoxRule = "inside" | "crossing";

/// The visible components in a rectangle on screen, those behind others included. Vertices decide.
export function componentsInBox(model: ModelView, rig: CameraRig, box: ScreenBox, rule: BoxRule): number[] {
  const clipFromWorld = new Matrix4().multiplyMatrices(rig.camera.projectionMatrix, rig.camera.matrixWorldInverse);
  return model.components
    .filter((component) => component.visible && isInBox(component, clipFromWorld, rig, box, rule))
    .map(({ index }) => index);
}

function isInBox(component: ComponentView, clipFromWorld: Matrix4, rig: CameraRig, box: ScreenBox, rule: BoxRule) {
  const clipFromMesh = clipFromWorld.clone().multiply(component.object.matrix);
  const { positions } = component.shape.surface;
  const point = new Vector3();
  for (let i = 0; i < positions.length; i += 3) {
    point.set(positions[i], positions[i + 1], positions[i + 2]).applyMatrix4(clipFromMesh);
    const [x, y] = [(0.5 + 0.5 * point.x) * rig.size.x, (0.5 - 0.5 * point.y) * rig.size.y];
    const inside = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
    if (inside !== (rule === "inside")) return inside;
  }
  return rule === "inside" && positions.length > 0;
}
