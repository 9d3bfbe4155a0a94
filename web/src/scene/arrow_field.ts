// SPDX-License-Identifier: Apache-2.0
import { InstancedMesh, LatheGeometry, Matrix4, MeshBasicMaterial, Quaternion, Vector2, Vector3 } from "three";
import type { CameraRig } from "./camera_rig.ts";

/// An arrow drawn with a constant size on screen.
export interface Arrow {
  point: Vector3;
  direction: Vector3;
  /// [px]
  length: number;
}

const kUpAxis = new Vector3(0, 1, 0);
/// Clicks within this distance hit an arrow [px].
const kPickDistance = 12;

/// Arrows with a ball at their origin, visible through everything.
export class ArrowField {
  readonly object: InstancedMesh;
  arrows: Arrow[] = [];

  constructor(
    color: string,
    private readonly capacity: number,
  ) {
    const material = new MeshBasicMaterial({ color, depthTest: false, transparent: true });
    this.object = new InstancedMesh(arrowShape(), material, capacity);
    this.object.count = 0;
    this.object.frustumCulled = false;
    this.object.renderOrder = 10;
  }

  set color(color: string) {
    (this.object.material as MeshBasicMaterial).color.set(color);
  }

  /// Scales the arrows for the camera. Call before each render.
  update(rig: CameraRig): void {
    if (this.arrows.length === 0 && this.object.count === 0) return;
    const matrix = new Matrix4();
    const shown = this.arrows.slice(0, this.capacity);
    shown.forEach((arrow, i) => {
      const scale = rig.pixelSize(arrow.point) * arrow.length;
      const turn = new Quaternion().setFromUnitVectors(kUpAxis, arrow.direction.clone().normalize());
      this.object.setMatrixAt(i, matrix.compose(arrow.point, turn, new Vector3(scale, scale, scale)));
    });
    this.object.count = shown.length;
    this.object.instanceMatrix.needsUpdate = true;
  }

  /// Index of the arrow closest to a position on screen, or -1.
  pick(rig: CameraRig, x: number, y: number): number {
    let [best, minDistance] = [-1, kPickDistance];
    this.arrows.forEach((arrow, i) => {
      const tip = arrow.point.clone().addScaledVector(arrow.direction, rig.pixelSize(arrow.point) * arrow.length);
      const distance = distanceToSegment(new Vector2(x, y), rig.project(arrow.point), rig.project(tip));
      if (distance < minDistance) [best, minDistance] = [i, distance];
    });
    return best;
  }
}

/// A ball, a shaft and a tip along +y, of length 1.
function arrowShape(): LatheGeometry {
  const ball = Array.from({ length: 7 }, (_, i) => {
    const angle = -Math.PI / 2 + (i / 6) * 2.6;
    return new Vector2(0.13 * Math.cos(angle), 0.13 * Math.sin(angle));
  });
  const rest = [new Vector2(0.035, 0.15), new Vector2(0.035, 0.68), new Vector2(0.12, 0.68), new Vector2(0, 1)];
  return new LatheGeometry([...ball, ...rest], 14);
}

/// Distance of a position on screen from a segment [px].
export function distanceToSegment(position: Vector2, a: Vector3, b: Vector3): number {
  const [from, along] = [new Vector2(a.x, a.y), new Vector2(b.x - a.x, b.y - a.y)];
  const part = along.lengthSq() === 0 ? 0 : position.clone().sub(from).dot(along) / along.lengthSq();
  return from.addScaledVector(along, Math.min(1, Math.max(0, part))).distanceTo(position);
}
