// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import { type HandPose, motionOfHand, motionOfHands, roomMotionOfHands } from "../../src/xr/hand_motion.ts";

const hand = (x: number, y: number, z: number, turn = new Quaternion()): HandPose => ({
  position: new Vector3(x, y, z),
  orientation: turn,
});
const about = (x: number, y: number, z: number, angle: number) =>
  new Quaternion().setFromAxisAngle(new Vector3(x, y, z), angle);
const brings = (motion: Matrix4, from: Vector3, to: Vector3) =>
  assert.ok(from.clone().applyMatrix4(motion).distanceTo(to) < 1e-12, `${from.clone().applyMatrix4(motion).toArray()}`);

test("an object in one hand moves and rotates with it", () => {
  const motion = motionOfHand(hand(1, 0, 0), hand(1, 2, 0, about(0, 0, 1, Math.PI / 2)));
  brings(motion, new Vector3(1, 0, 0), new Vector3(1, 2, 0));
  brings(motion, new Vector3(2, 0, 0), new Vector3(1, 3, 0));
});

test("an object in both hands follows their midpoint and line, without scaling", () => {
  const motion = motionOfHands([hand(-1, 0, 0), hand(1, 0, 0)], [hand(5, -2, 0), hand(5, 2, 0)]);
  brings(motion, new Vector3(0, 0, 0), new Vector3(5, 0, 0));
  brings(motion, new Vector3(1, 0, 0), new Vector3(5, 1, 0));
});

test("hands at rest give no motion", () => {
  const pair: [HandPose, HandPose] = [hand(-1, 1, 0), hand(1, 2, 3, about(1, 0, 0, 0.3))];
  for (const motion of [motionOfHand(pair[1], pair[1]), motionOfHands(pair, pair), roomMotionOfHands(pair, pair)])
    motion.toArray().forEach((value, i) => {
      assert.ok(Math.abs(value - new Matrix4().elements[i]) < 1e-12);
    });
});

test("the room scales with the distance of the hands, and stays upright", () => {
  const motion = roomMotionOfHands([hand(0, 1, 0), hand(1, 1, 0)], [hand(0, 1, 0), hand(0, 2, -2)]);
  const up = new Vector3(0, 1, 0).transformDirection(motion);
  assert.ok(up.distanceTo(new Vector3(0, 1, 0)) < 1e-12);
  assert.ok(Math.abs(motion.getMaxScaleOnAxis() - Math.sqrt(5)) < 1e-12);
  brings(motion, new Vector3(0.5, 1, 0), new Vector3(0, 1.5, -1));
});
