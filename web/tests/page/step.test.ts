// SPDX-License-Identifier: Apache-2.0
// Assemblies that come as STEP files of the user's: what other tests do in the microscope is done here with a component of each.
import assert from "node:assert/strict";
import { copyFileSync, existsSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { Viewer } from "../support/page.ts";
import { loseConnection, restart, server, useViewer, viewer } from "../support/scene.ts";
import { sourceFolder } from "../support/tree.ts";

useViewer([], { waits: false });

const kMine = "samples/microscope.step";
const kOfOthers = "../shared/data/assemblies/as1_oc_214/original/as1-oc-214.stp";

type Way = [number, number, number];

/// A component that can be taken hold of from one side: a way that is free for it, and across it one that is blocked at once.
interface Case {
  name: string;
  free: Way;
  blocked: Way;
}

let chosen: Case;
/// What blocked it when it was pressed.
let neighbour = "";
/// A component that is blocked at once has no more play than this [mm].
const kSnug = 0.5;

async function upload(file: string): Promise<void> {
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.page.waitForFunction((name) => window.dismantle!.app.session.store.model?.name === name, basename(file));
  await viewer.model();
}

/// What is free for a component and what is not; looks at it from where both ways lie across the line of sight.
function lookAt(name: string): Promise<Case> {
  return viewer.page.evaluate(async (wanted) => {
    const { session, viewport } = window.dismantle!.app;
    const { components } = session.store.model!;
    const index = components.findIndex((component) => component.name === wanted);
    const ways = (await session.ask("free_directions", { components: [index] }))!.directions;
    const axis = (way: number[]) => way.findIndex((value) => Math.abs(value) > 0.9999);
    const free = ways.find((way) => way.free && axis(way.direction) >= 0)?.direction;
    const isWay = (at: number) => ways.some(({ direction }) => axis(direction) === at);
    for (const across of [0, 1, 2].filter((k) => free && k !== axis(free) && !isWay(k))) {
      const third = [0, 1, 2].find((k) => k !== axis(free!) && k !== across)!;
      for (const sign of [-1, 1]) {
        const box = viewport.model!.components[index].bounds();
        viewport.rig.fit(box.expandByScalar(0.6 * box.max.distanceTo(box.min)));
        viewport.rig.lookFrom(viewport.rig.axis("back").set(0, 0, 0).setComponent(third, sign));
        await window.dismantle!.idle();
        const blocked: Way = [0, 0, 0];
        blocked[across] = 1;
        if (window.dismantle!.placeOf(wanted)) return { name: wanted, free: free!, blocked };
      }
    }
    throw new Error(`${wanted} cannot be taken hold of: ${JSON.stringify(ways)}`);
  }, name);
}

/// The way of the pointer for ways of the chosen component along what is free and what is blocked [px].
function pointerWay(along: number, across: number): Promise<[number, number]> {
  return viewer.page.evaluate(
    ([{ name, free, blocked }, a, b]) => {
      const { rig, model } = window.dismantle!.app.viewport;
      const { min, max } = model!.components.find(({ raw }) => raw.name === name)!.bounds();
      const center = min.clone().lerp(max, 0.5);
      const pixel = rig.pixelSize(center);
      const [from, to] = [
        center.toArray(),
        center.toArray().map((value, k) => value + pixel * (a * free[k] + b * blocked[k])),
      ];
      const [p, q] = [window.dismantle!.project(from as Way), window.dismantle!.project(to as Way)];
      return [q.x - p.x, q.y - p.y];
    },
    [chosen, along, across] as const,
  );
}

const grab = async (along: number, across: number) => viewer.grab(chosen.name, ...(await pointerWay(along, across)));
/// How far the engine has the component along a way [mm].
const gone = async (way: Way) => (await viewer.shift(chosen.name)).reduce((sum, value, k) => sum + value * way[k], 0);
const drawnAsInEngine = async () =>
  assert.deepEqual(await viewer.drawnShift(chosen.name), await viewer.shift(chosen.name));
const isRemoved = (removed: boolean) =>
  viewer.page.waitForFunction(
    ([name, wanted]) => {
      const { model, state } = window.dismantle!.app.session.store;
      const index = model!.components.findIndex((c) => c.name === name);
      return state!.automatic === null && Boolean(state!.components[index].removed) === wanted;
    },
    [chosen.name, removed] as const,
  );
const isDrawn = () => viewer.page.evaluate((n) => window.dismantle!.drawn(n), chosen.name);

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
  const axis = chosen.free.findIndex((value) => Math.abs(value) > 0.9);
  await viewer.press("xyz"[axis]);
  await grab(20, -30);
  await viewer.press("xyz"[axis]);
  await viewer.letGo();
  assert.ok((await gone(chosen.free)) > reached && (await viewer.state()).moves.length === 2);
}

async function moveByNumbers(): Promise<void> {
  const before = await gone(chosen.free);
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(5 * chosen.free[k]));
  await viewer.click("#numeric-apply");
  assert.ok(Math.abs((await gone(chosen.free)) - before - 5) < 0.1);
  await drawnAsInEngine();
}

async function takeOutAndBack(): Promise<void> {
  await viewer.page.focus("#view");
  while ((await viewer.state()).undo) await viewer.press("Control+z");
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

/// Sends a file of the tree or beside it, and looks at one of its components. Gives where the server finds it.
async function send(from: string, components: number, name: string): Promise<string> {
  const file = join(server.home, basename(from));
  copyFileSync(join(sourceFolder(), from), file);
  await upload(file);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), components);
  chosen = await lookAt(name);
  return file;
}

test("a STEP file that is sent is taken apart by hand", async (t) => {
  await send(kMine, 41, "coarse knob#2");
  await t.test("pressed into its neighbour it stops, and goes back in mid-drag", press);
  await t.test("it goes out along an arrow that is clicked, and comes back", takeOutAndBack);
});

test("so is one that nobody of the project wrote, with all that can be done", async (t) => {
  if (!existsSync(join(sourceFolder(), kOfOthers))) return t.skip(`${kOfOthers} is not here`);
  const file = await send(kOfOthers, 18, "nut");
  await t.test("pressed into its neighbour it stops, and goes back in mid-drag", press);
  await t.test("it slides along, and keeps to an axis", slide);
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
