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

/// How many pixels of the picture have nearly a colour of the theme.
const pixelsLike = (name: "blocking" | "contact") =>
  viewer.page.evaluate((color) => {
    const { canvas, palette } = window.dismantle!.app.viewport;
    const wanted = [1, 3, 5].map((at) => Number.parseInt(palette[color].slice(at, at + 2), 16));
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const brush = copy.getContext("2d")!;
    brush.drawImage(canvas, 0, 0);
    const { data } = brush.getImageData(0, 0, copy.width, copy.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
      if (wanted.every((value, k) => Math.abs(data[i + k] - value) < 24)) ++count;
    return count;
  }, name);

/// Where the hand wants the grabbed point.
const wanted = () => viewer.page.evaluate(() => window.dismantle!.app.drag.anchor.toArray());

test("a component pressed into a wall stops there: contacts are drawn and the wall is named", async () => {
  const plain = [await pixelsLike("blocking"), await pixelsLike("contact")];
  await viewer.grab(kSlide, 0, 60);
  const seen = await drag();
  assert.deepEqual([seen.ghost, seen.band], [true, true]);
  assert.ok((await pixelsLike("blocking")) > plain[0] + 100, "the edges of what blocks are orange");
  assert.ok((await pixelsLike("contact")) > plain[1] + 20, "the contacts are drawn");
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
  const arrows = await viewer.page.evaluate(() =>
    window.dismantle!.app.viewport.contacts.arrows.map(({ point, direction }) => [
      point.toArray(),
      direction.toArray(),
    ]),
  );
  for (const [point, normal] of arrows)
    assert.ok(
      frame.contacts.some((c) => String([c.point, c.normal]) === String([point, normal])),
      "an arrow is a contact's point and normal",
    );
  assert.ok(
    frame.contacts.some(({ normal }) => normal[2] > 0.99),
    "the stage pushes up",
  );
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

test("with the responses Stop and Touch it does not slide", async () => {
  for (const response of ["stop", "touch"]) {
    await viewer.page.check(`#response-${response}`);
    await viewer.idle();
    assert.equal((await viewer.state()).response, response);
    await viewer.grab(kSlide, 90, 25, 3);
    await viewer.letGo();
    const [x, , z] = await viewer.shift(kSlide);
    assert.ok(x < 5 && Math.abs(z) < 0.1, `${response} ${x} ${z}`);
    if ((await viewer.state()).undo) await viewer.press("Control+z");
  }
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

test("a picture sends one target at most, the newest; and the grabbed point stays under the pointer", async () => {
  const { x, y } = await viewer.placeOf(kSlide);
  await viewer.grab(kSlide, 10, 0, 2);
  const counted = await viewer.page.evaluate(
    async ([left, top]) => {
      const { viewport, session, drag: hand } = window.dismantle!.app;
      const { connection } = session;
      let [sent, pictures] = [0, 0];
      const send = connection.sendStruct.bind(connection);
      connection.sendStruct = (bytes) => {
        ++sent;
        send(bytes);
      };
      const count = () => ++pictures;
      viewport.afterPicture.add(count);
      for (let i = 1; i <= 40; ++i) {
        const options = { clientX: left + 10 + i, clientY: top, pointerId: 1, bubbles: true };
        viewport.canvas.dispatchEvent(new PointerEvent("pointermove", options));
      }
      await window.dismantle!.idle();
      viewport.afterPicture.delete(count);
      connection.sendStruct = send;
      return { sent, pictures, point: window.dismantle!.project(hand.anchor.toArray()) };
    },
    [x, y],
  );
  assert.ok(counted.sent >= 1 && counted.sent <= counted.pictures && counted.sent < 10, JSON.stringify(counted));
  assert.ok(Math.hypot(counted.point.x - x - 50, counted.point.y - y) < 1, `${JSON.stringify(counted)} ${x} ${y}`);
  await viewer.press("Escape");
  await viewer.letGo();
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

test("what is selected moves as one rigid set, and is one entry of undo", async () => {
  const feet = ["foot", "foot#2"];
  await viewer.press("Escape", "f");
  await viewer.select(...feet);
  await viewer.grab("foot", 0, 25);
  await viewer.letGo();
  const [one, other] = [await viewer.shift(feet[0]), await viewer.shift(feet[1])];
  assert.ok(one[2] < -3, `${one}`);
  assert.deepEqual(other, one);
  assert.deepEqual(await viewer.drawnShift(feet[1]), one);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(feet[1]), [0, 0, 0]);
  assert.equal((await viewer.state()).moves.length, 0);
});

/// The key of a view in which an axis lies across the line of sight, what is free along it, and a way of the pointer.
const kLocks = [
  { key: "x", view: "1", name: kSlide, way: [40, -40] },
  { key: "y", view: "3", name: kSlide, way: [30, 40] },
  { key: "z", view: "1", name: "foot", way: [30, 40] },
] as const;

for (const [axis, { key, view, name, way }] of kLocks.entries())
  test(`${key.toUpperCase()} keeps a drag to its axis`, async () => {
    await viewer.press("Escape", view, "f", key);
    await viewer.grab(name, way[0], way[1]);
    assert.match(await viewer.page.locator("#status .hint").innerText(), new RegExp(key.toUpperCase()));
    await viewer.press(key);
    await viewer.letGo();
    const shift = await viewer.shift(name);
    const across = shift.filter((_, k) => k !== axis);
    assert.ok(Math.abs(shift[axis]) > 2 && across.every((value) => Math.abs(value) < 0.2), `${shift}`);
    assert.deepEqual(await viewer.drawnShift(name), shift);
  });

test("Shift takes it deeper", async () => {
  await viewer.press("Escape", "2", "f");
  await viewer.page.keyboard.down("Shift");
  await viewer.grab(kSlide, 5, -30);
  await viewer.page.keyboard.up("Shift");
  assert.match(await viewer.page.locator("#status .hint").innerText(), /depth/);
  await viewer.letGo();
  const [x, y, z] = await viewer.shift(kSlide);
  // Seen from the right, away from the eye is to the left.
  assert.ok(x < -3 && Math.abs(y) < 0.2 && Math.abs(z) < 0.2, `${[x, y, z]}`);
  assert.deepEqual(await viewer.drawnShift(kSlide), [x, y, z]);
});

test("Alt turns what is held; with an axis, about it", async () => {
  await viewer.press("Escape", "3", "f");
  await viewer.page.keyboard.down("Alt");
  await viewer.grab(kSlide, 0, -40);
  assert.match(await viewer.page.locator("#status .hint").innerText(), /turning/);
  assert.ok((await wanted()).every(Number.isFinite));
  await viewer.letGo();
  const pose = async () => (await viewer.state()).components[await viewer.index(kSlide)].pose ?? [0, 0, 0, 1, 0, 0, 0];
  assert.ok(Math.abs((await pose())[3]) < 1 - 1e-6, `${await pose()}`);
  await viewer.page.keyboard.up("Alt");
  await reset();
  await viewer.press("z");
  await viewer.page.keyboard.down("Alt");
  await viewer.grab(kSlide, 3, -6, 3);
  await viewer.page.keyboard.up("Alt");
  await viewer.press("z");
  await viewer.letGo();
  const [, , , w, qx, qy, qz] = await pose();
  assert.ok(w < 1 - 1e-7 && Math.hypot(qx, qy) < 0.1 * Math.abs(qz), `${await pose()}`);
});

test("blocked for a second, the hand is told what is free; the least clearance of the drag is kept", async () => {
  await viewer.press("1");
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
