// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { rateMessage, readPoseFrame, targetMessage } from "../../src/wire/structs.ts";
import { goldenFile } from "../support/environment.ts";

const golden = JSON.parse(readFileSync(goldenFile("wire.json"), "utf8"));
const hex = (bytes: ArrayBuffer) => Buffer.from(bytes).toString("hex");

test("a target is encoded as the server expects", () => {
  const { grip, number, position, rotation } = golden.target;
  assert.equal(hex(targetMessage(grip, number, { position, rotation })), golden.target.hex);
});

test("a rate is encoded as the server expects", () => {
  const { grip, number, velocity, angular_velocity } = golden.rate;
  assert.equal(hex(rateMessage(grip, number, velocity, angular_velocity)), golden.rate.hex);
});

test("a pose is decoded from the server's bytes", () => {
  const { flags, contacts, hex: bytes, ...expected } = golden.pose;
  const frame = readPoseFrame(Uint8Array.from(Buffer.from(bytes, "hex")).buffer)!;
  assert.deepEqual(
    [frame.reached, frame.blocked, frame.playback, frame.automatic],
    [1, 2, 4, 8].map((bit) => (flags & bit) !== 0),
  );
  assert.deepEqual(
    {
      state: frame.state,
      grip: frame.grip,
      answered: frame.number,
      position: frame.position,
      rotation: frame.rotation,
      clearance: frame.clearance,
      step_us: frame.stepTime,
      steps_per_second: frame.stepsPerSecond,
      time: frame.time,
    },
    expected,
  );
  assert.deepEqual(
    frame.contacts.map(({ moving, fixed, faceMoving, faceFixed, gap, point, normal }) => ({
      moving,
      fixed,
      face_moving: faceMoving,
      face_fixed: faceFixed,
      gap,
      point,
      normal,
    })),
    contacts,
  );
});

test("truncated and other messages are rejected", () => {
  const pose = new ArrayBuffer(96);
  assert.equal(readPoseFrame(pose), null);
  new DataView(pose).setUint8(0, 16);
  assert.notEqual(readPoseFrame(pose), null);
  assert.equal(readPoseFrame(pose.slice(0, 95)), null);
  new DataView(pose).setUint16(2, 1, true);
  assert.equal(readPoseFrame(pose), null);
});
