// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

//   The stage from the front, z up: the slide lies on the stage, two clips hold it down, and it is free to the sides.
//
//        clip        clip
//     ====#============#====   specimen slide
//     ######################   stage plate

useMicroscope({ view: "1", prepare: () => viewer.zoomTo(kSlide, 0.45) });
afterEach(async () => {
  if ((await viewer.state()).moves.length > 0) await reset();
});

const blocking = () => viewer.page.locator("#tree-panel .badge.blocks").count();
const drag = () =>
  viewer.page.evaluate(() => {
    const { app } = window.dismantle!;
    const { viewport, session } = app;
    return {
      ghost: viewport.ghost.object.visible,
      band: viewport.ghost.band.visible,
      contacts: viewport.contacts.object.count,
      blocking: [...session.store.blocking].map((c) => session.nameOf(c)),
    };
  });

/// Where the hand wants the grabbed point.
const wanted = () => viewer.page.evaluate(() => window.dismantle!.app.drag.anchor.toArray());

test("a component pressed into a wall stops there: contacts are drawn and the wall is named", async () => {
  await viewer.grab(kSlide, 0, 60);
  const seen = await drag();
  assert.deepEqual([seen.ghost, seen.band], [true, true]);
  assert.ok(seen.contacts > 0);
  assert.ok(seen.blocking.includes("stage plate"), String(seen.blocking));
  assert.ok((await blocking()) > 0);
  assert.match(await viewer.page.locator("#touches").innerText(), /stage plate/);
  const status = (part: string, words: RegExp) =>
    viewer.page.locator(`#status-${part}`, { hasText: words }).waitFor({ state: "attached" });
  await status("clearance", /contact/);
  await status("step", /\d (µs|ms)/);
  await status("device", /CPU|CUDA/);
  await status("tolerance", /\d (µm|mm)/);
  const frame = await viewer.page.evaluate(() => window.dismantle!.app.session.store.frame!);
  assert.ok(Math.abs(frame.position[2]) < 0.1, `${frame.position}`);
  await viewer.letGo();
  assert.equal((await drag()).ghost, false);
  assert.equal(await blocking(), 0);
});

test("pressed down and pulled aside it slides along", async () => {
  await viewer.grab(kSlide, 90, 25);
  await viewer.letGo();
  const [x, , z] = await viewer.shift(kSlide);
  assert.ok(x > 10, `${x}`);
  assert.ok(Math.abs(z) < 0.1, `${z}`);
});

test("with the response Stop it does not slide", async () => {
  await viewer.page.check("#response-stop");
  await viewer.idle();
  assert.equal((await viewer.state()).response, "stop");
  await viewer.grab(kSlide, 90, 25);
  await viewer.letGo();
  const [x] = await viewer.shift(kSlide);
  assert.ok(x < 5, `${x}`);
  await viewer.page.check("#response-slide");
  await viewer.idle();
});

test("the mesh is drawn where the engine is, never where the hand is", async () => {
  const { x, y } = await viewer.placeOf(kSlide);
  await viewer.page.mouse.move(x, y);
  await viewer.page.mouse.down();
  for (let i = 1; i <= 30; ++i) {
    await viewer.page.mouse.move(x + 3 * i, y + 2 * i);
    const differs = await viewer.page.evaluate((name) => {
      const { app } = window.dismantle!;
      const { frame, state } = app.session.store;
      if (!frame || !state!.hand) return 0;
      const drawn = window.dismantle!.drawnMatrix(name);
      return Math.max(...[0, 1, 2].map((k) => Math.abs(drawn[12 + k] - frame.position[k])));
    }, kSlide);
    assert.equal(differs, 0);
  }
  await viewer.letGo();
  assert.deepEqual(await viewer.drawnShift(kSlide), await viewer.shift(kSlide));
});

test("Ctrl+Z in mid-drag goes back to its start, and leaves no entry", async () => {
  await viewer.grab(kSlide, 80, 0);
  const pulled = await viewer.drawnShift(kSlide);
  assert.ok(pulled[0] > 10, `${pulled}`);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(kSlide), [0, 0, 0]);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.equal((await viewer.state()).hand, null);
  await viewer.letGo();
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.equal((await viewer.state()).undo, null);
});

test("Esc in mid-drag goes back, too", async () => {
  await viewer.grab(kSlide, 80, 0);
  await viewer.press("Escape");
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.letGo();
});

test("a drag is one entry of undo; redo brings it back", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.letGo();
  await viewer.grab(kSlide, 30, 0);
  await viewer.letGo();
  const there = await viewer.shift(kSlide);
  assert.equal((await viewer.state()).moves.length, 2);
  await viewer.press("Control+z");
  assert.equal((await viewer.state()).moves.length, 1);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.press("Control+y", "Control+y");
  assert.deepEqual(await viewer.shift(kSlide), there);
});

test("Z keeps a drag to the axis, Alt turns, Shift goes deeper", async () => {
  await viewer.press("x");
  await viewer.grab(kSlide, 40, -40);
  await viewer.press("x");
  await viewer.letGo();
  const [x, y, z] = await viewer.shift(kSlide);
  assert.ok(x > 5 && Math.abs(y) < 0.2 && Math.abs(z) < 0.2, `${[x, y, z]}`);
  await reset();

  await viewer.page.keyboard.down("Shift");
  const { x: right, y: down } = await viewer.placeOf(kSlide);
  await viewer.page.mouse.move(right, down);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(right, down - 5);
  const near = await wanted();
  await viewer.page.mouse.move(right, down - 30);
  const deep = await wanted();
  assert.ok(deep[1] - near[1] > 5, `${near} ${deep}`);
  assert.ok(Math.abs(deep[0] - near[0]) < 0.1 * (deep[1] - near[1]), `${near} ${deep}`);
  await viewer.idle();
  await viewer.page.keyboard.up("Shift");
  assert.match(await viewer.page.locator("#status .hint").innerText(), /depth/);
  await viewer.press("Escape");
  await viewer.letGo();
});

test("Alt turns what is held", async () => {
  await viewer.page.keyboard.down("Alt");
  await viewer.grab(kSlide, 0, -40);
  assert.match(await viewer.page.locator("#status .hint").innerText(), /turning/);
  assert.ok((await wanted()).every(Number.isFinite));
  await viewer.page.keyboard.up("Alt");
  await viewer.letGo();
  const pose = (await viewer.state()).components[await viewer.index(kSlide)].pose!;
  assert.ok(Math.abs(pose[3]) < 1 - 1e-6, `${pose}`);
});

test("blocked for a second, the hand is told what is free; the least clearance of the drag is kept", async () => {
  await viewer.grab(kSlide, 0, 60);
  await viewer.page.locator("[data-banner=stuck]", { hasText: /Blocked by stage plate; free: .*X/ }).waitFor();
  assert.ok((await viewer.page.evaluate(() => window.dismantle!.app.viewport.directions.arrows.length)) > 0);
  const words = await viewer.page.locator("#clearance").innerText();
  assert.match(words, /Now\s+contact\s+Least in this drag\s+contact/);
  await viewer.letGo();
  assert.equal(await viewer.page.locator("[data-banner=stuck]").count(), 0);
});

test("a screw that overlaps its hole comes out of its fit along its axis, and not through the wall", async () => {
  const { screw, way } = await viewer.page.evaluate(async () => {
    const { session } = window.dismantle!.app;
    const { pairs } = (await session.ask("check", {}))!;
    const fits = pairs.filter(({ state }) => state === "fit").flatMap(({ a, b }) => [a, b]);
    for (const component of fits.filter((c) => session.nameOf(c).includes("screw"))) {
      const { directions } = (await session.ask("free_directions", { components: [component] }))!;
      const free = directions.find((way) => way.free);
      if (free) return { screw: session.nameOf(component), way: free.direction };
    }
    throw new Error("no screw is free");
  });
  await viewer.select(screw);
  await viewer.page.locator("#pairs .badge.fit").first().waitFor();
  const across = way.map((value) => (Math.abs(value) < 0.5 ? 15 : 0));
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(across[k]));
  await viewer.click("#numeric-apply");
  assert.ok(Math.hypot(...(await viewer.shift(screw))) < 1, `${await viewer.shift(screw)}`);
  if ((await viewer.state()).undo) await viewer.press("Control+z");
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(25 * way[k]));
  await viewer.click("#numeric-apply");
  const shift = await viewer.shift(screw);
  assert.ok(Math.abs(shift.reduce((sum, value, k) => sum + value * way[k], 0) - 25) < 0.1, `${shift}`);
});

test("a move by numbers goes as far as the engine lets it", async () => {
  await viewer.select(kSlide);
  await viewer.page.fill("#numeric-0", "12.5");
  await viewer.page.fill("#numeric-2", "0");
  await viewer.click("#numeric-apply");
  const [x, y, z] = await viewer.shift(kSlide);
  assert.ok(Math.abs(x - 12.5) < 0.05 && Math.abs(y) < 0.1 && Math.abs(z) < 0.1, `${[x, y, z]}`);
  await viewer.page.fill("#numeric-0", "0");
  await viewer.page.fill("#numeric-5", "3");
  await viewer.click("#numeric-apply");
  const [, , , , , , turn] = (await viewer.state()).components[await viewer.index(kSlide)].pose!;
  assert.ok(Math.abs(turn - Math.sin((1.5 * Math.PI) / 180)) < 1e-3, `${turn}`);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
