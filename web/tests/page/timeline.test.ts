// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

/// How long the hand rests in a drag [ms]: its playback takes its time, however few pictures the drag had.
const kRest = 4000;
const playback = async () => (await viewer.state()).playback;

/// Until the playback stands still.
async function stands(): Promise<void> {
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.playing === false);
  await viewer.idle();
}

test("without a recording there is nothing to play", async () => {
  assert.equal(await viewer.page.isDisabled("#play"), true);
  assert.match(await viewer.page.locator("#timeline").innerText(), /recorded here/);
});

test("two drags are two blocks on the line of time", async () => {
  const { x, y } = await viewer.placeOf(kSlide);
  await viewer.grab(kSlide, 40, 0);
  await viewer.page.waitForTimeout(kRest);
  await viewer.page.mouse.move(x + 44, y);
  await viewer.letGo();
  await viewer.grab("foot", 0, 25);
  await viewer.letGo();
  assert.equal(await viewer.page.locator("#timeline .block").count(), 2);
  assert.equal(await viewer.page.isEnabled("#play"), true);
});

test("played backward it ends in the assembled state, to the bit", async () => {
  const there = await viewer.shift(kSlide);
  await viewer.page.selectOption("#speed", "4");
  await viewer.click("#play-reverse");
  await stands();
  assert.equal((await playback())!.time, 0);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  assert.equal(await viewer.page.locator("[data-banner=playback]").count(), 1);
  await viewer.click("#play");
  await stands();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
});

test("a playback is paused, and goes on faster", async () => {
  await viewer.page.selectOption("#speed", "0.25");
  await viewer.page.click("#play");
  await viewer.page.waitForFunction(() => {
    const { frame } = window.dismantle!.app.session.store;
    return frame?.playback && frame.time > 0;
  });
  await viewer.click("#play-pause");
  const { time, playing, duration } = (await playback())!;
  assert.ok(!playing && time > 0 && time < duration, `${time}`);
  await viewer.page.keyboard.press("p");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback!.playing);
  await viewer.page.selectOption("#speed", "4");
  await stands();
  assert.equal((await playback())!.speed, 4);
  assert.equal((await playback())!.time, duration);
});

test("the scrubber goes to any time", async () => {
  await viewer.page.fill("#scrub", "0");
  await viewer.idle();
  assert.equal((await playback())!.time, 0);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.page.fill("#scrub", "1000");
  await viewer.idle();
  const { time, duration } = (await playback())!;
  assert.ok(Math.abs(time - duration) < 1e-6);
});

test("buttons and keys go from move to move", async () => {
  const [first, second] = (await viewer.state()).moves;
  const time = async () => (await playback())!.time;
  await viewer.click("#play-before");
  assert.ok(Math.abs((await time()) - second.start) < 1e-6, `${await time()}`);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  assert.ok((await viewer.drawnShift(kSlide))[0] > 5);
  await viewer.press(",");
  assert.equal(await time(), first.start);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.press(".");
  assert.ok(Math.abs((await time()) - second.start) < 1e-6, `${await time()}`);
  await viewer.click("#play-next");
  assert.ok(Math.abs((await time()) - second.start - second.duration) < 1e-6, `${await time()}`);
});

test("back to work: everything is where it was, and can be moved again", async () => {
  const there = (await viewer.drawnShift(kSlide))[0];
  await viewer.page.fill("#scrub", "300");
  await viewer.click("#play-stop");
  await viewer.press("1");
  assert.equal(await playback(), null);
  assert.equal((await viewer.drawnShift(kSlide))[0], there);
  await viewer.grab(kSlide, 20, 0);
  await viewer.letGo();
  assert.ok((await viewer.shift(kSlide))[0] > there);
});

test("the recording is saved as a path file", async () => {
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.page.click("#save")]);
  assert.equal(download.suggestedFilename(), "microscope.path.json");
  const path = JSON.parse(readFileSync((await download.path())!, "utf8"));
  assert.equal(path.format, "dismantle-path");
  assert.deepEqual(
    path.moves.map((move: { components: string[] }) => move.components[0]),
    [kSlide, "foot", kSlide],
  );
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
