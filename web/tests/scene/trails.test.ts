// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";
import { type GuideStep, stepsOfPath } from "../../src/guide.ts";
import { trailsUntil } from "../../src/scene/trails.ts";

//   a moves up 10 mm in 1 s, then b moves right 20 mm in 2 s.
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

test("there are no trails at the start", () => {
  assert.deepEqual(ends(0), []);
});

test("a trail leads from the assembled to the current position", () => {
  assert.deepEqual(ends(0.25), [
    [0, 0, 0],
    [0, 0, 2.5],
  ]);
});

test("each step has its own trail, once it has begun", () => {
  assert.deepEqual(ends(2), [
    [0, 0, 0],
    [0, 0, 5],
    [0, 0, 5],
    [0, 0, 10],
    [1, 0, 0],
    [11, 0, 0],
  ]);
});

test("short pieces are merged, and the end is kept", () => {
  assert.deepEqual(ends(1, 5000), [
    [0, 0, 0],
    [0, 0, 10],
  ]);
});

test("a rotation moves the centre along an arc", () => {
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
