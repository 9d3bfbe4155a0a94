// SPDX-License-Identifier: Apache-2.0
// Third-party STEP assemblies: what other tests do with the microscope is done here with one component of each.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Viewer } from "../support/page.ts";
import {
  loseConnection,
  restart,
  server,
  useViewer,
  viewer,
  waitForPlaybackEnd,
  waitForSearch,
} from "../support/scene.ts";
import {
  chosen,
  chosenRemoved,
  type Direction,
  drawnAsInEngine,
  grab,
  isDrawn,
  isPresent,
  kThirdParty,
  lookAt,
  pointerOffset,
  send,
  travel,
} from "../support/step.ts";

useViewer([], { waits: false });

const kOwnFile = "samples/microscope.step";
/// Play of a component that is blocked at once [mm].
const kMaxPlay = 0.5;
/// The component that blocked the chosen one.
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
  await viewer.release();
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  assert.equal((await viewer.state()).undo, null);
}

async function slide(): Promise<void> {
  await grab(60, 20);
  await viewer.release();
  const reached = await travel(chosen.free);
  const { tolerance } = await viewer.page.evaluate(() => window.dismantle!.app.session.store.model!);
  assert.ok(
    reached > 1 && (await travel(chosen.blocked)) < kMaxPlay + 2 * tolerance,
    `${reached} ${await travel(chosen.blocked)}`,
  );
  await drawnAsInEngine();
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.press("Control+y");
  assert.equal(await travel(chosen.free), reached);
  const key = "xyz"[freeAxis()];
  await viewer.press(key);
  await grab(20, -30);
  await viewer.press(key);
  await viewer.release();
  assert.ok((await travel(chosen.free)) > reached && (await viewer.state()).moves.length === 2);
}

/// Measures between two clicks and compares with the picked points.
async function measure(): Promise<void> {
  await viewer.page.focus("#view");
  const moves = (await viewer.state()).moves.length;
  await viewer.press("f", "m");
  const label = viewer.page.locator("#measure-label");
  const points: Direction[] = [];
  for (const name of [chosen.name, neighbour]) {
    const { x, y } = await viewer.visiblePoint(name);
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
    if (points.length === 1) assert.match(await label.innerText(), /second one/);
  }
  const [from, to] = points;
  const distance = Math.hypot(...from.map((value, k) => value - to[k]));
  const shown = Number(/([\d.]+) mm/.exec(await label.innerText())![1]);
  // Of the faces or edges under the points, which are no further apart than the points.
  assert.ok(distance > 1 && shown >= 0 && shown < distance + 0.06, `${shown} ${distance}`);
  await viewer.press("m");
  assert.equal(await label.isVisible(), false);
  assert.equal((await viewer.state()).moves.length, moves);
}

async function undoAll(): Promise<void> {
  await viewer.page.focus("#view");
  while ((await viewer.state()).undo) await viewer.press("Control+z");
}

/// True during a drag: the component is drawn at the last frame's pose.
const drawnInFrame = async () =>
  assert.deepEqual(
    await viewer.drawnShift(chosen.name),
    await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.position),
  );

/// In depth with Shift, rotation with Alt, and Esc during the drag.
async function depthAndRotation(): Promise<void> {
  await undoAll();
  for (const [key, hint] of [
    ["Shift", /away from you/],
    ["Alt", /rotating/],
  ] as const) {
    await viewer.page.keyboard.down(key);
    await grab(12, -30);
    await viewer.page.keyboard.up(key);
    assert.match(await viewer.page.locator("#status .hint").innerText(), hint);
    assert.equal((await viewer.state()).hand?.components.length, 1);
    await drawnInFrame();
    await viewer.press("Escape");
    await viewer.release();
    assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  }
  assert.equal((await viewer.state()).undo, null);
}

/// An arrow of the gizmo moves the component along its axis only; a ring rotates it.
async function gizmoHandles(): Promise<void> {
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
    for (const position of others) await viewer.page.mouse.move(...position);
    await viewer.idle();
    await viewer.release();
  };
  const sign = Math.sign(chosen.free[freeAxis()]);
  await pull(
    await pointerOffset(70 * sign, 0),
    await pointerOffset(70 * sign + 30, 10),
    await pointerOffset(70 * sign + 60, 25),
  );
  assert.ok((await travel(chosen.free)) > 1 && Math.abs(await travel(chosen.blocked)) < kMaxPlay);
  await drawnAsInEngine();

  await viewer.page.evaluate((direction) => {
    const { rig } = window.dismantle!.app.viewport;
    rig.lookFrom(rig.axis("back").fromArray(direction));
  }, chosen.free);
  const onRing = (angle: number): [number, number] => [58 * Math.cos(angle), -58 * Math.sin(angle)];
  await pull(...[0.7, 0.75, 0.8, 0.85, 0.9].map(onRing));
  const turn = (await viewer.state()).components[await viewer.index(chosen.name)].pose!.slice(4);
  const about = turn.splice(freeAxis(), 1)[0];
  assert.ok(sign * about > Math.sin(0.05) && Math.hypot(...turn) < 0.1 * Math.abs(about), `${about} ${turn}`);
  await viewer.press("g");
}

async function moveByNumbers(): Promise<void> {
  const before = await travel(chosen.free);
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(5 * chosen.free[k]));
  await viewer.click("#numeric-apply");
  assert.ok(Math.abs((await travel(chosen.free)) - before - 5) < 0.1);
  await drawnAsInEngine();
}

async function takeOutAndBack(): Promise<void> {
  await undoAll();
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
  await chosenRemoved(true);
  await viewer.idle();
  assert.equal(await isDrawn(), false);
  await viewer.press("b");
  await chosenRemoved(false);
  await viewer.idle();
  assert.ok(await isDrawn());
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
}

async function replay(): Promise<void> {
  await grab(60, 0);
  await viewer.release();
  const there = await viewer.shift(chosen.name);
  await viewer.page.selectOption("#speed", "4");
  await viewer.page.click("#play-reverse");
  await waitForPlaybackEnd();
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

async function viewTools(): Promise<void> {
  await viewer.page.focus("#view");
  await viewer.press("i");
  assert.equal((await viewer.state()).isolated, true);
  await viewer.press("i", " ");
  assert.equal(await isDrawn(), false);
  await viewer.press(" ");
  await viewer.select(chosen.name);
  await viewer.page.focus("#view");
  await viewer.press("f");
  const whole = await viewer.picture();
  await viewer.click("#xray");
  assert.ok((await viewer.picture()) !== whole, "X-ray");
  await viewer.click("#xray");
  await viewer.page.focus("#view");
  await viewer.press("s");
  assert.ok((await viewer.picture()) !== whole, "section");
  await viewer.press("s");
  await viewer.select(chosen.name);
  await viewer.page.locator("#pairs .badge").first().waitFor();
}

async function followAndFind(): Promise<void> {
  await viewer.click("#follow");
  await viewer.page.locator("#guide-step", { hasText: `remove ${chosen.name}` }).waitFor();
  assert.deepEqual(await viewer.drawnShift(chosen.name), [0, 0, 0]);
  await viewer.click("#guide-close");
  await viewer.select(neighbour);
  await viewer.page.focus("#view");
  await viewer.page.keyboard.press("q");
  await waitForSearch("why");
  assert.match(await viewer.page.locator("#reason p").first().innerText(), /along/);
  await viewer.select(chosen.name);
  await viewer.page.keyboard.press("n");
  await chosenRemoved(true);
  await viewer.press("Control+z");
  await viewer.page.click("#export");
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.page.click("#export-page-html")]);
  assert.match(download.suggestedFilename(), /\.html$/);
  await viewer.press("Escape");
}

/// A watching page, a lost connection and a killed server during drags.
async function connectionLoss(file: string): Promise<void> {
  await lookAt(chosen.name);
  const watcher = await Viewer.open(server);
  await grab(25, 0);
  const held = await viewer.drawnShift(chosen.name);
  await loseConnection();
  await viewer.release();
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

test("an uploaded STEP file can be disassembled by hand", async (t) => {
  await send(kOwnFile, 41, "coarse knob#2");
  await t.test("pressed against its neighbour it stops, and undo during the drag returns it", press);
  await t.test("a clicked arrow takes it out, and it can be put back", takeOutAndBack);
});

test("all tools work on a third-party STEP file", async (t) => {
  if (!isPresent(kThirdParty)) return t.skip(`${kThirdParty} is not here`);
  const file = await send(kThirdParty, 18, "nut");
  await t.test("pressed against its neighbour it stops, and undo during the drag returns it", press);
  await t.test("it slides, and can be locked to an axis", slide);
  await t.test("it moves in depth, and rotates", depthAndRotation);
  await t.test("the gizmo moves it along an axis and rotates it about one", gizmoHandles);
  await t.test("measure gives the distance of two clicks", measure);
  await t.test("it moves by numbers", moveByNumbers);
  await t.test("a clicked arrow takes it out, and it can be put back", takeOutAndBack);
  await t.test("the recording plays backward to the assembled state, and explodes", replay);
  await t.test("isolate, hide, X-ray and section work, and neighbours are listed", viewTools);
  await t.test("guide, blockers, path search and export work", followAndFind);
  assert.deepEqual(viewer.problems, []);
  await t.test("nothing is lost with the connection or the server", () => connectionLoss(file));
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
