// SPDX-License-Identifier: Apache-2.0
// An assembly that nobody of the project wrote, given as STEP: the panels, the views and the devices. What the hand does with it
// is in step.test.ts.
import assert from "node:assert/strict";
import { copyFileSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { after, test } from "node:test";
import { validateBytes } from "gltf-validator";
import { connectDevices, deflect, pushStick } from "../support/devices.ts";
import {
  carry,
  frames,
  handsEmpty,
  kAhead,
  letGo,
  press,
  pressOnWrist,
  pullApart,
  scale,
  stage,
  take,
  wearHeadset,
} from "../support/headset.ts";
import { auditPath, reset, server, useViewer, viewer } from "../support/scene.ts";
import { choose, chosen, gone, grab, isRemoved, isThere, kOfOthers, pointerWay } from "../support/step.ts";
import { sourceFolder } from "../support/tree.ts";

const skip = isThere(kOfOthers) ? false : `${kOfOthers} is not here`;
const folder = mkdtempSync(join(tmpdir(), "dismantle-step-"));
const kFile = basename(kOfOthers);
if (!skip) copyFileSync(join(sourceFolder(), kOfOthers), join(folder, kFile));

useViewer(["--root", folder], {
  waits: false,
  before: async (page) => {
    await connectDevices(page);
    await wearHeadset(page);
  },
});
after(() => rmSync(folder, { recursive: true }));

/// Until the n-th assembly of the page is there.
async function opened(number: number): Promise<void> {
  await viewer.page.waitForFunction((n) => window.dismantle!.app.session.store.model?.number === n, number);
  await viewer.model();
}

test("it is opened from a folder, from what was recent, and by being dropped", { skip }, async () => {
  await viewer.page.click(`.roots .link-button:text-is("${kFile}")`);
  await opened(1);
  await viewer.click("#open");
  await viewer.page.click(`#recent .link-button:text-is("${kFile}")`);
  await opened(2);
  copyFileSync(join(folder, kFile), join(server.home, kFile));
  await viewer.page.evaluate(
    ([name, words]) => {
      const carried = new DataTransfer();
      carried.items.add(new File([words], name));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, cancelable: true }));
    },
    [kFile, readFileSync(join(folder, kFile), "latin1")],
  );
  await opened(3);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 18);
  await choose("nut");
});

const camera = () =>
  viewer.page.evaluate(() => {
    const { focus, orientation, distance } = window.dismantle!.app.viewport.rig.current;
    return { focus: focus.toArray(), turn: orientation.toArray(), distance };
  });

/// Moves the pointer with a button held. Gives what that changed of the view.
async function swing(button: "left" | "middle" | "right", { x, y }: { x: number; y: number }) {
  const start = await camera();
  await viewer.page.mouse.move(x, y);
  await viewer.page.mouse.down({ button });
  await viewer.page.mouse.move(x + 50, y + 25, { steps: 3 });
  await viewer.page.mouse.up({ button });
  await viewer.idle();
  const end = await camera();
  return { turned: String(start.turn) !== String(end.turn), moved: String(start.focus) !== String(end.focus) };
}

test("one looks around, and nothing moves", { skip }, async () => {
  await viewer.press("Escape", "f");
  const views = new Set<string>();
  for (const key of ["1", "2", "3", "4", "5", "6"]) {
    await viewer.press(key);
    views.add(String((await camera()).turn.map((value) => value.toFixed(3))));
  }
  assert.equal(views.size, 6);
  await viewer.press("1");
  assert.equal((await swing("left", { x: 190, y: 120 })).turned, true);
  assert.equal((await swing("right", await viewer.placeOf("plate"))).turned, true);
  assert.deepEqual(await swing("middle", await viewer.placeOf("plate")), { turned: false, moved: true });
  await viewer.press("1", "f");
  const all = await camera();
  const { x, y } = await viewer.placeOf("l-bracket");
  await viewer.page.mouse.move(x, y);
  await viewer.idle();
  assert.equal(await viewer.page.locator("#status .subject").innerText(), "l-bracket");
  await viewer.page.mouse.wheel(0, -240);
  await viewer.page.waitForFunction((d) => window.dismantle!.app.viewport.rig.current.distance < d, all.distance);
  await viewer.idle();
  assert.equal(await viewer.page.evaluate((place) => window.dismantle!.at(place.x, place.y), { x, y }), "l-bracket");
  await viewer.page.mouse.dblclick(x, y);
  await viewer.idle();
  assert.ok((await camera()).distance < 0.8 * all.distance);
  await viewer.press("Escape", "f");
  const box = (await viewer.page.locator("#view").boundingBox())!;
  await viewer.page.mouse.click(box.x + box.width - 60, box.y + 60 - 26);
  await viewer.idle();
  assert.notDeepEqual((await camera()).turn, all.turn);
  await viewer.press("o");
  assert.equal(await viewer.page.getAttribute("#projection", "aria-pressed"), "true");
  await viewer.press("o");
  assert.equal((await viewer.state()).moves.length, 0);
});

test("fingers turn the view, zoom it, and take hold of a component", { skip }, async () => {
  const touch = await viewer.fingers();
  await viewer.press("1", "f");
  const start = await camera();
  await touch("touchStart", { x: 350, y: 250, id: 0 }, { x: 450, y: 250, id: 1 });
  await touch("touchMove", { x: 310, y: 250, id: 0 }, { x: 490, y: 250, id: 1 });
  await touch("touchEnd");
  await viewer.idle();
  assert.ok((await camera()).distance < 0.7 * start.distance);
  await choose("nut");
  const { x, y } = await viewer.placeOf("nut");
  const [dx, dy] = await pointerWay(40, 0);
  await touch("touchStart", { x, y, id: 0 });
  for (const part of [0.4, 0.7, 1]) await touch("touchMove", { x: x + part * dx, y: y + part * dy, id: 0 });
  await viewer.idle();
  await touch("touchEnd");
  await viewer.idle();
  assert.ok((await gone(chosen.free)) > 1);
  await viewer.press("Control+z");
});

test("the list is searched, and a group of it is selected", { skip }, async () => {
  await viewer.page.focus("#view");
  await viewer.press("/");
  await viewer.page.keyboard.type("nut");
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group):visible").count(), 8);
  await viewer.page.fill("#tree-search", "");
  await viewer.page.locator("#tree-panel .row.group .name").nth(1).click();
  await viewer.idle();
  assert.ok((await viewer.selection()).length > 1);
  await viewer.page.focus("#view");
  await viewer.press("Escape");
});

test("theme, help, a picture, and two eyes", { skip }, async () => {
  await viewer.press("1", "f");
  const plain = await viewer.picture();
  await viewer.press("t");
  assert.notEqual(await viewer.picture(), plain);
  await viewer.press("t", "h");
  assert.equal(await viewer.page.isVisible("#help-dialog"), true);
  await viewer.page.keyboard.press("Escape");
  const { name, bytes } = await viewer.saved("#screenshot");
  assert.equal(name, "as1-oc-214.png");
  assert.equal(bytes.toString("latin1", 1, 4), "PNG");
  await viewer.page.focus("#view");
  const pictures = [plain];
  for (let mode = 0; mode < 2; ++mode) {
    await viewer.press("v");
    pictures.push(await viewer.picture());
  }
  assert.equal(new Set(pictures).size, 3);
  await viewer.press("v");
  assert.equal((await viewer.picture()) === plain, true);
});

test("what was done is followed, shown, practised and played", { skip }, async () => {
  await choose("nut");
  await grab(60, 0);
  await viewer.letGo();
  await viewer.click("#follow");
  const words = viewer.page.locator("#guide-step");
  await words.filter({ hasText: "Step 1 of 1: take nut" }).waitFor();
  const glows = () =>
    viewer.page.evaluate(() =>
      window.dismantle!.app.viewport.model!.components.filter(({ look }) => look.next).map(({ raw }) => raw.name),
    );
  assert.deepEqual(await glows(), ["nut"]);
  await viewer.page.hover("#guide-show");
  const before = await viewer.picture();
  await viewer.page.click("#guide-show");
  await viewer.page.waitForFunction((picture) => window.dismantle!.app.viewport.canvas.toDataURL() !== picture, before);
  await viewer.page.check("#guide-practice");
  await viewer.idle();
  assert.match(await words.innerText(), /what comes next/);
  assert.deepEqual(await glows(), []);
  await choose("nut#2");
  await grab(30, 0);
  await viewer.letGo();
  const score = viewer.page.locator("#guide-score");
  assert.match(await score.innerText(), /1 out of turn/);
  await choose("nut");
  await grab(0, 40);
  await viewer.letGo();
  assert.match(await score.innerText(), /[1-9]\d* contacts/);
  await grab(80, 0);
  await viewer.letGo();
  assert.match(await words.innerText(), /Done/);
  await viewer.page.uncheck("#guide-practice");
  await reset();
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.source === "guide");
  await viewer.page.waitForFunction(() => !window.dismantle!.app.session.store.state!.playback!.playing);
  assert.equal((await viewer.state()).playback!.blocked, null);
  assert.ok((await gone(chosen.free)) > 1);
  await viewer.click("#play-stop");
  await viewer.click("#guide-close");
});

const search = (kind: string) =>
  viewer.page.waitForFunction((k) => window.dismantle!.app.session.store.state!.search?.kind === k, kind);

test("the whole of it is planned around what is fixed; the plan passes the audit, plays and explodes", {
  skip,
}, async () => {
  await viewer.page.focus("#view");
  await viewer.press("Escape", "l");
  await viewer.select("plate");
  await viewer.click("#plan-fix");
  assert.match(await viewer.page.locator("#plan-fixed").innerText(), /plate/);
  await viewer.page.check("#plan-all");
  await viewer.page.click("#plan-find");
  await search("plan");
  await viewer.idle();
  const { guide, search: found, moves } = await viewer.state();
  assert.equal(found!.complete, true);
  assert.equal(guide!.moves.length, found!.steps);
  assert.equal(moves.length, 0);
  const plate = await viewer.index("plate");
  assert.ok(guide!.moves.every(({ components }) => !components.includes(plate)));
  auditPath(
    await viewer.page.evaluate(async () =>
      (await window.dismantle!.app.session.connection.request("/api/guide.json")).text(),
    ),
  );
  await viewer.page.focus("#view");
  await viewer.press("l", "e");
  assert.match(await viewer.page.locator("#explode-step").innerText(), new RegExp(`of ${guide!.moves.length}`));
  await viewer.page.fill("#explode-slider", "1");
  await viewer.idle();
  const first = guide!.moves[0].components[0];
  const { components, playback } = await viewer.state();
  assert.ok(components[first].pose && playback!.blocked === null);
  await viewer.page.focus("#view");
  await viewer.press("e");
  await viewer.click("#guide-close");
});

test("one is told why a component stays; a path for it is found, and played", { skip }, async () => {
  await viewer.select("bolt");
  await viewer.page.focus("#view");
  await viewer.press("q");
  await search("why");
  await viewer.idle();
  const [reason] = (await viewer.state()).search!.reasons;
  assert.ok(reason.blockers.length > 0);
  assert.equal(await viewer.page.locator("#reason li").count(), reason.blockers.length);
  assert.equal(
    await viewer.page.evaluate(() => window.dismantle!.app.viewport.blocked.arrows.length),
    reason.blockers.length,
  );
  await viewer.page.click("#find-path");
  const bolt = await viewer.index("bolt");
  await viewer.page.waitForFunction((c) => {
    const { components, automatic } = window.dismantle!.app.session.store.state!;
    return components[c].removed && automatic === null;
  }, bolt);
  await viewer.idle();
  const { moves } = await viewer.state();
  assert.ok(moves.length > 1, "what is in its way goes first");
  await viewer.page.selectOption("#speed", "4");
  await viewer.click("#play-start");
  const time = async () => (await viewer.state()).playback!.time;
  assert.equal(await time(), 0);
  await viewer.page.focus("#view");
  await viewer.press(".");
  assert.ok(Math.abs((await time()) - moves[1].start) < 1e-6);
  await viewer.press("p");
  await viewer.page.waitForFunction((t) => window.dismantle!.app.session.playedTime! > t, moves[1].start);
  await viewer.press("p");
  assert.equal((await viewer.state()).playback!.playing, false);
  await viewer.click("#play-stop");
});

test("all exports of it are there", { skip }, async () => {
  await viewer.page.click("#export");
  const file = async (button: string) => {
    const { name, bytes } = await viewer.saved(`#export-${button}`);
    assert.match(name, /^as1-oc-214/);
    return bytes;
  };
  const { issues } = await validateBytes(new Uint8Array(await file("animation-glb")));
  assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
  assert.match((await file("page-html")).toString(), /^<!DOCTYPE html>[\s\S]*offline-model/);
  assert.match((await file("moves-csv")).toString(), /,bolt,/);
  assert.match((await file("bom-csv")).toString(), /,nut,8,/);
  assert.equal(JSON.parse((await file("bom-json")).toString()).format, "dismantle-bill");
  assert.equal((await file("png")).toString("latin1", 1, 4), "PNG");
  await viewer.page.check("#export-reverse");
  const path = (await file("path-json")).toString();
  assert.equal(JSON.parse(path).format, "dismantle-path");
  await viewer.page.uncheck("#export-reverse");
  const film = await file("video");
  assert.ok(film.readUInt32BE(0) === 0x1a45dfa3 && film.length > 5000);
  await viewer.click("#play-stop");
  await reset();
});

/// How far the pushed device makes the chosen component go along what is free, when it has gone further than `least` [mm].
async function pushed(least: number, push: (strength: number) => Promise<void>): Promise<number> {
  await push(1);
  await viewer.page.waitForFunction(
    ([name, way, far]) => {
      const matrix = window.dismantle!.drawnMatrix(name);
      return way.reduce((sum, value, k) => sum + value * matrix[12 + k], 0) > far;
    },
    [chosen.name, chosen.free, least] as const,
  );
  await push(0);
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);
  await viewer.idle();
  return gone(chosen.free);
}

test("a 3D mouse and a gamepad move it, and it stops at contact", { skip }, async () => {
  await choose("nut");
  await viewer.select("nut");
  const [right, down] = await pointerWay(1, 0);
  const way: [number, number] = [Math.sign(Math.round(right)), Math.sign(Math.round(down))];
  const first = await pushed(3, (strength) => deflect(120 * strength * way[0], 0, 120 * strength * way[1], 0, 0, 0));
  assert.ok(first > 3 && Math.abs(await gone(chosen.blocked)) < 0.5);
  assert.equal((await viewer.state()).moves.length, 1);
  assert.equal(way[1], 0, "the stick goes to the sides only");
  const second = await pushed(first + 2, (strength) => pushStick(0.5 * strength * way[0]));
  assert.ok(second > first + 2);
  await deflect(0, 0, 300, 0, 0, 0); // down, into what it is around
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.frame?.blocked);
  assert.ok((await viewer.page.evaluate(() => window.dismantle!.app.session.store.blocking.size)) > 0);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.idle();
  assert.equal(await gone(chosen.free), second);
  await reset();
});

test("in a headset a hand takes it along, and the panel at the wrist takes it out", { skip }, async () => {
  await viewer.page.click("#headset");
  await viewer.page.waitForFunction(() => window.dismantle!.app.headset.active);
  await frames(20);
  const hand = await take("right", "nut");
  assert.deepEqual(await viewer.selection(), ["nut"]);
  const per = await scale();
  // z is up in the assembly, y in the room.
  const [x, y, z] = chosen.free.map((value) => 25 * per * value);
  await carry("right", hand, { x, y: z, z: -y }, kAhead);
  await letGo("right");
  assert.ok(Math.abs((await gone(chosen.free)) - 25) < 2, `${await viewer.shift("nut")}`);
  const eye = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.eye!.toArray());
  const before = await eye();
  await viewer.page.evaluate(() => window.headset.position.set(0.2, 1.5, 0.1));
  await frames();
  assert.notDeepEqual(await eye(), before);
  await viewer.page.evaluate(() => window.headset.position.set(0, 1.6, 0));
  await pressOnWrist("takeOut");
  await isRemoved(true);
  await viewer.idle();
  await pressOnWrist("putBack");
  await isRemoved(false);
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift("nut"), [0, 0, 0]);
});

test("in a headset two hands turn what they hold, or take a component each", { skip }, async () => {
  const per = await scale();
  const [x, y, z] = chosen.free.map((value) => 25 * per * value);
  const out = { x, y: z, z: -y };
  const first = await take("right", "nut");
  await carry("right", first, out, kAhead);
  const other = await take("left", "nut", { x: -0.15, y: 0.07, z: 0.25 });
  await carry("left", other, { x: 0, y: 0.05, z: 0.05 }, kAhead);
  const rotation = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!.rotation);
  assert.ok(Math.abs(rotation[0]) < 0.9999, `${rotation}`);
  await press(viewer.page, "left", "trigger", 0);
  await letGo("right");
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("nut"), [0, 0, 0]);
  // The nut at the other end of the rod goes the other way.
  const right = await take("right", "nut");
  const left = await take("left", "nut#2");
  await carry("right", right, out, kAhead);
  const there = await viewer.drawnShift("nut");
  await carry("left", left, { x: -out.x, y: -out.y, z: -out.z }, kAhead);
  await press(viewer.page, "right", "trigger", 0);
  await press(viewer.page, "left", "trigger", 0);
  await handsEmpty();
  await viewer.idle();
  const along = (shift: number[]) => shift.reduce((sum, value, k) => sum + value * chosen.free[k], 0);
  assert.ok(along(there) > 10, `${there}`);
  assert.ok(along(await viewer.shift("nut#2")) < -10, `${await viewer.shift("nut#2")}`);
  for (let undone = 0; undone < 2; ++undone) await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("nut#2"), [0, 0, 0]);
});

test("in a headset the panel undoes, finds a path and places the scene, and the grips scale it", { skip }, async () => {
  const count = (wanted: number) =>
    viewer.page.waitForFunction((n) => window.dismantle!.app.session.store.state!.moves.length === n, wanted);
  const { moves } = await viewer.state();
  await viewer.select("nut");
  await frames();
  await pressOnWrist("findPath");
  await isRemoved(true);
  await viewer.idle();
  const found = (await viewer.state()).moves.length;
  assert.ok(found > moves.length);
  await pressOnWrist("undo");
  await count(found - 1);
  await viewer.idle();
  await pressOnWrist("redo");
  await count(found);
  await viewer.idle();
  while ((await viewer.state()).moves.length > moves.length) await viewer.press("Control+z");
  await isRemoved(false);
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
