// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { camera, dragView, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope();
beforeEach(async () => {
  await viewer.page.mouse.move(5, 300);
  await viewer.press("Escape", "1", "f");
});

const kEmpty = { x: 190, y: 120 };

test("the page shows the model, its components and its number of triangles", async () => {
  const colors = await viewer.page.evaluate(() => {
    return new Set(new Uint32Array(window.dismantle!.imageData().data.buffer)).size;
  });
  assert.ok(colors > 200, `${colors} colours`);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 41);
  assert.match(await viewer.page.locator("#status").innerText(), /21,806 triangles/);
});

test("the first paint and the first model come quickly", async (t) => {
  await viewer.page.reload();
  await viewer.model();
  const { paint, model } = await viewer.page.evaluate(() => ({
    paint: performance.getEntriesByName("first-contentful-paint")[0].startTime,
    model: window.dismantle!.modelDrawn!,
  }));
  t.diagnostic(`first paint after ${paint.toFixed(0)} ms, the sample after ${model.toFixed(0)} ms`);
  // Generous: tests render in software, beside other tests.
  assert.ok(paint < 5000 && model < 10_000, `${paint} ${model}`);
});

test("all components are drawn with few draw calls, a translucent one separately", async () => {
  const calls = async () => {
    await viewer.idle();
    return viewer.page.evaluate(() => window.dismantle!.app.viewport.cost.calls);
  };
  const before = await calls();
  assert.ok(before < 16, `${before}`); // four of them for the axes in the corner
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

test("the left button orbits on empty space", async () => {
  const start = await camera();
  await dragView("left", kEmpty, 60, 30);
  const end = await camera();
  assert.notDeepEqual(end.orientation, start.orientation);
  assert.equal(end.distance, start.distance);
});

test("the right button orbits on a component, too, and moves nothing", async () => {
  const start = await camera();
  await dragView("right", await viewer.visiblePoint("base"), 60, 30);
  assert.notDeepEqual((await camera()).orientation, start.orientation);
  assert.equal((await viewer.state()).moves.length, 0);
});

test("the middle button pans: the component stays under the pointer", async () => {
  const position = await viewer.visiblePoint("base");
  await dragView("middle", position, 60, 30);
  assert.equal(await viewer.page.evaluate(({ x, y }) => window.dismantle!.at(x + 60, y + 30), position), "base");
});

test("the component under the cursor is named in the status line and highlighted in the tree", async () => {
  const { x, y } = await viewer.visiblePoint("head");
  await viewer.page.mouse.move(x, y);
  await viewer.idle();
  assert.equal(await viewer.page.locator("#status .subject").innerText(), "head");
  assert.equal(await viewer.page.locator("#tree-panel .row.hovered .name").innerText(), "head");
});

test("two fingers pan and zoom, one finger orbits on empty space", async () => {
  const touch = await viewer.touchscreen();
  const start = await camera();
  const touchAt = (x: number, id: number) => ({ x, y: 250, id });
  await touch("touchStart", touchAt(350, 0), touchAt(450, 1));
  await touch("touchMove", touchAt(300, 0), touchAt(500, 1));
  await touch("touchEnd");
  await viewer.idle();
  const near = await camera();
  assert.ok(near.distance < 0.7 * start.distance, `${near.distance} ${start.distance}`);
  assert.deepEqual(near.orientation, start.orientation);
  await viewer.press("f");
  await touch("touchStart", { ...kEmpty, id: 0 });
  await touch("touchMove", { x: kEmpty.x + 40, y: kEmpty.y, id: 0 });
  await touch("touchEnd");
  await viewer.idle();
  assert.notDeepEqual((await camera()).orientation, start.orientation);
  assert.equal((await viewer.state()).moves.length, 0);
});

test("a finger drags a component, with contact", async () => {
  const touch = await viewer.touchscreen();
  const { x, y } = await viewer.visiblePoint("foot");
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
  const position = await viewer.visiblePoint("eyepiece");
  await viewer.page.mouse.move(position.x, position.y);
  for (let i = 0; i < 6; ++i) await viewer.page.mouse.wheel(0, -240);
  await viewer.page.waitForFunction(
    (distance) => window.dismantle!.app.viewport.rig.current.distance < distance,
    0.3 * start.distance,
  );
  await viewer.idle();
  assert.equal(await viewer.page.evaluate(({ x, y }) => window.dismantle!.at(x, y), position), "eyepiece");
});

test("a double click focuses a component; F fits everything", async () => {
  const all = await camera();
  const { x, y } = await viewer.visiblePoint("specimen slide");
  await viewer.page.mouse.dblclick(x, y);
  await viewer.idle();
  const near = (await camera()).distance;
  assert.ok(near < 0.7 * all.distance, `${near} ${all.distance}`);
  await viewer.press("Escape", "f");
  const again = (await camera()).distance;
  assert.ok(Math.abs(again - all.distance) < 1e-6 * all.distance, `${again} ${all.distance}`);
});

test("the keys 1 to 6 and the view cube show the standard views", async () => {
  const seen = new Set<string>();
  for (const key of ["1", "2", "3", "4", "5", "6"]) {
    await viewer.press(key);
    seen.add(JSON.stringify((await camera()).orientation.map((value) => Number(value.toFixed(3)))));
  }
  assert.equal(seen.size, 6);
  await viewer.press("1");
  const front = await camera();
  const box = (await viewer.page.locator("#view").boundingBox())!;
  await viewer.press("3");
  assert.notDeepEqual((await camera()).orientation, front.orientation);
  // In the top view, the lower edge of the cube is the view between top and front.
  await viewer.page.mouse.click(box.x + box.width - 60, box.y + 60 + 26);
  await viewer.idle();
  const between = await camera();
  assert.notDeepEqual(between.orientation, front.orientation);
});

test("O toggles the parallel projection", async () => {
  const parallel = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.orthographic);
  await viewer.press("o");
  assert.equal(await parallel(), true);
  assert.equal(await viewer.page.getAttribute("#projection", "aria-pressed"), "true");
  await viewer.press("o");
  assert.equal(await parallel(), false);
});

test("the theme changes the page and the 3D view", async () => {
  const [light, first] = [
    await viewer.picture(),
    await viewer.page.evaluate(() => document.documentElement.dataset.theme),
  ];
  await viewer.press("t");
  assert.notEqual(await viewer.page.evaluate(() => document.documentElement.dataset.theme), first);
  assert.ok((await viewer.picture()) !== light);
  await viewer.press("t");
});

/// Differences of the image's red and blue, and of its halves, summed over a coarse grid.
const imageStatistics = () =>
  viewer.page.evaluate(() => {
    const { data, width, height } = window.dismantle!.imageData();
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

test("V switches stereo: side by side, anaglyph, off", async () => {
  const one = await imageStatistics();
  const plain = await viewer.picture();
  await viewer.press("v");
  const beside = await imageStatistics();
  assert.ok(beside.sides > 0 && beside.sides < 0.3 * beside.filled, `${JSON.stringify(beside)}`);
  const selected = await viewer.page.evaluate(() => {
    const { viewport } = window.dismantle!.app;
    return viewport.positionInView(10, 5).x === viewport.positionInView(10 + viewport.rig.size.x / 2, 5).x;
  });
  assert.equal(selected, true);
  await viewer.press("v");
  const anaglyph = await imageStatistics();
  assert.ok(anaglyph.red > 1.1 * one.red, `${anaglyph.red} ${one.red}`);
  await viewer.press("v");
  assert.ok((await viewer.picture()) === plain);
});

test("W toggles full screen", async () => {
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
