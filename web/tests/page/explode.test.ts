// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import type { PathFile } from "../../src/guide.ts";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const status = () => viewer.page.locator("#explode-step").innerText();
const drawn = (name: string) => viewer.page.evaluate((n) => window.dismantle!.drawn(n), name);
/// True if a component is drawn outside the assembly's box.
const isOutside = (name: string) =>
  viewer.page.evaluate((n) => {
    const { session, viewport } = window.dismantle!.app;
    const [low, high] = session.store.model!.bounds;
    const { min, max } = viewport.model!.components.find(({ raw }) => raw.name === n)!.bounds();
    return [0, 1, 2].some((k) => min.getComponent(k) > high[k] || max.getComponent(k) < low[k]);
  }, name);
const playback = async () => (await viewer.state()).playback;
const scrub = async (position: number) => {
  await viewer.page.fill("#explode-slider", String(position));
  await viewer.idle();
};

test("without a path there is nothing to explode, and the panel says what to do", async () => {
  await viewer.press("e");
  assert.match(await status(), /Nothing to explode yet.*take components out/);
  assert.equal(await viewer.page.isVisible("#explode-slider"), false);
  assert.equal(await playback(), null);
  await viewer.press("e");
  assert.equal(await viewer.page.isVisible("#explode-panel"), false);
});

test("the exploded view shows removed components at the end of their paths, with a banner", async () => {
  await viewer.takeOut(kSlide);
  await viewer.takeOut("foot");
  assert.equal(await drawn(kSlide), false);
  await viewer.press("Escape", "e");
  assert.match(await status(), /Step 2 of 2: take out foot/);
  assert.equal(await viewer.page.locator("[data-banner=exploded]").count(), 1);
  const { moves } = JSON.parse(await viewer.recording()) as PathFile;
  for (const name of [kSlide, "foot"]) {
    assert.equal(await drawn(name), true, name);
    assert.deepEqual(await viewer.drawnShift(name), await viewer.shift(name));
    const end = moves.find(({ components }) => components[0] === name)!.frames.at(-1)!;
    assert.deepEqual(await viewer.shift(name), end.position);
    assert.ok(await isOutside(name), name);
  }
});

test("the slider scrubs the steps in order, with trails", async () => {
  const apart = await viewer.shift(kSlide);
  const trails = () =>
    viewer.page.evaluate(() => {
      const { scene } = window.dismantle!.app.viewport;
      const lines = scene.children.filter((child) => child.visible && "isLineSegments2" in child);
      return lines.map((line) => (line as unknown as { geometry: { instanceCount: number } }).geometry.instanceCount);
    });
  const [both] = await trails();
  await scrub(1);
  assert.match(await status(), /Step 1 of 2: take out specimen slide/);
  assert.deepEqual(await viewer.shift("foot"), [0, 0, 0]);
  assert.deepEqual(await viewer.shift(kSlide), apart);
  const [one] = await trails();
  assert.ok(one > 0 && one < both, `${one} ${both}`);
  await scrub(0.5);
  const [part, whole] = [await viewer.shift(kSlide), apart].map((shift) => Math.hypot(...shift));
  assert.ok(part > 20 && part < 0.9 * whole, `${part} of ${whole}`);
  await scrub(0);
  assert.match(await status(), /Assembled/);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.deepEqual(await trails(), []);
});

test("buttons and arrow keys step through the explosion", async () => {
  await viewer.click("#explode-after");
  assert.match(await status(), /Step 1 of 2/);
  await viewer.click("#explode-after");
  assert.match(await status(), /Step 2 of 2/);
  await viewer.click("#explode-before");
  assert.match(await status(), /Step 1 of 2/);
  await viewer.page.focus("#explode-slider");
  await viewer.press("ArrowLeft");
  assert.ok((await playback())!.time < 1);
});

test("leaving the exploded view restores all positions", async () => {
  await viewer.click("[data-banner=exploded] button");
  await viewer.page.locator("#explode-panel").waitFor({ state: "hidden" });
  await viewer.idle();
  assert.equal(await playback(), null);
  assert.equal(await drawn(kSlide), false);
  assert.equal((await viewer.state()).moves.length, 2);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
