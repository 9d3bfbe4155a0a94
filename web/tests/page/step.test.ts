// SPDX-License-Identifier: Apache-2.0
// Assemblies that come as STEP files of the user's: what other tests do in the microscope is done here with a component of each.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Viewer } from "../support/page.ts";
import { loseConnection, restart, server, useViewer, viewer } from "../support/scene.ts";
import {
  chosen,
  drawnAsInEngine,
  gone,
  grab,
  isDrawn,
  isRemoved,
  isThere,
  kOfOthers,
  lookAt,
  pointerWay,
  send,
  type Way,
} from "../support/step.ts";

useViewer([], { waits: false });

const kMine = "samples/microscope.step";
/// A component that is blocked at once has no more play than this [mm].
const kSnug = 0.5;
/// What blocked the chosen component when it was pressed.
let neighbour = "";

const freeAxis = () => chosen.free.findIndex((value) => Math.abs(value) > 0.9);

async function press(): Promise<void> {
  await grab(0, 60);
  const { blocked, blocking, contacts, ghost } = await viewer.page.evaluate(() => {
    const { session, viewport } = window.dismantle!.app;
    const { frame } = session.store;
    return {
      blocked: frame!.blocked,
      blocking: [...session.store.blocking].map((c) => session.nameOf(c)),
      contacts: viewport.contacts.object.count,
      ghost: viewport.ghost.object.visible,
    };
  });
  assert.ok(blocked && contacts > 0 && ghost);
  [neighbour] = blocking;
  assert.ok((await viewer.page.locator("#tree-panel .badge.blocks").count()) > 0);
  assert.ok((await viewer.page.locator("#touches").innerText()).includes(neighbour));
  await viewer.page.locator("[data-banner=stuck]", { hasText: neighbour }).waitFor();
  await viewer.press("Control+z");
  await viewer.letGo();
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  assert.equal((await viewer.state()).undo, null);
}

async function slide(): Promise<void> {
  await grab(60, 20);
  await viewer.letGo();
  const reached = await gone(chosen.free);
  const { tolerance } = await viewer.page.evaluate(() => window.dismantle!.app.session.store.model!);
  assert.ok(
    reached > 1 && (await gone(chosen.blocked)) < kSnug + 2 * tolerance,
    `${reached} ${await gone(chosen.blocked)}`,
  );
  await drawnAsInEngine();
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.press("Control+y");
  assert.equal(await gone(chosen.free), reached);
  const key = "xyz"[freeAxis()];
  await viewer.press(key);
  await grab(20, -30);
  await viewer.press(key);
  await viewer.letGo();
  assert.ok((await gone(chosen.free)) > reached && (await viewer.state()).moves.length === 2);
}

/// Two clicks: the distance between what they hit, as one with the drawn components has it.
async function measure(): Promise<void> {
  await viewer.page.focus("#view");
  const moves = (await viewer.state()).moves.length;
  await viewer.press("f", "m");
  const label = viewer.page.locator("#measure-label");
  const points: Way[] = [];
  for (const name of [chosen.name, neighbour]) {
    const { x, y } = await viewer.placeOf(name);
    points.push(
      await viewer.page.evaluate(
        ([left, top]) => {
          const { viewport } = window.dismantle!.app;
          const box = viewport.canvas.getBoundingClientRect();
          return viewport.pick(left - box.left, top - box.top)!.point.toArray();
        },
        [x, y],
      ),
    );
    await viewer.page.mouse.click(x, y);
    await viewer.idle();
    if (points.length === 1) assert.match(await label.innerText(), /second point/);
  }
  const [from, to] = points;
  const distance = Math.hypot(...from.map((value, k) => value - to[k]));
  const shown = Number(/([\d.]+) mm/.exec(await label.innerText())![1]);
  assert.ok(distance > 1 && Math.abs(shown - distance) < 0.06, `${shown} ${distance}`);
  await viewer.press("m");
  assert.equal(await label.isVisible(), false);
  assert.equal((await viewer.state()).moves.length, moves);
}

async function allUndone(): Promise<void> {
  await viewer.page.focus("#view");
  while ((await viewer.state()).undo) await viewer.press("Control+z");
}

/// In mid-drag: it is drawn where the last frame has it.
const drawnInFrame = async () =>
  assert.deepEqual(
    await viewer.drawnShift(chosen.name),
    await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.position),
  );

/// Deeper with Shift, about with Alt, and back with Esc in mid-drag.
async function deeperAndAbout(): Promise<void> {
  await allUndone();
  for (const [key, words] of [
    ["Shift", /depth/],
    ["Alt", /turning/],
  ] as const) {
    await viewer.page.keyboard.down(key);
    await grab(12, -30);
    await viewer.page.keyboard.up(key);
    assert.match(await viewer.page.locator("#status .hint").innerText(), words);
    assert.equal((await viewer.state()).hand?.components.length, 1);
    await drawnInFrame();
    await viewer.press("Escape");
    await viewer.letGo();
    assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  }
  assert.equal((await viewer.state()).undo, null);
}

/// An arrow of the gizmo takes the component along its axis only; a ring turns it.
async function handles(): Promise<void> {
  await viewer.select(chosen.name);
  await viewer.page.focus("#view");
  await viewer.press("g");
  const pull = async (...places: [number, number][]) => {
    const center = await viewer.page.evaluate((name) => {
      const { model } = window.dismantle!.app.viewport;
      const { min, max } = model!.components.find(({ raw }) => raw.name === name)!.bounds();
      return window.dismantle!.project(min.clone().lerp(max, 0.5).toArray());
    }, chosen.name);
    const [first, ...others] = places.map(([x, y]) => [center.x + x, center.y + y] as const);
    await viewer.page.mouse.move(...first);
    await viewer.page.mouse.down();
    for (const place of others) await viewer.page.mouse.move(...place);
    await viewer.idle();
    await viewer.letGo();
  };
  const sign = Math.sign(chosen.free[freeAxis()]);
  await pull(
    await pointerWay(70 * sign, 0),
    await pointerWay(70 * sign + 30, 10),
    await pointerWay(70 * sign + 60, 25),
  );
  assert.ok((await gone(chosen.free)) > 1 && Math.abs(await gone(chosen.blocked)) < kSnug);
  await drawnAsInEngine();

  await viewer.page.evaluate((way) => {
    const { rig } = window.dismantle!.app.viewport;
    rig.lookFrom(rig.axis("back").fromArray(way));
  }, chosen.free);
  const onRing = (angle: number): [number, number] => [58 * Math.cos(angle), -58 * Math.sin(angle)];
  await pull(...[0.7, 0.75, 0.8, 0.85, 0.9].map(onRing));
  const turn = (await viewer.state()).components[await viewer.index(chosen.name)].pose!.slice(4);
  const about = turn.splice(freeAxis(), 1)[0];
  assert.ok(sign * about > Math.sin(0.05) && Math.hypot(...turn) < 0.1 * Math.abs(about), `${about} ${turn}`);
  await viewer.press("g");
}

async function moveByNumbers(): Promise<void> {
  const before = await gone(chosen.free);
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(5 * chosen.free[k]));
  await viewer.click("#numeric-apply");
  assert.ok(Math.abs((await gone(chosen.free)) - before - 5) < 0.1);
  await drawnAsInEngine();
}

async function takeOutAndBack(): Promise<void> {
  await allUndone();
  await lookAt(chosen.name);
  await viewer.press("d");
  const tip = await viewer.page.evaluate((free) => {
    const { directions, rig } = window.dismantle!.app.viewport;
    const arrow = directions.arrows.find(({ direction }) => direction.toArray().every((v, k) => v === free[k]))!;
    return window.dismantle!.project(
      arrow.point
        .clone()
        .addScaledVector(arrow.direction, 50 * rig.pixelSize(arrow.point))
        .toArray(),
    );
  }, chosen.free);
  await viewer.page.mouse.click(tip.x, tip.y);
  await isRemoved(true);
  await viewer.idle();
  assert.equal(await isDrawn(), false);
  await viewer.press("b");
  await isRemoved(false);
  await viewer.idle();
  assert.ok(await isDrawn());
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
}

async function replay(): Promise<void> {
  await grab(60, 0);
  await viewer.letGo();
  const there = await viewer.shift(chosen.name);
  await viewer.page.selectOption("#speed", "4");
  await viewer.page.click("#play-reverse");
  const stands = () =>
    viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.playing === false);
  await stands();
  await viewer.idle();
  const { components, playback } = await viewer.state();
  assert.ok(playback!.time === 0 && components.every(({ pose }) => !pose || Math.hypot(...pose.slice(0, 3)) < 1e-9));
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.page.fill("#scrub", "1000");
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift(chosen.name), there);
  await viewer.click("#play-stop");
  await viewer.press("e");
  await viewer.page.locator("[data-banner=exploded]").waitFor();
  await viewer.page.fill("#explode-slider", "0");
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.press("e");
  await viewer.page.locator("#explode-panel").waitFor({ state: "hidden" });
}

async function look(): Promise<void> {
  await viewer.page.focus("#view");
  await viewer.press("i");
  assert.equal((await viewer.state()).isolated, true);
  await viewer.press("i", " ");
  assert.equal(await isDrawn(), false);
  await viewer.press(" ");
  const whole = await viewer.picture();
  await viewer.click("#xray");
  assert.ok((await viewer.picture()) !== whole);
  await viewer.click("#xray");
  await viewer.page.focus("#view");
  await viewer.press("s");
  assert.ok((await viewer.picture()) !== whole);
  await viewer.press("s");
  await viewer.select(chosen.name);
  await viewer.page.locator("#pairs .badge").first().waitFor();
}

async function followAndFind(): Promise<void> {
  await viewer.click("#follow");
  await viewer.page.locator("#guide-step", { hasText: `take ${chosen.name}` }).waitFor();
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.click("#guide-close");
  await viewer.select(neighbour);
  await viewer.page.focus("#view");
  await viewer.page.keyboard.press("q");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.search?.kind === "why");
  assert.match(await viewer.page.locator("#reason p").first().innerText(), /along/);
  await viewer.select(chosen.name);
  await viewer.page.keyboard.press("n");
  await isRemoved(true);
  await viewer.press("Control+z");
  await viewer.page.click("#export");
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.page.click("#export-page-html")]);
  assert.match(download.suggestedFilename(), /\.html$/);
  await viewer.press("Escape");
}

/// A watcher, a lost line, and a killed server, in the middle of drags.
async function lose(file: string): Promise<void> {
  await lookAt(chosen.name);
  const watcher = await Viewer.open(server);
  await grab(25, 0);
  const held = await viewer.drawnShift(chosen.name);
  await loseConnection();
  await viewer.letGo();
  assert.deepEqual(await viewer.shift(chosen.name), held);
  await watcher.catchUpWith(viewer);
  assert.deepEqual(await watcher.drawnShift(chosen.name), held);
  await watcher.close();
  await grab(25, 0);
  const reached = await viewer.drawnShift(chosen.name);
  assert.ok((await viewer.state()).hand !== null && Math.hypot(...reached) > Math.hypot(...held));
  await restart("SIGKILL", [file]);
  assert.equal((await viewer.state()).resumed, true);
  assert.deepEqual(await viewer.drawnShift(chosen.name), reached);
}

test("a STEP file that is sent is taken apart by hand", async (t) => {
  await send(kMine, 41, "coarse knob#2");
  await t.test("pressed into its neighbour it stops, and goes back in mid-drag", press);
  await t.test("it goes out along an arrow that is clicked, and comes back", takeOutAndBack);
});

test("so is one that nobody of the project wrote, with all that can be done", async (t) => {
  if (!isThere(kOfOthers)) return t.skip(`${kOfOthers} is not here`);
  const file = await send(kOfOthers, 18, "nut");
  await t.test("pressed into its neighbour it stops, and goes back in mid-drag", press);
  await t.test("it slides along, and keeps to an axis", slide);
  await t.test("it is taken deeper, and turned", deeperAndAbout);
  await t.test("the gizmo takes it along an axis and about one", handles);
  await t.test("two clicks measure", measure);
  await t.test("it moves by numbers", moveByNumbers);
  await t.test("it goes out along an arrow that is clicked, and comes back", takeOutAndBack);
  await t.test("what was done is played backward to the assembled state, and exploded", replay);
  await t.test("it is isolated, hidden, seen through and cut, and its neighbours are listed", look);
  await t.test("it is followed, explained, found a way out, and exported", followAndFind);
  assert.deepEqual(viewer.problems, []);
  await t.test("nothing is lost with the line or the server", () => lose(file));
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
