// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  carry,
  frames,
  handsEmpty,
  inRoom,
  kAhead,
  kFront,
  letGo,
  plus,
  press,
  pressOnWrist,
  pullApart,
  scale,
  stage,
  take,
  wearHeadset,
} from "../support/headset.ts";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ before: wearHeadset });

/// It is free to the right.
const kOther = "coarse knob#2";

test("the scene comes to stand before the eyes, in a room in metres", async () => {
  await viewer.page.click("#headset");
  await viewer.page.waitForFunction(() => window.dismantle!.app.headset.active);
  await frames(20);
  const place = await inRoom("stage plate", kFront);
  assert.ok(Math.abs(place.x) < 0.5 && place.y > 0.5 && place.y < 2.2 && place.z < -0.2, JSON.stringify(place));
  const per = await scale();
  assert.ok(per > 0.0005 && per < 0.01, `${per}`);
});

test("the head moves the eyes", async () => {
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

test("one hand takes a component: it goes with the hand, and stops at what is in its way", async () => {
  const hand = await take("right", kSlide);
  assert.deepEqual(await viewer.selection(), [kSlide]);
  const per = await scale();
  await carry("right", hand, { x: 20 * per, y: -5 * per, z: 0 }, kAhead);
  const [x, , z] = await viewer.shift(kSlide).then(async () => {
    const frame = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.position);
    return frame;
  });
  assert.ok(Math.abs(x - 20) < 1, `${x}`);
  assert.ok(Math.abs(z) < 0.2, `it is pressed down, and the stage is there: ${z}`);
  const drawn = await viewer.drawnShift(kSlide);
  assert.ok(Math.abs(drawn[0] - x) < 1e-9);
  await letGo("right");
  assert.ok(Math.abs((await viewer.shift(kSlide))[0] - 20) < 1);
  assert.equal((await viewer.state()).undo, `move ${kSlide}`);
});

test("the other hand takes, too; and both together turn what they hold", async () => {
  const left = await take("left", kSlide);
  const right = await take("right", kSlide, { x: 0.15, y: 0.07, z: 0.25 });
  const per = await scale();
  // Up, then the right hand about the left one.
  await carry("left", left, { x: 0, y: 30 * per, z: 0 }, kAhead);
  await carry("right", right, { x: 0, y: 30 * per, z: 0.06 }, kAhead);
  const rotation = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.rotation);
  assert.ok(Math.abs(rotation[0]) < 0.999, `${rotation}`);
  await press(viewer.page, "right", "trigger", 0);
  await frames();
  assert.notEqual((await viewer.state()).hand, null, "the left one still holds it");
  await letGo("left");
});

test("two hands take two components, and each goes with its own", async () => {
  const start = await viewer.shift(kSlide);
  const right = await take("right", kSlide);
  const left = await take("left", kOther);
  const per = await scale();
  const toRight = { x: 25 * per, y: 0, z: 0 };
  const farther = { x: 40 * per, y: 0, z: 0 };
  const at = async (name: string) => (await viewer.drawnShift(name)) as number[];
  await carry("right", right, toRight, kAhead);
  const first = await at(kSlide);
  assert.ok(first[0] - start[0] > 10, `${start} ${first}`);
  assert.deepEqual(await at(kOther), [0, 0, 0]);
  await carry("left", left, farther, kAhead);
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 10, kOther);
  assert.deepEqual(await at(kSlide), first);
  await carry("right", plus(right, toRight), { x: -20 * per, y: 0, z: 0 }, kAhead);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] < (x as number) - 5,
    [kSlide, first[0]],
  );
  assert.ok((await at(kOther))[0] > 10);
  await press(viewer.page, "right", "trigger", 0);
  await press(viewer.page, "left", "trigger", 0);
  await handsEmpty();
  await viewer.idle();
  for (let undone = 0; undone < 3; ++undone) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(kOther), [0, 0, 0]);
  assert.deepEqual(await viewer.shift(kSlide), start);
});

test("the wrist panel undoes and redoes, in reach of the other hand's ray", async () => {
  const { moves } = await viewer.state();
  const count = (wanted: number) =>
    viewer.page.waitForFunction((n) => window.dismantle!.app.session.store.state!.moves.length === n, wanted);
  await pressOnWrist("undo");
  await count(moves.length - 1);
  await viewer.idle();
  await pressOnWrist("redo");
  await count(moves.length);
});

test("the wrist panel takes out, puts back, and says what contact does", async () => {
  await viewer.idle();
  await viewer.select("foot");
  const foot = await viewer.index("foot");
  const isRemoved = (removed: boolean) =>
    viewer.page.waitForFunction(
      ([c, wanted]) => {
        const { components, automatic } = window.dismantle!.app.session.store.state!;
        return automatic === null && Boolean(components[c as number].removed) === wanted;
      },
      [foot, removed] as const,
    );
  await pressOnWrist("takeOut");
  await isRemoved(true);
  await viewer.idle();
  await pressOnWrist("putBack");
  await isRemoved(false);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  for (const response of ["stop", "slide"]) {
    await pressOnWrist(response);
    await viewer.page.waitForFunction((r) => window.dismantle!.app.session.store.state!.response === r, response);
  }
});

test("the wrist panel finds a path: what is selected comes out, and first what is in its way", async () => {
  await viewer.idle();
  await viewer.select("pinion shaft");
  await frames();
  const { moves } = await viewer.state();
  await pressOnWrist("findPath");
  const shaft = await viewer.index("pinion shaft");
  await viewer.page.waitForFunction((c) => {
    const { components, automatic } = window.dismantle!.app.session.store.state!;
    return automatic === null && components[c].removed;
  }, shaft);
  await viewer.idle();
  const after = await viewer.state();
  assert.ok(after.moves.length > moves.length + 1, `${after.moves.length}`);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.drawn("pinion shaft")), false);
  while ((await viewer.state()).moves.length > moves.length) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("pinion shaft"), [0, 0, 0]);
});

test("the wrist panel places the scene anew, before the eyes", async () => {
  const before = await stage();
  await viewer.page.evaluate(() => window.headset.position.set(0.5, 1.5, 0.2));
  await frames();
  assert.deepEqual(await stage(), before, "the scene stays while the head moves");
  await pressOnWrist("place");
  await frames();
  const after = await stage();
  const moved = [12, 13, 14].map((k) => after[k] - before[k]);
  // What was taken out is not shown, and the middle of what is may differ by as much.
  assert.ok(Math.hypot(moved[0] - 0.5, moved[1] + 0.1, moved[2] - 0.2) < 0.2, `${moved}`);
  assert.equal((await viewer.state()).hand, null);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  await frames();
  await pressOnWrist("place");
});

test("both grips pulled apart make the room larger", async () => {
  const before = await scale();
  await pullApart();
  assert.ok(Math.abs((await scale()) / before - 2) < 0.05, `${(await scale()) / before}`);
});

test("leaving the headset gives the page back as it was", async () => {
  await pressOnWrist("leave");
  await viewer.page.waitForFunction(() => !window.dismantle!.app.headset.active);
  await viewer.press("1");
  await viewer.placeOf("base");
  await viewer.grab(kSlide, -40, 0);
  await viewer.letGo();
  assert.ok((await viewer.state()).moves.length > 1);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
