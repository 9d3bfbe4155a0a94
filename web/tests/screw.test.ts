// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { poseBetween } from "../src/screw.ts";
import type { WirePose } from "../src/wire/structs.ts";

const kSome: WirePose = { position: [3, -4, 5], rotation: [Math.cos(0.3), 0, Math.sin(0.3), 0] };

/// A rotation about the axis through (100, 0, 0) along z, with a rise.
function helix(angle: number, rise: number): WirePose {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return { position: [100 - 100 * cos, -100 * sin, rise], rotation: [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)] };
}

function assertNear(a: WirePose, b: WirePose): void {
  for (let k = 0; k < 3; ++k) assert.ok(Math.abs(a.position[k] - b.position[k]) < 1e-9, `${a.position} ${b.position}`);
  const dot = a.rotation.reduce((sum, value, k) => sum + value * b.rotation[k], 0);
  assert.ok(Math.abs(Math.abs(dot) - 1) < 1e-12);
}

test("the ends of a motion are exact", () => {
  assert.equal(poseBetween(kSome, helix(1, 2), 0), kSome);
  const end = helix(1, 2);
  assert.equal(poseBetween(kSome, end, 1), end);
});

test("without a rotation the motion is straight", () => {
  const end: WirePose = { position: [13, -4, 25], rotation: kSome.rotation };
  assertNear(poseBetween(kSome, end, 0.25), { position: [5.5, -4, 10], rotation: kSome.rotation });
});

test("a rotation about a distant axis follows the arc, not its chord", () => {
  for (const share of [0.1, 0.37, 0.5, 0.9])
    assertNear(poseBetween(helix(0, 0), helix(2.5, 40), share), helix(2.5 * share, 40 * share));
});

test("the sign of a quaternion does not matter", () => {
  const [w, x, y, z] = helix(1.2, 0).rotation;
  const other: WirePose = { position: helix(1.2, 0).position, rotation: [-w, -x, -y, -z] };
  assertNear(poseBetween(helix(0, 0), other, 0.5), helix(0.6, 0));
});
