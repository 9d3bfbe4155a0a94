// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { WirePose } from "../../src/wire/structs.ts";
import { Hold } from "../../src/xr/hold.ts";

/// A room in which a metre is a thousand millimetres of the world, and nothing is turned.
const kRoom = new Matrix4().makeScale(1e-3, 1e-3, 1e-3);
const kMoved: WirePose = { position: [5, 0, 0], rotation: [1, 0, 0, 0] };
const handAt = (x: number, y = 0) => ({ pose: { position: new Vector3(x, y, 0), orientation: new Quaternion() } });

function taken(...hands: { pose: { position: Vector3; orientation: Quaternion } }[]) {
  const hold = new Hold<(typeof hands)[0]>([0], new Vector3(7, 0, 0), kMoved);
  hold.regrip(hands, kRoom);
  return hold;
}

const shift = (motion: Matrix4) => new Vector3().setFromMatrixPosition(motion).toArray().map(Math.round);

test("what is held goes where its hand goes", () => {
  const hand = handAt(0);
  const hold = taken(hand);
  hand.pose = handAt(0.02, 0.01).pose;
  assert.deepEqual(shift(hold.motion(kRoom)), [20, 10, 0]);
  assert.ok(Math.abs(hold.stirred - Math.hypot(0.02, 0.01)) < 1e-12);
});

test("a hand that comes to help changes nothing by coming", () => {
  const [first, second] = [handAt(0), handAt(0.3)];
  const hold = taken(first);
  first.pose = handAt(0.02).pose;
  hold.regrip([first, second], kRoom);
  assert.deepEqual(shift(hold.motion(kRoom)), [20, 0, 0]);
});

test("what rested goes on from where its hand is by then", () => {
  const hand = handAt(0);
  const hold = taken(hand);
  hand.pose = handAt(0.02).pose;
  hold.rest();
  assert.equal(hold.stirred, 0);
  hand.pose = handAt(0.05).pose;
  assert.deepEqual(shift(hold.motion(kRoom)), [30, 0, 0]);
});

test("a hand that only turns stirs, too", () => {
  const hand = handAt(0);
  const hold = taken(hand);
  hand.pose.orientation = new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), 0.5);
  hold.rest();
  hand.pose = { position: hand.pose.position, orientation: new Quaternion() };
  assert.ok(Math.abs(hold.stirred - 0.05) < 1e-9);
});

test("the place where it was taken goes with it", () => {
  assert.deepEqual(
    taken(handAt(0))
      .point({ position: [0, 3, 0], rotation: [1, 0, 0, 0] })
      .toArray(),
    [2, 3, 0],
  );
});
