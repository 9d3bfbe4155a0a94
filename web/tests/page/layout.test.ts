// SPDX-License-Identifier: Apache-2.0
// Panels leave the 3D view free, and what is played stays in the picture.
import assert from "node:assert/strict";
import { test } from "node:test";
import { camera, useMicroscope, viewer, waitForPlaybackEnd, waitForSearch } from "../support/scene.ts";

useMicroscope({ view: "1" });

/// Which panels have a point over the 3D view.
const covering = () =>
  viewer.page.evaluate(() => {
    const view = document.getElementById("view")!.getBoundingClientRect();
    return ["plan-panel", "section-panel", "explode-panel", "guide-panel", "inspector"].filter((id) => {
      const box = document.getElementById(id)!.getBoundingClientRect();
      return (
        box.width > 0 &&
        box.left < view.right &&
        box.right > view.left &&
        box.top < view.bottom &&
        box.bottom > view.top
      );
    });
  });
/// True if all visible components are in the picture.
const allInPicture = () =>
  viewer.page.evaluate(() => {
    const { rig, model } = window.dismantle!.app.viewport;
    return rig.shows(model!.bounds());
  });
const guideStep = () => viewer.page.locator("#guide-step").innerText();

for (const size of [
  { width: 1280, height: 800 },
  { width: 1024, height: 700 },
])
  test(`no panel covers the view of a window of ${size.width} x ${size.height}`, async () => {
    await viewer.page.setViewportSize(size);
    await viewer.press("l", "s");
    if (size.width === 1280) {
      await viewer.page.click("#plan-find");
      await waitForSearch("plan");
    }
    await viewer.press("e");
    await viewer.page.locator("[data-banner=exploded]").waitFor();
    await viewer.idle();
    for (const id of ["plan-panel", "section-panel", "explode-panel", "guide-panel"])
      assert.equal(await viewer.page.isVisible(`#${id}`), true, id);
    assert.deepEqual(await covering(), []);
    await viewer.page.focus("#view");
    await viewer.press("e", "s", "l");
  });

test("the exploded view is fitted to the picture", async () => {
  await viewer.press("1");
  const before = await camera();
  await viewer.press("e");
  await viewer.page.locator("[data-banner=exploded]").waitFor();
  await viewer.idle();
  assert.equal(await allInPicture(), true);
  await viewer.press("e");
  await viewer.idle();
  assert.deepEqual((await camera()).distance, before.distance);
});

test("playing everything stays in the picture, and the guide follows", async () => {
  assert.match(await viewer.page.locator("#guide-panel header").innerText(), /^Planned sequence/);
  const count = (await viewer.state()).guide!.moves.length;
  await viewer.page.selectOption("#speed", "4");
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => (window.dismantle!.app.session.store.state!.playback?.move ?? 0) > 2);
  assert.doesNotMatch(await guideStep(), /^Step [12] of/);
  await viewer.page.click("#play-pause");
  await viewer.page.click("#play-end");
  await waitForPlaybackEnd();
  await viewer.idle();
  assert.match(await guideStep(), new RegExp(`^Step ${count} of ${count}`));
  assert.equal(await allInPicture(), true);
  await viewer.click("#play-stop");
  assert.match(await guideStep(), /^Step 1 of/);
});

test("the blocks of the timeline have the number and the name of each step", async () => {
  await viewer.page.click("#guide-play");
  await viewer.page.locator("#timeline .block").first().waitFor();
  const blocks = await viewer.page.locator("#timeline .block").allInnerTexts();
  assert.ok(
    blocks.every((block, i) => block.startsWith(`${i + 1} `)),
    blocks.join(),
  );
  assert.ok(blocks.every((block) => !/remove|take out/.test(block)));
  await viewer.click("#play-stop");
});

test("F in a standard view fills the picture", async () => {
  await viewer.press("Escape", "1", "f");
  const { wide, high } = await viewer.page.evaluate(() => {
    const { rig, model } = window.dismantle!.app.viewport;
    const { min, max } = model!.bounds();
    const [a, b] = [rig.project(min), rig.project(max)];
    return { wide: Math.abs(b.x - a.x) / rig.size.x, high: Math.abs(b.y - a.y) / rig.size.y };
  });
  assert.ok(Math.max(wide, high) > 0.8, `${wide} ${high}`);
});

test("the axes are drawn in the lower left corner", async () => {
  const inked = () =>
    viewer.page.evaluate(() => {
      const { data, width, height } = window.dismantle!.imageData();
      let count = 0;
      for (let y = height - 88; y < height; ++y)
        for (let x = 0; x < 88; ++x) if (data[4 * (y * width + x) + 3] > 0) ++count;
      return count;
    });
  await viewer.page.evaluate(() => {
    const { rig } = window.dismantle!.app.viewport;
    rig.pan(2000, 0, rig.current.focus);
  });
  await viewer.idle();
  const count = await inked();
  assert.ok(count > 60 && count < 4000, `${count}`);
  await viewer.press("f");
});

test("a long list of blockers is one sentence, with the rest below", async () => {
  await viewer.select("base");
  await viewer.page.keyboard.press("q");
  await waitForSearch("why");
  await viewer.idle();
  const sentence = await viewer.page.locator("#reason-sentence").innerText();
  assert.match(sentence, /^(Take off .* first; then it comes out|Blocked .* by) .*\.$/);
  assert.ok(sentence.length < 200, sentence);
  assert.equal(await viewer.page.locator("#reason details[open]").count(), 0);
  const { reasons } = (await viewer.state()).search!;
  assert.equal(await viewer.page.locator("#reason li").count(), reasons[0].blockers.length);
  assert.ok((await viewer.page.evaluate(() => window.dismantle!.app.viewport.blocked.arrows.length)) <= 6);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
