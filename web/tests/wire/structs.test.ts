// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { rateMessage, readPoseFrame, targetMessage } from "../../src/wire/structs.ts";

test("a target has its grip, its number and seven doubles", () => {
  const view = new DataView(targetMessage(3, 9, { position: [1, 2, 3], rotation: [1, 0, 0, 0.5] }));
  assert.equal(view.byteLength, 72);
  assert.deepEqual([view.getUint8(0), view.getUint32(4, true), view.getUint32(8, true)], [1, 3, 9]);
  assert.deepEqual([view.getFloat64(16, true), view.getFloat64(64, true)], [1, 0.5]);
});

test("a rate has six doubles", () => {
  const view = new DataView(rateMessage(3, 9, [1, 2, 3], [4, 5, 6]));
  assert.deepEqual([view.byteLength, view.getUint8(0), view.getFloat64(56, true)], [64, 2, 6]);
});

test("a pose that is cut off, or of another kind, is none", () => {
  const pose = new ArrayBuffer(96);
  assert.equal(readPoseFrame(pose), null);
  new DataView(pose).setUint8(0, 16);
  assert.notEqual(readPoseFrame(pose), null);
  assert.equal(readPoseFrame(pose.slice(0, 95)), null);
  new DataView(pose).setUint16(2, 1, true);
  assert.equal(readPoseFrame(pose), null);
});
