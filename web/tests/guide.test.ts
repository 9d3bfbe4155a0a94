// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { type GuideStep, isDone, nextStep, poseAt, scoreOf, stepsOfPath } from "../src/guide.ts";
import type { WirePose } from "../src/wire/structs.ts";

const pose = (x: number, half = 0): WirePose => ({
  position: [x, 0, 0],
  rotation: [Math.cos(half), 0, 0, Math.sin(half)],
});
const step = (from: WirePose, to: WirePose): GuideStep => ({
  label: "",
  components: [0],
  frames: [
    { t: 0, pose: from },
    { t: 2, pose: to },
  ],
  duration: 2,
});

test("a path becomes steps; moves of unknown components are skipped", () => {
  const frames = [
    { t: 0, position: [0, 0, 0] as [number, number, number], rotation: [1, 0, 0, 0] as WirePose["rotation"] },
  ];
  const path = {
    moves: [
      { components: ["b", "a"], frames },
      { label: "x", components: ["gone"], frames },
    ],
  };
  const steps = stepsOfPath(path, ["a", "b"]);
  assert.deepEqual(
    steps.map(({ label, components }) => [label, components]),
    [["b, a", [1, 0]]],
  );
});

test("poses are interpolated between frames and clamped at the ends", () => {
  const motion = step(pose(0), pose(10, 0.4));
  assert.deepEqual(poseAt(motion, -1), pose(0));
  assert.deepEqual(poseAt(motion, 9), pose(10, 0.4));
  const half = poseAt(motion, 1);
  assert.ok(Math.abs(half.position[0] - 5) < 1e-12);
  assert.ok(Math.abs(half.rotation[3] - Math.sin(0.2)) < 1e-12);
});

test("a step is done after most of its displacement, beyond its end, and when the component is removed", () => {
  const motion = step(pose(0), pose(100));
  const at = (x: number) => isDone(motion, { pose: pose(x), removed: false });
  assert.deepEqual([at(0), at(50), at(75), at(100), at(300)], [false, false, true, true, true]);
  assert.equal(isDone(motion, { pose: null, removed: true }), true);
  assert.equal(isDone(motion, { pose: null, removed: false }), false);
});

test("a pure rotation is done when the component has rotated", () => {
  const motion = step(pose(0), pose(0, 0.5));
  assert.equal(isDone(motion, { pose: pose(0, 0.1), removed: false }), false);
  assert.equal(isDone(motion, { pose: pose(0, 0.45), removed: false }), true);
});

test("the next step is the first unfinished one, never an earlier one", () => {
  const steps = [step(pose(0), pose(100)), step(pose(100), pose(0)), step(pose(0), pose(50))];
  const now = (x: number) => () => ({ pose: pose(x), removed: false });
  assert.equal(nextStep(steps, 0, now(0)), 0);
  assert.equal(nextStep(steps, 0, now(100)), 1);
  assert.equal(nextStep(steps, 1, now(0)), 2);
  assert.equal(nextStep(steps, 2, now(60)), 3);
});

test("practice starts at 100 points and never goes below 0", () => {
  assert.equal(scoreOf({ wrong: 0, hints: 0, contacts: 0 }), 100);
  assert.equal(scoreOf({ wrong: 1, hints: 2, contacts: 3 }), 77);
  assert.equal(scoreOf({ wrong: 99, hints: 0, contacts: 0 }), 0);
});
