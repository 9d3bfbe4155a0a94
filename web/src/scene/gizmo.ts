// SPDX-License-Identifier: Apache-2.0
import { Group, Quaternion, Sprite, SpriteMaterial, Vector2, Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { kAxes, kAxisNames, kAxisVectors } from "../axes.ts";
import type { DragMode } from "../input/drag_motion.ts";
import { ArrowField, distanceToSegment } from "./arrow_field.ts";
import type { CameraRig } from "./camera_rig.ts";
import { labelTexture } from "./label_texture.ts";

const kArrowLength = 84;
const kRingRadius = 58;
const kPickDistance = 9;
const kSides = 48;
/// The axes are also told apart by the letters at their tips.
const kColors = ["#d55e00", "#009e73", "#0072b2"];

/// Handles at the centre of the selection: an arrow and a ring for each world axis. Dragging a handle is an ordinary
/// drag that is locked to the handle's axis.
export class Gizmo {
  readonly object = new Group();
  private readonly arrows = kColors.map((color) => new ArrowField(color, 1));
  private readonly rings = kAxes.map((axis) => ring(kAxisVectors[axis], kColors[axis]));
  private readonly letters = kAxes.map((axis) => letter(kAxisNames[axis], kColors[axis]));
  private center: Vector3 | null = null;

  constructor() {
    this.object.add(...this.arrows.map(({ object }) => object), ...this.rings, ...this.letters);
    this.object.visible = false;
  }

  /// @param center world frame; null: hides the gizmo
  place(center: Vector3 | null): void {
    this.center = center?.clone() ?? null;
    this.object.visible = center !== null;
  }

  /// Scales the handles for the camera. Call before each render.
  update(rig: CameraRig): void {
    const { center } = this;
    if (!center) return;
    const pixel = rig.pixelSize(center);
    kAxisVectors.forEach((axis, i) => {
      this.arrows[i].arrows = [{ point: center, direction: axis, length: kArrowLength }];
      this.arrows[i].update(rig);
      this.rings[i].position.copy(center);
      this.rings[i].scale.setScalar(kRingRadius * pixel);
      this.letters[i].position.copy(center).addScaledVector(axis, (kArrowLength + 14) * pixel);
      this.letters[i].scale.setScalar(20 * pixel);
    });
  }

  /// The drag that a position on screen starts; null: no handle there.
  pick(rig: CameraRig, x: number, y: number): DragMode | null {
    const { center } = this;
    if (!center) return null;
    const position = new Vector2(x, y);
    const pixel = rig.pixelSize(center);
    let [best, minDistance]: [DragMode | null, number] = [null, kPickDistance];
    const offer = (mode: DragMode, distance: number) => {
      if (distance < minDistance) [best, minDistance] = [mode, distance];
    };
    for (const axis of kAxes) {
      const vector = kAxisVectors[axis];
      const along = (part: number) => rig.project(center.clone().addScaledVector(vector, part * kArrowLength * pixel));
      offer({ kind: "plane", axis }, distanceToSegment(position, along(0.25), along(1)));
      const points = circle(vector).map((point) => rig.project(point.multiplyScalar(kRingRadius * pixel).add(center)));
      for (let k = 0; k < kSides; ++k)
        offer({ kind: "turn", axis }, distanceToSegment(position, points[k], points[k + 1]));
    }
    return best;
  }
}

function circle(axis: Vector3): Vector3[] {
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), axis);
  return Array.from({ length: kSides + 1 }, (_, k) => {
    const angle = (2 * Math.PI * k) / kSides;
    return new Vector3(Math.cos(angle), Math.sin(angle), 0).applyQuaternion(turn);
  });
}

function ring(axis: Vector3, color: string): LineSegments2 {
  const points = circle(axis);
  const ends = points.slice(1).flatMap((point, k) => [...points[k].toArray(), ...point.toArray()]);
  const material = new LineMaterial({ color, linewidth: 2.5, depthTest: false, transparent: true, opacity: 0.85 });
  const line = new LineSegments2(new LineSegmentsGeometry().setPositions(ends), material);
  line.renderOrder = 9;
  return line;
}

function letter(name: string, color: string): Sprite {
  const disc = (context: CanvasRenderingContext2D) => {
    context.fillStyle = color;
    context.beginPath();
    context.arc(0, 0, 26, 0, 2 * Math.PI);
    context.fill();
  };
  const map = labelTexture(name, { size: 64, color: "#ffffff", font: "700 36px", background: disc });
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: false, transparent: true }));
  sprite.renderOrder = 11;
  return sprite;
}
