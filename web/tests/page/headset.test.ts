// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { aimHand, press, wearHeadset } from "../support/headset.ts";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

type Place = { x: number; y: number; z: number };

useMicroscope({ before: wearHeadset });

/// Some pictures in the headset.
const frames = (count = 3) =>
  viewer.page.evaluate(async (n) => {
    for (let i = 0; i < n; ++i) await new Promise((resolve) => requestAnimationFrame(resolve));
  }, count);

/// A place in the room: of a component's upper side, one that a hand that is `from` away from it sees.
const inRoom = (name: string, from: Place): Promise<Place> =>
  viewer.page.evaluate(
    ([n, offset]) => {
      const { headset, viewport } = window.dismantle!.app;
      const { index, bounds } = viewport
        .model!.components.map((view) => ({ index: view.index, name: view.raw.name, bounds: view.bounds() }))
        .find((candidate) => candidate.name === n)!;
      const roomFromWorld = headset.stage.matrix;
      const { ray } = headset.hands[0];
      for (let part = 0.05; part < 1; part += 0.05) {
        const point = bounds.min.clone().lerp(bounds.max, 0.5);
        point.x = bounds.min.x + part * (bounds.max.x - bounds.min.x);
        point.z = bounds.max.z;
        const { x, y, z } = point.applyMatrix4(roomFromWorld);
        ray.origin.copy(point).add(offset as Place);
        ray.direction.copy(point).sub(ray.origin).normalize();
        const hit = viewport.castWorld(ray.clone().applyMatrix4(roomFromWorld.clone().invert()));
        if (hit?.component === index) return { x, y, z };
      }
      throw new Error(`${n} cannot be seen from there`);
    },
    [name, from] as const,
  );

const button = (id: string): Promise<Place> =>
  viewer.page.evaluate((name) => {
    const { x, y, z } = window.dismantle!.app.headset.panel.centerOf(name)!;
    return { x, y, z };
  }, id);

/// Metres of the room for a millimetre of the world.
const scale = () => viewer.page.evaluate(() => window.dismantle!.app.headset.stage.matrix.getMaxScaleOnAxis());

/// It is free to the right.
const kOther = "coarse knob#2";
const kFront = { x: 0, y: 0.07, z: 0.25 };
const plus = (a: Place, b: Place): Place => ({ x: a.x + b.x, y: a.y + b.y, z: a.z + b.z });

/// Points from above with one hand and presses the trigger. Gives where the hand is.
async function take(side: "left" | "right", name: string, from = kFront): Promise<Place> {
  const there = await inRoom(name, from);
  const hand = plus(there, from);
  await aimHand(viewer.page, side, hand, there);
  await frames();
  await press(viewer.page, side, "trigger", 1);
  await frames();
  return hand;
}

/// Moves a hand that points as before.
async function carry(side: "left" | "right", from: Place, by: Place, aim: Place): Promise<void> {
  for (let i = 1; i <= 8; ++i) {
    const part = { x: (by.x * i) / 8, y: (by.y * i) / 8, z: (by.z * i) / 8 };
    const at = plus(from, part);
    await aimHand(viewer.page, side, at, plus(at, aim));
    await frames(2);
  }
  await viewer.idle();
}

/// Until nothing is in hand any more.
const handsEmpty = () =>
  viewer.page.waitForFunction(() => {
    const { drag, session } = window.dismantle!.app;
    return !drag.active && session.store.state!.hand === null;
  });

async function letGo(side: "left" | "right"): Promise<void> {
  await press(viewer.page, side, "trigger", 0);
  await handsEmpty();
  await viewer.idle();
}

const kAhead = { x: -kFront.x, y: -kFront.y, z: -kFront.z };

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

/// Points with the right hand at a button of the panel on the left wrist, and presses the trigger.
async function pressOnWrist(id: string): Promise<void> {
  await aimHand(viewer.page, "left", { x: -0.25, y: 1.2, z: -0.3 }, { x: -0.25, y: 1.2, z: -1 });
  await frames();
  const there = await button(id);
  await aimHand(viewer.page, "right", plus(there, { x: 0.1, y: 0.1, z: 0.25 }), there);
  await frames();
  await press(viewer.page, "right", "trigger", 1);
  await frames();
  await press(viewer.page, "right", "trigger", 0);
  await frames();
}

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

test("both grips pulled apart make the room larger", async () => {
  const before = await scale();
  const [a, b] = [
    { x: -0.1, y: 1.2, z: -0.3 },
    { x: 0.1, y: 1.2, z: -0.3 },
  ];
  const ahead = { x: 0, y: 0, z: -1 };
  for (const [side, at] of [
    ["left", a],
    ["right", b],
  ] as const)
    await aimHand(viewer.page, side, at, plus(at, ahead));
  await frames();
  for (const side of ["left", "right"] as const) await press(viewer.page, side, "squeeze", 1);
  await frames();
  await aimHand(viewer.page, "right", { x: 0.3, y: 1.2, z: -0.3 }, { x: 0.3, y: 1.2, z: -1 });
  await frames();
  for (const side of ["left", "right"] as const) await press(viewer.page, side, "squeeze", 0);
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
