// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Ray, Vector3 } from "three";
import { type DragMode, DragMotion, type PointerStep } from "../../src/input/drag_motion.ts";

const kAssembled = {
  position: [0, 0, 0] as [number, number, number],
  rotation: [1, 0, 0, 0] as [number, number, number, number],
};

/// A pointer step in a parallel view along -y: x is right, z is up, a pixel is 0.5 mm.
function step(dx: number, dy: number): PointerStep {
  const ray = (x: number, z: number) => new Ray(new Vector3(x, -100, z), new Vector3(0, 1, 0));
  return {
    before: ray(0, 0),
    after: ray(dx / 2, -dy / 2),
    dx,
    dy,
    right: new Vector3(1, 0, 0),
    up: new Vector3(0, 0, 1),
    back: new Vector3(0, -1, 0),
    pixel: 0.5,
  };
}

function dragged(mode: DragMode, dx: number, dy: number, center = new Vector3()): DragMotion {
  const motion = new DragMotion(kAssembled, center, new Vector3(0, 5, 0));
  motion.move(step(dx, dy), mode);
  return motion;
}

const rounded = (values: number[]) => values.map((value) => Math.round(value * 1e6) / 1e6 + 0);

test("in the plane of the screen the grabbed point follows the pointer", () => {
  assert.deepEqual(rounded(dragged({ kind: "plane", axis: null }, 40, -20).target().position), [20, 0, 10]);
});

test("with a locked axis the target moves along it only", () => {
  assert.deepEqual(rounded(dragged({ kind: "plane", axis: 2 }, 40, -20).target().position), [0, 0, 10]);
});

test("along an axis that points at the eye, upwards on screen is away", () => {
  assert.deepEqual(rounded(dragged({ kind: "plane", axis: 1 }, 0, -20).target().position), [0, 10, 0]);
});

test("in depth, upwards on screen is away from the eye", () => {
  assert.deepEqual(rounded(dragged({ kind: "depth", axis: null }, 0, -20).target().position), [0, 10, 0]);
});

test("rotation keeps the centre fixed", () => {
  const center = new Vector3(7, 8, 9);
  const motion = dragged({ kind: "turn", axis: 2 }, 30, 0, center);
  const { position, rotation } = motion.target();
  const [w, x, y, z] = rotation;
  assert.deepEqual(rounded([x, y]), [0, 0]);
  assert.ok(Math.abs(2 * Math.atan2(z, w) - 0.3) < 1e-9);
  const moved = center
    .clone()
    .applyAxisAngle(new Vector3(0, 0, 1), 0.3)
    .add(new Vector3(...position));
  assert.ok(moved.distanceTo(center) < 1e-9);
});

test("about an axis along the line of sight, the rotation follows the pointer", () => {
  const center = new Vector3(7, 8, 9);
  const motion = new DragMotion(kAssembled, center, center);
  const ray = (x: number, z: number) => new Ray(new Vector3(7 + x, -100, 9 + z), new Vector3(0, 1, 0));
  const around = (before: Ray, after: Ray) => motion.move({ ...step(0, 0), before, after }, { kind: "turn", axis: 1 });
  around(ray(20, 0), ray(0, 20));
  assert.ok(new Vector3(1, 0, 0).applyQuaternion(motion.turn).distanceTo(new Vector3(0, 0, 1)) < 1e-9);
  around(ray(0, 20), ray(20, 0));
  assert.ok(Math.abs(motion.turn.w) > 1 - 1e-9);
});

test("steps of a motion add up", () => {
  const motion = new DragMotion(kAssembled, new Vector3(), new Vector3());
  for (let i = 0; i < 10; ++i) motion.move(step(4, -2), { kind: "plane", axis: null });
  assert.deepEqual(rounded(motion.target().position), [20, 0, 10]);
});
