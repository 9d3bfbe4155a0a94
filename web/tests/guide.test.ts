// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { type GuideStep, isDone, nextStep, pointsOf, poseAt, stepsOfPath } from "../src/guide.ts";
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

test("a path becomes steps; moves of unknown components are passed over", () => {
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

test("between two frames a pose is between them, and before and after the ends", () => {
  const way = step(pose(0), pose(10, 0.4));
  assert.deepEqual(poseAt(way, -1), pose(0));
  assert.deepEqual(poseAt(way, 9), pose(10, 0.4));
  const half = poseAt(way, 1);
  assert.ok(Math.abs(half.position[0] - 5) < 1e-12);
  assert.ok(Math.abs(half.rotation[3] - Math.sin(0.2)) < 1e-12);
});

test("a step is done at its end, most of the way, beyond it, and where the component is gone", () => {
  const way = step(pose(0), pose(100));
  const at = (x: number) => isDone(way, { pose: pose(x), removed: false });
  assert.deepEqual([at(0), at(50), at(75), at(100), at(300)], [false, false, true, true, true]);
  assert.equal(isDone(way, { pose: null, removed: true }), true);
  assert.equal(isDone(way, { pose: null, removed: false }), false);
});

test("a step that only turns is done when it has turned", () => {
  const way = step(pose(0), pose(0, 0.5));
  assert.equal(isDone(way, { pose: pose(0, 0.1), removed: false }), false);
  assert.equal(isDone(way, { pose: pose(0, 0.45), removed: false }), true);
});

test("the next step is the first that is not done, and never an earlier one", () => {
  const steps = [step(pose(0), pose(100)), step(pose(100), pose(0)), step(pose(0), pose(50))];
  const now = (x: number) => () => ({ pose: pose(x), removed: false });
  assert.equal(nextStep(steps, 0, now(0)), 0);
  assert.equal(nextStep(steps, 0, now(100)), 1);
  assert.equal(nextStep(steps, 1, now(0)), 2);
  assert.equal(nextStep(steps, 2, now(60)), 3);
});

test("practice begins at a hundred points and never goes below none", () => {
  assert.equal(pointsOf({ wrong: 0, hints: 0, contacts: 0 }), 100);
  assert.equal(pointsOf({ wrong: 1, hints: 2, contacts: 3 }), 77);
  assert.equal(pointsOf({ wrong: 99, hints: 0, contacts: 0 }), 0);
});
