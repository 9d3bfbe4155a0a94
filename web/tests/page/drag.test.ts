// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

//   The stage from the front, z up: the slide lies on the stage under two clips, and is free to the sides.
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

/// Number of pixels whose colour is close to one of the theme's colours.
const pixelsLike = (name: "blocking" | "contact") =>
  viewer.page.evaluate((color) => {
    const { palette } = window.dismantle!.app.viewport;
    const rgb = [1, 3, 5].map((at) => Number.parseInt(palette[color].slice(at, at + 2), 16));
    const { data } = window.dismantle!.imageData();
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if (rgb.every((value, k) => Math.abs(data[i + k] - value) < 24)) ++count;
    return count;
  }, name);

/// Target of the grabbed point.
const target = () => viewer.page.evaluate(() => window.dismantle!.app.drag.anchor.toArray());

test("a component pressed against a wall stops; contacts are drawn and the wall is named", async () => {
  const plain = [await pixelsLike("blocking"), await pixelsLike("contact")];
  await viewer.grab(kSlide, 0, 60);
  const seen = await drag();
  assert.deepEqual([seen.ghost, seen.band], [true, true]);
  assert.ok((await pixelsLike("blocking")) > plain[0] + 100, "the edges of blocking components are orange");
  assert.ok((await pixelsLike("contact")) > plain[1] + 20, "the contacts are drawn");
  assert.ok(seen.contacts > 0);
  assert.ok(seen.blocking.includes("stage plate"), String(seen.blocking));
  assert.ok((await blocking()) > 0);
  assert.match(await viewer.page.locator("#touches").innerText(), /stage plate/);
  const status = (part: string, pattern: RegExp) =>
    viewer.page.locator(`#status-${part}`, { hasText: pattern }).waitFor({ state: "attached" });
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
  await viewer.release();
  assert.equal((await drag()).ghost, false);
  assert.equal(await blocking(), 0);
});

test("a component pressed down and pulled aside slides", async () => {
  await viewer.grab(kSlide, 90, 25);
  await viewer.release();
  const [x, , z] = await viewer.shift(kSlide);
  assert.ok(x > 10, `${x}`);
  assert.ok(Math.abs(z) < 0.1, `${z}`);
});

test("with the responses Stop and Touch nothing slides", async () => {
  for (const response of ["stop", "touch"]) {
    await viewer.page.check(`#response-${response}`);
    await viewer.idle();
    assert.equal((await viewer.state()).response, response);
    await viewer.grab(kSlide, 90, 25, 3);
    await viewer.release();
    const [x, , z] = await viewer.shift(kSlide);
    assert.ok(x < 5 && Math.abs(z) < 0.1, `${response} ${x} ${z}`);
    if ((await viewer.state()).undo) await viewer.press("Control+z");
  }
  await viewer.page.check("#response-slide");
  await viewer.idle();
});

test("the mesh is drawn at the engine's pose, never at the target", async () => {
  const { x, y } = await viewer.visiblePoint(kSlide);
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
  await viewer.release();
  assert.deepEqual(await viewer.drawnShift(kSlide), await viewer.shift(kSlide));
});

test("a render sends at most one target, the newest; the grabbed point stays under the pointer", async () => {
  const { x, y } = await viewer.visiblePoint(kSlide);
  await viewer.grab(kSlide, 10, 0, 2);
  const counted = await viewer.page.evaluate(
    async ([left, top]) => {
      const { viewport, session, drag: hand } = window.dismantle!.app;
      const { connection } = session;
      let [sent, pictures] = [0, 0];
      const send = connection.sendStruct.bind(connection);
      connection.sendStruct = (bytes) => {
        ++sent;
        return send(bytes);
      };
      const count = () => ++pictures;
      viewport.afterRender.add(count);
      for (let i = 1; i <= 40; ++i) {
        const options = { clientX: left + 10 + i, clientY: top, pointerId: 1, bubbles: true };
        viewport.canvas.dispatchEvent(new PointerEvent("pointermove", options));
      }
      await window.dismantle!.idle();
      viewport.afterRender.delete(count);
      connection.sendStruct = send;
      return { sent, pictures, point: window.dismantle!.project(hand.anchor.toArray()) };
    },
    [x, y],
  );
  assert.ok(counted.sent >= 1 && counted.sent <= counted.pictures && counted.sent < 10, JSON.stringify(counted));
  assert.ok(Math.hypot(counted.point.x - x - 50, counted.point.y - y) < 1, `${JSON.stringify(counted)} ${x} ${y}`);
  await viewer.press("Escape");
  await viewer.release();
});

test("the last target is sent although the connection was congested when it was made", async () => {
  const start = await viewer.drawnShift(kSlide);
  await viewer.page.evaluate(() => {
    const { connection } = window.dismantle!.app.session;
    const send = connection.sendStruct.bind(connection);
    let refused = 0;
    connection.sendStruct = () => {
      if (++refused === 5) connection.sendStruct = send;
      return false;
    };
  });
  await viewer.grab(kSlide, 80, 0, 1);
  const pulled = await viewer.drawnShift(kSlide);
  assert.ok(pulled[0] - start[0] > 10, `${start} ${pulled}`);
  await viewer.press("Escape");
  await viewer.release();
});

test("the view is not redrawn while a component is held still", async () => {
  await viewer.grab(kSlide, 60, 0);
  const renders = await viewer.page.evaluate(async () => {
    const { viewport } = window.dismantle!.app;
    let counted = 0;
    const count = () => ++counted;
    viewport.afterRender.add(count);
    await new Promise((resolve) => setTimeout(resolve, 2500)); // two requests of metrics
    viewport.afterRender.delete(count);
    return counted;
  });
  assert.equal(renders, 0);
  await viewer.press("Escape");
  await viewer.release();
});

test("Ctrl+Z during a drag returns to its start and leaves no undo entry", async () => {
  await viewer.grab(kSlide, 80, 0);
  const pulled = await viewer.drawnShift(kSlide);
  assert.ok(pulled[0] > 10, `${pulled}`);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(kSlide), [0, 0, 0]);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.equal((await viewer.state()).hand, null);
  await viewer.release();
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.equal((await viewer.state()).undo, null);
});

test("Esc during a drag returns to its start", async () => {
  await viewer.grab(kSlide, 80, 0);
  await viewer.press("Escape");
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.release();
});

test("a drag is one undo entry, and can be redone", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.release();
  await viewer.grab(kSlide, 30, 0);
  await viewer.release();
  const there = await viewer.shift(kSlide);
  assert.equal((await viewer.state()).moves.length, 2);
  await viewer.press("Control+z");
  assert.equal((await viewer.state()).moves.length, 1);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.press("Control+y", "Control+y");
  assert.deepEqual(await viewer.shift(kSlide), there);
});

test("the selection moves as one rigid set; one undo entry", async () => {
  const feet = ["foot", "foot#2"];
  await viewer.press("Escape", "f");
  await viewer.select(...feet);
  await viewer.grab("foot", 0, 25);
  await viewer.release();
  const [one, other] = [await viewer.shift(feet[0]), await viewer.shift(feet[1])];
  assert.ok(one[2] < -3, `${one}`);
  assert.deepEqual(other, one);
  assert.deepEqual(await viewer.drawnShift(feet[1]), one);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift(feet[1]), [0, 0, 0]);
  assert.equal((await viewer.state()).moves.length, 0);
});

/// A key, a view in which its axis is perpendicular to the line of sight, a component that is free along it, and a
/// pointer offset.
const kLocks = [
  { key: "x", view: "1", name: kSlide, offset: [40, -40] },
  { key: "y", view: "3", name: kSlide, offset: [30, 40] },
  { key: "z", view: "1", name: "foot", offset: [30, 40] },
] as const;

for (const [axis, { key, view, name, offset }] of kLocks.entries())
  test(`${key.toUpperCase()} locks a drag to its axis`, async () => {
    await viewer.press("Escape", view, "f", key);
    await viewer.grab(name, offset[0], offset[1]);
    assert.match(await viewer.page.locator("#status .hint").innerText(), new RegExp(key.toUpperCase()));
    await viewer.press(key);
    await viewer.release();
    const shift = await viewer.shift(name);
    const across = shift.filter((_, k) => k !== axis);
    assert.ok(Math.abs(shift[axis]) > 2 && across.every((value) => Math.abs(value) < 0.2), `${shift}`);
    assert.deepEqual(await viewer.drawnShift(name), shift);
  });

test("Shift moves in depth", async () => {
  await viewer.press("Escape", "2", "f");
  await viewer.page.keyboard.down("Shift");
  await viewer.grab(kSlide, 5, -30);
  await viewer.page.keyboard.up("Shift");
  assert.match(await viewer.page.locator("#status .hint").innerText(), /away from you/);
  await viewer.release();
  const [x, y, z] = await viewer.shift(kSlide);
  // Seen from the right, away from the eye is -x.
  assert.ok(x < -3 && Math.abs(y) < 0.2 && Math.abs(z) < 0.2, `${[x, y, z]}`);
  assert.deepEqual(await viewer.drawnShift(kSlide), [x, y, z]);
});

test("Alt rotates the moving set, about the locked axis if there is one", async () => {
  await viewer.press("Escape", "3", "f");
  await viewer.page.keyboard.down("Alt");
  await viewer.grab(kSlide, 0, -40);
  assert.match(await viewer.page.locator("#status .hint").innerText(), /rotating/);
  assert.ok((await target()).every(Number.isFinite));
  await viewer.release();
  const pose = async () => (await viewer.state()).components[await viewer.index(kSlide)].pose ?? [0, 0, 0, 1, 0, 0, 0];
  assert.ok(Math.abs((await pose())[3]) < 1 - 1e-6, `${await pose()}`);
  await viewer.page.keyboard.up("Alt");
  await reset();
  await viewer.press("z");
  await viewer.page.keyboard.down("Alt");
  await viewer.grab(kSlide, 3, -6, 3);
  await viewer.page.keyboard.up("Alt");
  await viewer.press("z");
  await viewer.release();
  const [, , , w, qx, qy, qz] = await pose();
  assert.ok(w < 1 - 1e-7 && Math.hypot(qx, qy) < 0.1 * Math.abs(qz), `${await pose()}`);
});

test("a drag blocked for a second shows the free directions, and the minimum clearance of the drag", async () => {
  await viewer.press("1");
  await viewer.grab(kSlide, 0, 60);
  await viewer.page.locator("[data-banner=stuck]", { hasText: /Blocked by stage plate; free: .*X/ }).waitFor();
  assert.ok((await viewer.page.evaluate(() => window.dismantle!.app.viewport.directions.arrows.length)) > 0);
  const clearance = await viewer.page.locator("#clearance").innerText();
  assert.match(clearance, /Now\s+contact\s+Minimum in this drag\s+contact/);
  await viewer.release();
  assert.equal(await viewer.page.locator("[data-banner=stuck]").count(), 0);
});

test("a screw that overlaps its hole leaves its fit along its axis, and not through the wall", async () => {
  const { screw, axis } = await viewer.page.evaluate(async () => {
    const { session } = window.dismantle!.app;
    const { pairs } = (await session.send("check", {}))!;
    const fits = pairs
      .filter(({ state, depth }) => state === "overlapping" && depth < 0.2)
      .flatMap(({ a, b }) => [a, b]);
    for (const component of fits.filter((c) => session.nameOf(c).includes("screw"))) {
      const { directions } = (await session.send("free_directions", { components: [component] }))!;
      const free = directions.find(({ free }) => free);
      if (free) return { screw: session.nameOf(component), axis: free.direction };
    }
    throw new Error("no screw is free");
  });
  await viewer.select(screw);
  await viewer.page.locator("#pairs .badge.overlapping").first().waitFor();
  const center = () =>
    viewer.page.evaluate((name) => {
      const view = window.dismantle!.app.viewport.model!.components.find(({ raw }) => raw.name === name)!;
      const { min, max } = view.bounds();
      return [(min.x + max.x) / 2, (min.y + max.y) / 2, (min.z + max.z) / 2];
    }, screw);
  const start = await center();
  const across = axis.map((value) => (Math.abs(value) < 0.5 ? 15 : 0));
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(across[k]));
  await viewer.click("#numeric-apply");
  // It may turn in its hole, so that its origin moves further than itself.
  const offset = (await center()).map((value, k) => value - start[k]);
  assert.ok(Math.hypot(...offset) < 1, `${offset}, ${await viewer.shift(screw)}`);
  if ((await viewer.state()).undo) await viewer.press("Control+z");
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(25 * axis[k]));
  await viewer.click("#numeric-apply");
  const shift = await viewer.shift(screw);
  assert.ok(Math.abs(shift.reduce((sum, value, k) => sum + value * axis[k], 0) - 25) < 0.1, `${shift}`);
});

test("a move by numbers goes as far as the engine allows", async () => {
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
