// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { WirePose } from "../../src/wire/structs.ts";
import { Grab } from "../../src/xr/grab.ts";

/// A room with 1 m for 1000 mm of the world, without rotation.
const kRoom = new Matrix4().makeScale(1e-3, 1e-3, 1e-3);
const kMoved: WirePose = { position: [5, 0, 0], rotation: [1, 0, 0, 0] };
const handAt = (x: number, y = 0) => ({ pose: { position: new Vector3(x, y, 0), orientation: new Quaternion() } });

function grabbed(...hands: { pose: { position: Vector3; orientation: Quaternion } }[]) {
  const grab = new Grab<(typeof hands)[0]>([0], new Vector3(7, 0, 0), kMoved);
  grab.regrip(hands, kRoom);
  return grab;
}

const shift = (motion: Matrix4) => new Vector3().setFromMatrixPosition(motion).toArray().map(Math.round);

test("a grabbed set follows its hand", () => {
  const hand = handAt(0);
  const grab = grabbed(hand);
  hand.pose = handAt(0.02, 0.01).pose;
  assert.deepEqual(shift(grab.motion(kRoom)), [20, 10, 0]);
  assert.ok(Math.abs(grab.travel - Math.hypot(0.02, 0.01)) < 1e-12);
});

test("a second hand does not change the motion", () => {
  const [first, second] = [handAt(0), handAt(0.3)];
  const grab = grabbed(first);
  first.pose = handAt(0.02).pose;
  grab.regrip([first, second], kRoom);
  assert.deepEqual(shift(grab.motion(kRoom)), [20, 0, 0]);
});

test("after a rebase the motion starts at the hand's current pose", () => {
  const hand = handAt(0);
  const grab = grabbed(hand);
  hand.pose = handAt(0.02).pose;
  grab.rebase();
  assert.equal(grab.travel, 0);
  hand.pose = handAt(0.05).pose;
  assert.deepEqual(shift(grab.motion(kRoom)), [30, 0, 0]);
});

test("rotation of a hand counts as travel", () => {
  const hand = handAt(0);
  const grab = grabbed(hand);
  hand.pose.orientation = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), 0.5);
  grab.rebase();
  hand.pose = { position: hand.pose.position, orientation: new Quaternion() };
  assert.ok(Math.abs(grab.travel - 0.05) < 1e-9);
});

test("the grabbed point moves with the component", () => {
  assert.deepEqual(
    grabbed(handAt(0))
      .point({ position: [0, 3, 0], rotation: [1, 0, 0, 0] })
      .toArray(),
    [2, 3, 0],
  );
});
