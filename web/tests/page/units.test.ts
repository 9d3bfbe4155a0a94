// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const textOf = (selector: string) => viewer.page.locator(selector).innerText();

test("the button changes the unit of every length that is shown", async () => {
  await viewer.select(kSlide);
  await viewer.press("d");
  await viewer.page.locator("#directions .direction").first().waitFor();
  await viewer.page.locator("#pairs .badge").first().waitFor();
  const millimetres = await textOf("#inspector .body > .facts:first-child");
  assert.match(millimetres, /76\.0 × 26\.0 × 1\.0 mm/);
  await viewer.click("#units");
  assert.match(await textOf("#inspector .body > .facts:first-child"), /2\.992 × 1\.024 × 0\.039 in/);
  assert.match(await textOf("#status-tolerance"), / in$/);
  await viewer.press("s", "m");
  for (const part of ["#inspector", "#side", "#status", "#measure-label"])
    assert.doesNotMatch(await textOf(part), /\d (mm|µm)|\[mm\]/, part);
  await viewer.press("m", "s");
  await viewer.press("u");
  assert.match(await textOf("#inspector .body > .facts:first-child"), /76\.0 × 26\.0 × 1\.0 mm/);
});

test("numbers that are typed are in the shown unit, and converted when it changes", async () => {
  await viewer.page.fill("#numeric-0", "25.4");
  await viewer.press("Tab");
  await viewer.click("#units");
  assert.equal(await viewer.page.inputValue("#numeric-0"), "1");
  assert.match(await textOf("#numeric"), /X \[in\]/);
  await viewer.click("#numeric-apply");
  const [x] = await viewer.shift(kSlide);
  assert.ok(Math.abs(x - 25.4) < 0.05, `${x}`);
  assert.match(await textOf("#inspector .body > .facts:first-child"), /moved 1\.00\d in|moved 0\.99\d+ in/);
  await reset();
});

test("the unit is kept when the page is loaded again", async () => {
  await viewer.page.reload();
  await viewer.model();
  assert.equal(await textOf("#units"), "in");
  await viewer.click("#units");
  assert.equal(await textOf("#units"), "mm");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
