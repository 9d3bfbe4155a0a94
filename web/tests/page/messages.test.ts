// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kSlide, useMicroscope, viewer, waitForSearch } from "../support/scene.ts";

useMicroscope({ view: "1" });

/// Texts of buttons and labels that do not fit into them.
const cutOff = () =>
  viewer.page.evaluate(() =>
    [
      ...document.querySelectorAll<HTMLElement>(
        "#plan-panel :is(label, legend, button, p), header button, .actions button",
      ),
    ]
      .filter((shown) => shown.offsetParent !== null && shown.innerText.trim() !== "")
      .filter((shown) => shown.scrollWidth > shown.clientWidth + 1 && getComputedStyle(shown).overflow !== "visible")
      .map((shown) => shown.innerText),
  );

test("a plan covers everything by default, even with a selection", async () => {
  await viewer.select("thumb screw threaded", "bracket screw M4x16", "bracket screw M4x16#2", "stage bracket");
  await viewer.press("l");
  assert.equal(await viewer.page.isChecked("#plan-all"), true);
  assert.deepEqual(await cutOff(), []);
  await viewer.press("l", "Escape");
});

test("several blocking components are one name and a count", async () => {
  const name = (count: number) =>
    viewer.page.evaluate((n) => window.dismantle!.app.session.namesOf([...Array(n).keys()], 1), count);
  assert.equal(await name(1), "base");
  assert.equal(await name(3), "base and 2 more");
});

test("a direction between the axes is told by the nearest one", async () => {
  await viewer.select("eye lens");
  await viewer.page.click("#why");
  await waitForSearch("why");
  await viewer.idle();
  const panel = await viewer.page.locator("#inspector").innerText();
  assert.match(panel, /It can be removed (near [+−][XYZ] \(\d+° off\)|between [+−][XYZ] and [+−][XYZ])\./);
  await viewer.press("Escape");
});

test("the minimum clearance of a drag goes with the drag that is undone", async () => {
  await viewer.press("1");
  await viewer.grab(kSlide, 60, 0);
  await viewer.release();
  const clearance = viewer.page.locator("#clearance");
  assert.match(await clearance.innerText(), /Minimum in this drag\s+[^–\s]/);
  await viewer.press("Control+z");
  await viewer.idle();
  assert.match(await clearance.innerText(), /Minimum in this drag\s+–/);
});

test("the status line says nothing of what drawing costs; its tooltip does", async () => {
  assert.doesNotMatch(await viewer.page.locator("#status").innerText(), /draw|render|fps/i);
  await viewer.page.waitForFunction(() => /\d+ draw/.test(document.querySelector<HTMLElement>("#status-link")!.title));
});

test("the quick exploded view says that it is approximate", async () => {
  await viewer.click("#explode");
  await viewer.page.fill("#explode-quick", "1");
  const banner = viewer.page.locator("[data-banner=approximate]");
  await banner.waitFor();
  await viewer.page.fill("#explode-quick", "0");
  await banner.waitFor({ state: "detached" });
  await viewer.click("#explode");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
