// SPDX-License-Identifier: Apache-2.0
import { Group, Quaternion, Sprite, SpriteMaterial, Vector2, Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { DragMode } from "../input/drag_motion.ts";
import type { CameraRig } from "./camera_rig.ts";
import { ArrowField, distanceToSegment } from "./marks.ts";
import { wordTexture } from "./word_texture.ts";

const kArrow = 84;
const kRing = 58;
const kReach = 9;
const kSides = 48;
/// Told apart by the letters at their tips, too.
const kColors = ["#d55e00", "#009e73", "#0072b2"];
const kAxes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/// Handles at the centre of what is selected: an arrow and a ring for each world axis. It is a place to grab, no more:
/// a drag of a handle is an ordinary drag that keeps to the handle's axis.
export class Gizmo {
  readonly object = new Group();
  private readonly arrows = kColors.map((color) => new ArrowField(color, 1));
  private readonly rings = kAxes.map((axis, i) => ring(axis, kColors[i]));
  private readonly letters = kColors.map((color, i) => letter("XYZ"[i], color));
  private center: Vector3 | null = null;

  constructor() {
    this.object.add(...this.arrows.map(({ object }) => object), ...this.rings, ...this.letters);
    this.object.visible = false;
  }

  /// @param center null: none
  place(center: Vector3 | null): void {
    this.center = center?.clone() ?? null;
    this.object.visible = center !== null;
  }

  /// Sizes the handles for the camera; call before each picture.
  update(rig: CameraRig): void {
    const { center } = this;
    if (!center) return;
    const pixel = rig.pixelSize(center);
    kAxes.forEach((axis, i) => {
      this.arrows[i].arrows = [{ point: center, direction: axis, length: kArrow }];
      this.arrows[i].update(rig);
      this.rings[i].position.copy(center);
      this.rings[i].scale.setScalar(kRing * pixel);
      this.letters[i].position.copy(center).addScaledVector(axis, (kArrow + 14) * pixel);
      this.letters[i].scale.setScalar(20 * pixel);
    });
  }

  /// What a drag from a place on screen would do, or null beside the handles.
  pick(rig: CameraRig, x: number, y: number): DragMode | null {
    const { center } = this;
    if (!center) return null;
    const place = new Vector2(x, y);
    const pixel = rig.pixelSize(center);
    let [best, least]: [DragMode | null, number] = [null, kReach];
    const offer = (mode: DragMode, distance: number) => {
      if (distance < least) [best, least] = [mode, distance];
    };
    kAxes.forEach((axis, i) => {
      const along = (part: number) => rig.project(center.clone().addScaledVector(axis, part * kArrow * pixel));
      offer({ kind: "plane", axis: i as 0 | 1 | 2 }, distanceToSegment(place, along(0.25), along(1)));
      const points = circle(axis).map((point) => rig.project(point.multiplyScalar(kRing * pixel).add(center)));
      for (let k = 0; k < kSides; ++k)
        offer({ kind: "turn", axis: i as 0 | 1 | 2 }, distanceToSegment(place, points[k], points[k + 1]));
    });
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
  const disc = (brush: CanvasRenderingContext2D) => {
    brush.fillStyle = color;
    brush.beginPath();
    brush.arc(0, 0, 26, 0, 2 * Math.PI);
    brush.fill();
  };
  const map = wordTexture(name, { size: 64, color: "#ffffff", font: "700 36px", ground: disc });
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: false, transparent: true }));
  sprite.renderOrder = 11;
  return sprite;
}
