// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { type GuideStep, stepsOfPath } from "../../src/guide.ts";
import { trailsUntil } from "../../src/scene/trails.ts";

//   a goes up 10 mm in a second, b then 20 mm to the right in two.
const turned = [Math.SQRT1_2, 0, 0, Math.SQRT1_2] as const;
const steps: GuideStep[] = stepsOfPath(
  {
    moves: [
      { components: ["a"], frames: [0, 0.5, 1].map((t) => ({ t, position: [0, 0, 10 * t], rotation: [1, 0, 0, 0] })) },
      { components: ["b"], frames: [0, 2].map((t) => ({ t, position: [10 * t, 0, 0], rotation: [1, 0, 0, 0] })) },
    ],
  },
  ["a", "b"],
);
const center = (component: number) => new Vector3(component, 0, 0);
const ends = (time: number, size = 100) => trailsUntil(steps, time, center, size).map((point) => point.toArray());

test("at the beginning there are no trails", () => {
  assert.deepEqual(ends(0), []);
});

test("a trail leads from the assembled place to where the component is by now", () => {
  assert.deepEqual(ends(0.25), [
    [0, 0, 0],
    [0, 0, 2.5],
  ]);
});

test("each step draws its own trail, the later ones not before their time", () => {
  assert.deepEqual(ends(2), [
    [0, 0, 0],
    [0, 0, 5],
    [0, 0, 5],
    [0, 0, 10],
    [1, 0, 0],
    [11, 0, 0],
  ]);
});

test("pieces too short to be seen are joined, and the end is kept", () => {
  assert.deepEqual(ends(1, 5000), [
    [0, 0, 0],
    [0, 0, 10],
  ]);
});

test("a turn leads the centre round", () => {
  const turn = stepsOfPath(
    {
      moves: [
        {
          components: ["b"],
          frames: [
            { t: 0, position: [0, 0, 0], rotation: [1, 0, 0, 0] },
            { t: 1, position: [0, 0, 0], rotation: [...turned] },
          ],
        },
      ],
    },
    ["a", "b"],
  );
  const [, end] = trailsUntil(turn, 1, center, 100);
  assert.ok(end.distanceTo(new Vector3(0, 1, 0)) < 1e-12);
});
