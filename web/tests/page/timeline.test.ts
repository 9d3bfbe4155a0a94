// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { kSlide, useMicroscope, viewer, waitForPlaybackEnd } from "../support/scene.ts";

useMicroscope({ view: "1" });

/// Pause during a drag [ms], so that its playback lasts, however few frames the drag had.
const kHoldTime = 4000;
const playback = async () => (await viewer.state()).playback;

async function playToEnd(): Promise<void> {
  await waitForPlaybackEnd();
  await viewer.idle();
}

test("without a recording there is nothing to play", async () => {
  assert.equal(await viewer.page.isDisabled("#play"), true);
  assert.match(await viewer.page.locator("#timeline").innerText(), /recorded here/);
});

test("two drags are two blocks on the timeline", async () => {
  const { x, y } = await viewer.visiblePoint(kSlide);
  await viewer.grab(kSlide, 40, 0);
  await viewer.page.waitForTimeout(kHoldTime);
  await viewer.page.mouse.move(x + 44, y);
  await viewer.release();
  await viewer.grab("foot", 0, 25);
  await viewer.release();
  assert.equal(await viewer.page.locator("#timeline .block").count(), 2);
  assert.equal(await viewer.page.isEnabled("#play"), true);
});

test("backward playback ends exactly in the assembled state", async () => {
  const there = await viewer.shift(kSlide);
  await viewer.page.selectOption("#speed", "4");
  await viewer.click("#play-reverse");
  await playToEnd();
  assert.equal((await playback())!.time, 0);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  assert.equal(await viewer.page.locator("[data-banner=playback]").count(), 1);
  await viewer.click("#play");
  await playToEnd();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
});

test("playback can be paused, and continued at another speed", async () => {
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
  await playToEnd();
  assert.equal((await playback())!.speed, 4);
  assert.equal((await playback())!.time, duration);
});

test("the scrubber seeks to any time", async () => {
  await viewer.page.fill("#scrub", "0");
  await viewer.idle();
  assert.equal((await playback())!.time, 0);
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  await viewer.page.fill("#scrub", "1000");
  await viewer.idle();
  const { time, duration } = (await playback())!;
  assert.ok(Math.abs(time - duration) < 1e-6);
});

test("buttons and keys step through the moves", async () => {
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

test("leaving the playback restores all positions", async () => {
  const there = (await viewer.drawnShift(kSlide))[0];
  await viewer.page.fill("#scrub", "300");
  await viewer.click("#play-stop");
  await viewer.press("1");
  assert.equal(await playback(), null);
  assert.equal((await viewer.drawnShift(kSlide))[0], there);
  await viewer.grab(kSlide, 20, 0);
  await viewer.release();
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
