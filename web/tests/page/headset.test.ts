// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  connectHeadset,
  enterHeadset,
  frames,
  grabWith,
  inRoom,
  kAhead,
  kFront,
  moveHand,
  plus,
  press,
  pressOnWrist,
  pullApart,
  releaseHand,
  scale,
  stage,
  waitForRelease,
} from "../support/headset.ts";
import { kSlide, useMicroscope, viewer, waitForMoves, waitForRemoved } from "../support/scene.ts";

useMicroscope({ before: connectHeadset });

/// A component that is free along +x.
const kOther = "coarse knob#2";

test("the scene is placed in front of the eyes, in metres", async () => {
  await enterHeadset();
  const position = await inRoom("stage plate", kFront);
  assert.ok(
    Math.abs(position.x) < 0.5 && position.y > 0.5 && position.y < 2.2 && position.z < -0.2,
    JSON.stringify(position),
  );
  const per = await scale();
  assert.ok(per > 0.0005 && per < 0.01, `${per}`);
});

test("head motion moves the eyes", async () => {
  const eye = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.eye!.toArray());
  const before = await eye();
  await viewer.page.evaluate(() => window.headset.position.set(0.2, 1.5, 0.1));
  await frames();
  const after = await eye();
  const [moved, per] = [after.map((value, k) => value - before[k]), await scale()];
  assert.ok(Math.abs(Math.hypot(...moved) * per - Math.hypot(0.2, 0.1, 0.1)) < 0.01, `${moved} ${per}`);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  await frames();
});

test("a hand grabs a component, which follows the hand and stops at contact", async () => {
  const hand = await grabWith("right", kSlide);
  assert.deepEqual(await viewer.selection(), [kSlide]);
  const per = await scale();
  await moveHand("right", hand, { x: 20 * per, y: -5 * per, z: 0 }, kAhead);
  const [x, , z] = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.position);
  assert.ok(Math.abs(x - 20) < 1, `${x}`);
  assert.ok(Math.abs(z) < 0.2, `the stage blocks it: ${z}`);
  const drawn = await viewer.drawnShift(kSlide);
  assert.ok(Math.abs(drawn[0] - x) < 1e-9);
  await releaseHand("right");
  assert.ok(Math.abs((await viewer.shift(kSlide))[0] - 20) < 1);
  assert.equal((await viewer.state()).undo, `move ${kSlide}`);
});

test("both hands together rotate a component", async () => {
  const left = await grabWith("left", kSlide);
  const right = await grabWith("right", kSlide, { x: 0.15, y: 0.07, z: 0.25 });
  const per = await scale();
  // Up, then the right hand around the left one.
  await moveHand("left", left, { x: 0, y: 30 * per, z: 0 }, kAhead);
  await moveHand("right", right, { x: 0, y: 30 * per, z: 0.06 }, kAhead);
  const rotation = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.rotation);
  assert.ok(Math.abs(rotation[0]) < 0.999, `${rotation}`);
  await press(viewer.page, "right", "trigger", 0);
  await frames();
  assert.notEqual((await viewer.state()).hand, null, "the left hand still holds it");
  await releaseHand("left");
});

test("each hand moves its own component", async () => {
  const start = await viewer.shift(kSlide);
  const right = await grabWith("right", kSlide);
  const left = await grabWith("left", kOther);
  const per = await scale();
  const toRight = { x: 25 * per, y: 0, z: 0 };
  const farther = { x: 40 * per, y: 0, z: 0 };
  const at = async (name: string) => (await viewer.drawnShift(name)) as number[];
  await moveHand("right", right, toRight, kAhead);
  const first = await at(kSlide);
  assert.ok(first[0] - start[0] > 10, `${start} ${first}`);
  assert.deepEqual(await at(kOther), [0, 0, 0]);
  await moveHand("left", left, farther, kAhead);
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 10, kOther);
  assert.deepEqual(await at(kSlide), first);
  await moveHand("right", plus(right, toRight), { x: -20 * per, y: 0, z: 0 }, kAhead);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] < (x as number) - 5,
    [kSlide, first[0]],
  );
  assert.ok((await at(kOther))[0] > 10);
  await press(viewer.page, "right", "trigger", 0);
  await press(viewer.page, "left", "trigger", 0);
  await waitForRelease();
  await viewer.idle();
  for (let undone = 0; undone < 3; ++undone) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(kOther), [0, 0, 0]);
  assert.deepEqual(await viewer.shift(kSlide), start);
});

test("the wrist panel undoes and redoes", async () => {
  const { moves } = await viewer.state();
  await pressOnWrist("undo");
  await waitForMoves(moves.length - 1);
  await viewer.idle();
  await pressOnWrist("redo");
  await waitForMoves(moves.length);
});

test("the wrist panel takes out, puts back, and sets the contact response", async () => {
  await viewer.idle();
  await viewer.select("foot");
  await pressOnWrist("takeOut");
  await waitForRemoved("foot");
  await viewer.idle();
  await pressOnWrist("putBack");
  await waitForRemoved("foot", false);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  for (const response of ["stop", "slide"]) {
    await pressOnWrist(response);
    await viewer.page.waitForFunction((r) => window.dismantle!.app.session.store.state!.response === r, response);
  }
});

test("the wrist panel finds a path: the selection is removed after its blockers", async () => {
  await viewer.idle();
  await viewer.select("pinion bush");
  await frames();
  const { moves } = await viewer.state();
  await pressOnWrist("findPath");
  await waitForRemoved("pinion bush");
  await viewer.idle();
  const after = await viewer.state();
  assert.ok(after.moves.length > moves.length + 1, `${after.moves.length}`);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.drawn("pinion bush")), false);
  while ((await viewer.state()).moves.length > moves.length) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("pinion bush"), [0, 0, 0]);
});

test("the wrist panel recenters the scene", async () => {
  const before = await stage();
  await viewer.page.evaluate(() => window.headset.position.set(0.5, 1.5, 0.2));
  await frames();
  assert.deepEqual(await stage(), before, "the scene stays while the head moves");
  await pressOnWrist("place");
  await frames();
  const after = await stage();
  const moved = [12, 13, 14].map((k) => after[k] - before[k]);
  // Removed components are hidden, so the centre of the visible ones may differ by this much.
  assert.ok(Math.hypot(moved[0] - 0.5, moved[1] + 0.1, moved[2] - 0.2) < 0.2, `${moved}`);
  assert.equal((await viewer.state()).hand, null);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  await frames();
  await pressOnWrist("place");
});

test("pulling both grips apart enlarges the scene", async () => {
  const before = await scale();
  await pullApart();
  assert.ok(Math.abs((await scale()) / before - 2) < 0.05, `${(await scale()) / before}`);
});

test("leaving the headset restores the page", async () => {
  await pressOnWrist("leave");
  await viewer.page.waitForFunction(() => !window.dismantle!.app.headset.active);
  await viewer.press("1");
  await viewer.visiblePoint("base");
  await viewer.grab(kSlide, -40, 0);
  await viewer.release();
  assert.ok((await viewer.state()).moves.length > 1);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
