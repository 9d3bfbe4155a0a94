// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { useMicroscope, viewer } from "../support/scene.ts";

useMicroscope();
beforeEach(async () => {
  await viewer.page.mouse.move(5, 300);
  await viewer.press("Escape", "1", "f");
});

const camera = () =>
  viewer.page.evaluate(() => {
    const { focus, orientation, distance } = window.dismantle!.app.viewport.rig.current;
    return { focus: focus.toArray(), back: orientation.toArray(), distance };
  });
const kEmpty = { x: 190, y: 120 };

async function dragView(button: "left" | "middle" | "right", from: { x: number; y: number }): Promise<void> {
  await viewer.page.mouse.move(from.x, from.y);
  await viewer.page.mouse.down({ button });
  await viewer.page.mouse.move(from.x + 60, from.y + 30, { steps: 4 });
  await viewer.page.mouse.up({ button });
  await viewer.idle();
}

test("the page shows the model: many colours, all components listed, in its status line", async () => {
  const colors = await viewer.page.evaluate(() => {
    const { canvas } = window.dismantle!.app.viewport;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const brush = copy.getContext("2d")!;
    brush.drawImage(canvas, 0, 0);
    return new Set(new Uint32Array(brush.getImageData(0, 0, copy.width, copy.height).data.buffer)).size;
  });
  assert.ok(colors > 200, `${colors} colours`);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 41);
  assert.match(await viewer.page.locator("#status").innerText(), /21,806 triangles/);
});

test("something is on screen at once, and the sample within a second", async (t) => {
  await viewer.page.reload();
  await viewer.model();
  const { paint, model } = await viewer.page.evaluate(() => ({
    paint: performance.getEntriesByName("first-contentful-paint")[0].startTime,
    model: window.dismantle!.modelDrawn!,
  }));
  t.diagnostic(`first paint after ${paint.toFixed(0)} ms, the sample after ${model.toFixed(0)} ms`);
  // Generous: here it is drawn in software, beside other tests.
  assert.ok(paint < 5000 && model < 10_000, `${paint} ${model}`);
});

test("all components are drawn with a few calls, and one that is seen through by itself", async () => {
  const calls = async () => {
    await viewer.idle();
    return viewer.page.evaluate(() => window.dismantle!.app.viewport.cost.calls);
  };
  const before = await calls();
  assert.ok(before < 12, `${before}`);
  const arm = await viewer.index("arm");
  const toggle = () => viewer.page.evaluate((c) => window.dismantle!.app.session.toggleXray([c]), arm);
  const solid = await viewer.picture();
  await toggle();
  assert.equal(await calls(), before + 2);
  assert.notEqual(await viewer.picture(), solid);
  await toggle();
  assert.equal(await calls(), before);
  assert.equal(await viewer.picture(), solid);
});

test("left on empty space orbits", async () => {
  const start = await camera();
  await dragView("left", kEmpty);
  const end = await camera();
  assert.notDeepEqual(end.back, start.back);
  assert.equal(end.distance, start.distance);
});

test("right orbits on a component, too, and moves nothing", async () => {
  const start = await camera();
  await dragView("right", await viewer.placeOf("base"));
  assert.notDeepEqual((await camera()).back, start.back);
  assert.equal((await viewer.state()).moves.length, 0);
});

test("the middle button pans: what was under the pointer stays under it", async () => {
  const place = await viewer.placeOf("base");
  await dragView("middle", place);
  assert.equal(await viewer.page.evaluate(({ x, y }) => window.dismantle!.at(x + 60, y + 30), place), "base");
});

test("what the pointer is on is named in the status line and stands out in the list", async () => {
  const { x, y } = await viewer.placeOf("head");
  await viewer.page.mouse.move(x, y);
  await viewer.idle();
  assert.equal(await viewer.page.locator("#status .subject").innerText(), "head");
  assert.equal(await viewer.page.locator("#tree-panel .row.hovered .name").innerText(), "head");
});

test("two fingers pan and zoom, one on empty space orbits", async () => {
  const touch = await viewer.fingers();
  const start = await camera();
  const place = (x: number, id: number) => ({ x, y: 250, id });
  await touch("touchStart", place(350, 0), place(450, 1));
  await touch("touchMove", place(300, 0), place(500, 1));
  await touch("touchEnd");
  await viewer.idle();
  const near = await camera();
  assert.ok(near.distance < 0.7 * start.distance, `${near.distance} ${start.distance}`);
  assert.deepEqual(near.back, start.back);
  await viewer.press("f");
  await touch("touchStart", { ...kEmpty, id: 0 });
  await touch("touchMove", { x: kEmpty.x + 40, y: kEmpty.y, id: 0 });
  await touch("touchEnd");
  await viewer.idle();
  assert.notDeepEqual((await camera()).back, start.back);
  assert.equal((await viewer.state()).moves.length, 0);
});

test("a finger on a component moves it, with contact", async () => {
  const touch = await viewer.fingers();
  const { x, y } = await viewer.placeOf("foot");
  await touch("touchStart", { x, y, id: 0 });
  for (const down of [8, 16, 24]) await touch("touchMove", { x: x + 3, y: y + down, id: 0 });
  await viewer.idle();
  await touch("touchEnd");
  await viewer.idle();
  const shift = await viewer.shift("foot");
  assert.ok(shift[2] < -3, `${shift}`);
  assert.deepEqual(await viewer.drawnShift("foot"), shift);
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("foot"), [0, 0, 0]);
});

test("the wheel zooms to the cursor", async () => {
  const start = await camera();
  const place = await viewer.placeOf("eyepiece");
  await viewer.page.mouse.move(place.x, place.y);
  for (let i = 0; i < 6; ++i) await viewer.page.mouse.wheel(0, -240);
  await viewer.page.waitForFunction(
    (distance) => window.dismantle!.app.viewport.rig.current.distance < distance,
    0.3 * start.distance,
  );
  await viewer.idle();
  assert.equal(await viewer.page.evaluate(({ x, y }) => window.dismantle!.at(x, y), place), "eyepiece");
});

test("a double click looks at a component closely; F shows all again", async () => {
  const all = await camera();
  const { x, y } = await viewer.placeOf("specimen slide");
  await viewer.page.mouse.dblclick(x, y);
  await viewer.idle();
  assert.ok((await camera()).distance < 0.5 * all.distance);
  await viewer.press("Escape", "f");
  assert.ok(Math.abs((await camera()).distance - all.distance) < 1e-6 * all.distance);
});

test("the keys 1 to 6 and the view cube look from the six sides", async () => {
  const seen = new Set<string>();
  for (const key of ["1", "2", "3", "4", "5", "6"]) {
    await viewer.press(key);
    seen.add(JSON.stringify((await camera()).back.map((value) => Number(value.toFixed(3)))));
  }
  assert.equal(seen.size, 6);
  await viewer.press("1");
  const front = await camera();
  const box = (await viewer.page.locator("#view").boundingBox())!;
  await viewer.press("3");
  assert.notDeepEqual((await camera()).back, front.back);
  // In the view from above, the lower rim of the cube means the view between above and the front.
  await viewer.page.mouse.click(box.x + box.width - 60, box.y + 60 + 26);
  await viewer.idle();
  const between = await camera();
  assert.notDeepEqual(between.back, front.back);
});

test("O changes to parallel projection and back", async () => {
  const parallel = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.orthographic);
  await viewer.press("o");
  assert.equal(await parallel(), true);
  assert.equal(await viewer.page.getAttribute("#projection", "aria-pressed"), "true");
  await viewer.press("o");
  assert.equal(await parallel(), false);
});

test("the theme changes the page and the picture", async () => {
  const [light, first] = [
    await viewer.picture(),
    await viewer.page.evaluate(() => document.documentElement.dataset.theme),
  ];
  await viewer.press("t");
  assert.notEqual(await viewer.page.evaluate(() => document.documentElement.dataset.theme), first);
  assert.ok((await viewer.picture()) !== light);
  await viewer.press("t");
});

/// How far the picture's reds and its blues, or its halves, differ: summed over a coarse grid.
const pictureFacts = () =>
  viewer.page.evaluate(() => {
    const { canvas } = window.dismantle!.app.viewport;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const brush = copy.getContext("2d")!;
    brush.drawImage(canvas, 0, 0);
    const { data, width, height } = brush.getImageData(0, 0, copy.width, copy.height);
    const half = Math.floor(width / 2);
    let [red, sides, filled] = [0, 0, 0];
    for (let y = 0; y < height; y += 3)
      for (let x = 0; x < half; x += 3) {
        const [a, b] = [4 * (y * width + x), 4 * (y * width + x + half)];
        red += Math.abs(data[a] - data[a + 2]);
        sides += Math.abs(data[a + 3] - data[b + 3]) > 128 ? 1 : 0;
        filled += data[a + 3] > 128 ? 1 : 0;
      }
    return { red, sides, filled };
  });

test("V draws for two eyes: side by side, then red and cyan, then for one again", async () => {
  const one = await pictureFacts();
  const plain = await viewer.picture();
  await viewer.press("v");
  const beside = await pictureFacts();
  assert.ok(beside.sides > 0 && beside.sides < 0.3 * beside.filled, `${JSON.stringify(beside)}`);
  const selected = await viewer.page.evaluate(() => {
    const { viewport } = window.dismantle!.app;
    return viewport.placeInView(10, 5).x === viewport.placeInView(10 + viewport.rig.size.x / 2, 5).x;
  });
  assert.equal(selected, true);
  await viewer.press("v");
  const anaglyph = await pictureFacts();
  assert.ok(anaglyph.red > 1.1 * one.red, `${anaglyph.red} ${one.red}`);
  await viewer.press("v");
  assert.ok((await viewer.picture()) === plain);
});

test("W shows the picture on the whole screen, and back", async () => {
  const width = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.size.x);
  const start = await width();
  await viewer.page.keyboard.press("w");
  await viewer.page.waitForFunction((x) => window.dismantle!.app.viewport.rig.size.x > x, start);
  await viewer.page.keyboard.press("w");
  await viewer.page.waitForFunction((x) => window.dismantle!.app.viewport.rig.size.x === x, start);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
