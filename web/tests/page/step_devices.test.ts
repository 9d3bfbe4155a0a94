// SPDX-License-Identifier: Apache-2.0
// A third-party STEP assembly with a 3D mouse, a gamepad and a headset.
import assert from "node:assert/strict";
import { test } from "node:test";
import { connectDevices, deflect, pushStick } from "../support/devices.ts";
import {
  connectHeadset,
  enterHeadset,
  frames,
  grabWith,
  kAhead,
  moveHand,
  press,
  pressOnWrist,
  pullApart,
  releaseHand,
  scale,
  stage,
  waitForRelease,
} from "../support/headset.ts";
import { reset, useViewer, viewer, waitForEmptyHand, waitForMoves } from "../support/scene.ts";
import { chosen, chosenRemoved, isPresent, kThirdParty, pointerOffset, send, travel } from "../support/step.ts";

const skip = isPresent(kThirdParty) ? false : `${kThirdParty} is not here`;

useViewer([], {
  waits: false,
  before: async (page) => {
    await connectDevices(page);
    await connectHeadset(page);
  },
});

/// Pushes a device until the chosen component has moved along its free direction by more than `minTravel` [mm]. Returns
/// the travel after the release.
async function pushed(minTravel: number, push: (strength: number) => Promise<void>): Promise<number> {
  await push(1);
  await viewer.page.waitForFunction(
    ([name, direction, min]) => {
      const matrix = window.dismantle!.drawnMatrix(name);
      return direction.reduce((sum, value, k) => sum + value * matrix[12 + k], 0) > min;
    },
    [chosen.name, chosen.free, minTravel] as const,
  );
  await push(0);
  await waitForEmptyHand();
  await viewer.idle();
  return travel(chosen.free);
}

test("a 3D mouse and a gamepad move a component, which stops at contact", { skip }, async () => {
  await send(kThirdParty, 18, "nut");
  await viewer.select("nut");
  const [right, down] = await pointerOffset(1, 0);
  const sides: [number, number] = [Math.sign(Math.round(right)), Math.sign(Math.round(down))];
  const first = await pushed(3, (strength) =>
    deflect(120 * strength * sides[0], 0, 120 * strength * sides[1], 0, 0, 0),
  );
  assert.ok(first > 3 && Math.abs(await travel(chosen.blocked)) < 0.5);
  assert.equal((await viewer.state()).moves.length, 1);
  assert.equal(sides[1], 0, "the stick goes to the sides only");
  const second = await pushed(first + 2, (strength) => pushStick(0.5 * strength * sides[0]));
  assert.ok(second > first + 2);
  await deflect(0, 0, 300, 0, 0, 0); // down, into what it is around
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.frame?.blocked);
  assert.ok((await viewer.page.evaluate(() => window.dismantle!.app.session.store.blocking.size)) > 0);
  await viewer.page.keyboard.press("Escape");
  await waitForEmptyHand();
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.idle();
  assert.equal(await travel(chosen.free), second);
  await reset();
});

test("in a headset a hand moves a component, and the wrist panel takes it out", { skip }, async () => {
  await enterHeadset();
  const hand = await grabWith("right", "nut");
  assert.deepEqual(await viewer.selection(), ["nut"]);
  const per = await scale();
  // z is up in the assembly, y in the room.
  const [x, y, z] = chosen.free.map((value) => 25 * per * value);
  await moveHand("right", hand, { x, y: z, z: -y }, kAhead);
  await releaseHand("right");
  assert.ok(Math.abs((await travel(chosen.free)) - 25) < 2, `${await viewer.shift("nut")}`);
  const eye = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.eye!.toArray());
  const before = await eye();
  await viewer.page.evaluate(() => window.headset.position.set(0.2, 1.5, 0.1));
  await frames();
  assert.notDeepEqual(await eye(), before);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  await pressOnWrist("takeOut");
  await chosenRemoved(true);
  await viewer.idle();
  await pressOnWrist("putBack");
  await chosenRemoved(false);
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift("nut"), [0, 0, 0]);
});

test("in a headset two hands rotate a component, or move one each", { skip }, async () => {
  const per = await scale();
  const [x, y, z] = chosen.free.map((value) => 25 * per * value);
  const out = { x, y: z, z: -y };
  const first = await grabWith("right", "nut");
  await moveHand("right", first, out, kAhead);
  const other = await grabWith("left", "nut", { x: -0.15, y: 0.07, z: 0.25 });
  await moveHand("left", other, { x: 0, y: 0.05, z: 0.05 }, kAhead);
  const rotation = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.rotation);
  assert.ok(Math.abs(rotation[0]) < 0.9999, `${rotation}`);
  await press(viewer.page, "left", "trigger", 0);
  await releaseHand("right");
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("nut"), [0, 0, 0]);
  // The nut at the other end of the rod is free in the opposite direction.
  const right = await grabWith("right", "nut");
  const left = await grabWith("left", "nut#2");
  await moveHand("right", right, out, kAhead);
  const there = await viewer.drawnShift("nut");
  await moveHand("left", left, { x: -out.x, y: -out.y, z: -out.z }, kAhead);
  await press(viewer.page, "right", "trigger", 0);
  await press(viewer.page, "left", "trigger", 0);
  await waitForRelease();
  await viewer.idle();
  const along = (shift: number[]) => shift.reduce((sum, value, k) => sum + value * chosen.free[k], 0);
  assert.ok(along(there) > 10, `${there}`);
  assert.ok(along(await viewer.shift("nut#2")) < -10, `${await viewer.shift("nut#2")}`);
  for (let undone = 0; undone < 2; ++undone) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("nut#2"), [0, 0, 0]);
});

test("in a headset the panel undoes, finds a path and recenters; the grips scale the scene", { skip }, async () => {
  const { moves } = await viewer.state();
  await viewer.select("nut");
  await frames();
  await pressOnWrist("findPath");
  await chosenRemoved(true);
  await viewer.idle();
  const found = (await viewer.state()).moves.length;
  assert.ok(found > moves.length);
  await pressOnWrist("undo");
  await waitForMoves(found - 1);
  await viewer.idle();
  await pressOnWrist("redo");
  await waitForMoves(found);
  await viewer.idle();
  while ((await viewer.state()).moves.length > moves.length) await viewer.press("Control+z");
  await chosenRemoved(false);
  const before = await stage();
  await viewer.page.evaluate(() => window.headset.position.set(0.5, 1.5, 0.2));
  await frames();
  await pressOnWrist("place");
  await frames();
  assert.ok((await stage())[12] - before[12] > 0.2);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  const size = await scale();
  await pullApart();
  assert.ok(Math.abs((await scale()) / size - 2) < 0.05);
  await pressOnWrist("leave");
  await viewer.page.waitForFunction(() => !window.dismantle!.app.headset.active);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
