// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { guidePath, highlighted, kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const step = () => viewer.page.locator("#guide-step").innerText();
const score = () => viewer.page.locator("#guide-score").innerText();

test("a recording becomes a guide: everything is assembled, and the first step is named", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.release();
  await viewer.grab("foot", 0, 25);
  await viewer.release();
  await viewer.press("1");
  await viewer.click("#follow");
  await viewer.page.locator("#guide-panel").waitFor();
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.match(await step(), /Step 1 of 2: remove specimen slide/);
  assert.deepEqual(await highlighted(), [kSlide]);
});

test("the ghost shows the path and disappears", async () => {
  await viewer.page.hover("#guide-show");
  const before = await viewer.picture();
  await viewer.page.click("#guide-show");
  await viewer.page.waitForFunction((picture) => window.dismantle!.app.viewport.canvas.toDataURL() !== picture, before);
  await viewer.idle();
  assert.ok((await viewer.picture()) === before);
});

test("a completed step leads to the next, the last one to the end", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.release();
  assert.match(await step(), /Step 2 of 2: remove foot/);
  assert.deepEqual(await highlighted(), ["foot"]);
  await viewer.grab("foot", 0, 25);
  await viewer.release();
  assert.match(await step(), /Done/);
});

test("practice counts components out of order, contacts and hints", async () => {
  await reset();
  await viewer.page.check("#guide-practice");
  await viewer.idle();
  assert.match(await step(), /Step 1 of 2: what comes next/);
  assert.match(await score(), /^100 points/);
  await viewer.grab("foot", 0, 12);
  await viewer.release();
  assert.match(await score(), /1 out of order/);
  await viewer.press("1");
  await viewer.grab(kSlide, 0, 40);
  await viewer.release();
  assert.match(await score(), /[1-9]\d* contacts?,/);
  await viewer.click("#guide-show");
  assert.match(await score(), /1 hint$/);
});

test("the guide can be played", async () => {
  await reset();
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.source === "guide");
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 5, kSlide);
  await viewer.click("#play-stop");
});

test("a step can be skipped", async () => {
  await viewer.page.uncheck("#guide-practice");
  await viewer.idle();
  await viewer.click("#guide-skip");
  assert.match(await step(), /Step 2 of 2/);
  assert.deepEqual(await highlighted(), ["foot"]);
});

test("a guide can be closed, and a path file opened as a guide", async () => {
  const path = await guidePath();
  await viewer.click("#guide-close");
  assert.equal((await viewer.state()).guide, null);
  assert.equal(await viewer.page.isVisible("#guide-panel"), false);
  const file = { name: "mine.path.json", mimeType: "application/json", buffer: Buffer.from(path) };
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.page.locator("#guide-step", { hasText: /Step 1 of 2/ }).waitFor();
  assert.equal((await viewer.state()).guide!.name, "mine.path.json");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
