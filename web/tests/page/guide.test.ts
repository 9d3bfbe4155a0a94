// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const step = () => viewer.page.locator("#guide-step").innerText();
/// The components that are drawn as what comes next.
const glowing = () =>
  viewer.page.evaluate(() =>
    window.dismantle!.app.viewport.model!.components.filter(({ look }) => look.next).map(({ raw }) => raw.name),
  );
const score = () => viewer.page.locator("#guide-score").innerText();
test("the recording becomes a guide: everything is assembled again, and the first step is named", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.letGo();
  await viewer.grab("foot", 0, 25);
  await viewer.letGo();
  await viewer.press("1");
  await viewer.click("#follow");
  await viewer.page.locator("#guide-panel").waitFor();
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.match(await step(), /Step 1 of 2: take specimen slide/);
  assert.deepEqual(await glowing(), [kSlide]);
});

test("the ghost shows the way and goes", async () => {
  await viewer.page.hover("#guide-show");
  const before = await viewer.picture();
  await viewer.page.click("#guide-show");
  await viewer.page.waitForFunction((picture) => window.dismantle!.app.viewport.canvas.toDataURL() !== picture, before);
  await viewer.idle();
  assert.ok((await viewer.picture()) === before);
});

test("a step that is done leads to the next, the last one to the end", async () => {
  await viewer.grab(kSlide, 60, 0);
  await viewer.letGo();
  assert.match(await step(), /Step 2 of 2: take foot/);
  assert.deepEqual(await glowing(), ["foot"]);
  await viewer.grab("foot", 0, 25);
  await viewer.letGo();
  assert.match(await step(), /Done/);
});

test("practice counts what is taken out of turn, contacts and hints", async () => {
  await reset();
  await viewer.page.check("#guide-practice");
  await viewer.idle();
  assert.match(await step(), /Step 1 of 2: what comes next/);
  assert.match(await score(), /^100 points/);
  await viewer.grab("foot", 0, 12);
  await viewer.letGo();
  assert.match(await score(), /1 out of turn/);
  await viewer.press("1");
  await viewer.grab(kSlide, 0, 40);
  await viewer.letGo();
  assert.match(await score(), /[1-9]\d* contacts/);
  await viewer.click("#guide-show");
  assert.match(await score(), /1 hints/);
});

test("the guide plays by itself", async () => {
  await reset();
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.source === "guide");
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 5, kSlide);
  await viewer.click("#play-stop");
});

test("a step can be passed over", async () => {
  await viewer.page.uncheck("#guide-practice");
  await viewer.idle();
  await viewer.click("#guide-skip");
  assert.match(await step(), /Step 2 of 2/);
  assert.deepEqual(await glowing(), ["foot"]);
});

test("closed, the guide is gone; a path file that is opened is followed again", async () => {
  const path = await viewer.page.evaluate(async () =>
    (await window.dismantle!.app.session.connection.request("/api/guide.json")).text(),
  );
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
