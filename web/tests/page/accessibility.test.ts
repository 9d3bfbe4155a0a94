// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { reachedByTab, violationsOf } from "../support/accessibility.ts";
import { camera, useMicroscope, viewer, waitForSearch } from "../support/scene.ts";

useMicroscope();

async function faults(): Promise<string[]> {
  await viewer.idle();
  return violationsOf(viewer.page);
}

/// Moves the focus to an element by Tab alone.
async function tabTo(selector: string): Promise<void> {
  for (let i = 0; i < 120; ++i) {
    if (await viewer.page.evaluate((target) => document.activeElement?.matches(target) === true, selector)) return;
    await viewer.page.keyboard.press("Tab");
  }
  throw new Error(`${selector} is not reached by Tab`);
}

const type = (text: string) => viewer.page.keyboard.type(text);
const automaticIsOver = () =>
  viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic === null);

test("by keyboard: search, select, free directions, move by numbers, undo, take out, put back", async () => {
  await viewer.press("/");
  await type("foot");
  await viewer.press("ArrowDown", "Enter");
  assert.deepEqual(await viewer.selection(), ["foot"]);
  await viewer.press("ArrowDown", "Control+Enter");
  assert.deepEqual(await viewer.selection(), ["foot", "foot#2"]);
  await viewer.press("ArrowUp", "Enter", "d");
  await viewer.page.locator("#directions .direction.free").first().waitFor();
  await tabTo("#numeric-2");
  await viewer.press("Control+a");
  await type("-5");
  await viewer.press("Enter");
  const [, , z] = await viewer.shift("foot");
  assert.ok(Math.abs(z + 5) < 0.05, `${z}`);
  await tabTo("#view");
  await viewer.press("Control+z");
  assert.deepEqual(await viewer.shift("foot"), [0, 0, 0]);
  const foot = await viewer.index("foot");
  await viewer.page.keyboard.press("Delete");
  await viewer.page.waitForFunction((c) => window.dismantle!.app.session.store.state!.components[c].removed, foot);
  await automaticIsOver();
  await viewer.press("b");
  await automaticIsOver();
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
});

test("by keyboard: orbit, pan, zoom, isolate, X-ray, measure, section and contact response", async () => {
  await tabTo("#view");
  await viewer.press("Escape", "1", "f");
  const start = await camera();
  await viewer.press("ArrowLeft");
  const turned = await camera();
  assert.notDeepEqual(turned.orientation, start.orientation);
  await viewer.press("Shift+ArrowUp");
  assert.notDeepEqual((await camera()).focus, turned.focus);
  await viewer.press("+");
  assert.ok((await camera()).distance < 0.9 * turned.distance);
  await viewer.press("-");

  await viewer.select("foot");
  await viewer.press("i");
  assert.equal((await viewer.state()).isolated, true);
  await viewer.press("i");
  assert.equal((await viewer.state()).isolated, false);
  await tabTo("#xray");
  await viewer.press("Enter");
  assert.equal(await viewer.page.getAttribute("#xray", "aria-pressed"), "true");
  await viewer.press("Enter");

  await viewer.press("m");
  assert.equal(await viewer.page.isVisible("#measure-center"), true);
  await viewer.press("1", "f", "Enter", "Shift+ArrowRight", "Enter");
  assert.match(await viewer.page.locator("#measure-label").innerText(), /^[1-9][\d.]* mm/);
  await viewer.press("m", "s");
  const cut = await viewer.picture();
  await viewer.press("ArrowRight", "ArrowRight", "PageUp");
  assert.ok((await viewer.picture()) !== cut, "the arrow keys move the plane");
  await viewer.press("s");
  await tabTo("#response input");
  await viewer.press("ArrowRight");
  assert.equal((await viewer.state()).response, "touch");
  await viewer.press("ArrowLeft");
  assert.equal((await viewer.state()).response, "slide");
});

test("by keyboard: play, step, explode, guide and export", async () => {
  await tabTo("#speed");
  await viewer.press("Home"); // the slowest
  await tabTo("#view");
  await viewer.page.keyboard.press("p");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.playing);
  await viewer.press("p");
  assert.equal((await viewer.state()).playback!.playing, false);
  await viewer.press(",");
  assert.equal((await viewer.state()).playback!.time, 0);
  await tabTo("#play-stop");
  await viewer.press("Enter");
  assert.equal((await viewer.state()).playback, null);
  await viewer.press("e");
  await viewer.page.locator("[data-banner=exploded]").waitFor();
  await tabTo("#explode-slider");
  await viewer.press("Home");
  assert.equal((await viewer.state()).playback!.time, 0);
  await viewer.press("e");
  await tabTo("#export");
  await viewer.press("Enter");
  await tabTo("#export-path-json");
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.press("Enter")]);
  assert.equal(download.suggestedFilename(), "microscope.path.json");
  await viewer.press("Escape");
  await tabTo("#follow");
  await viewer.press("Enter");
  await viewer.page.locator("#guide-panel").waitFor();
});

test("axe-core reports nothing serious with every panel open, in light and dark", async () => {
  await viewer.select("foot");
  await viewer.page.keyboard.press("q");
  await waitForSearch("why");
  await tabTo("#view");
  await viewer.press("d", "l", "s", "g", "m", "i");
  await viewer.page.check("#guide-practice");
  for (const part of ["plan-panel", "section-panel", "guide-panel", "measure-label", "reason", "directions", "banners"])
    assert.equal(await viewer.page.isVisible(`#${part}`), true, part);
  assert.deepEqual(await faults(), []);
  await viewer.press("t");
  assert.deepEqual(await faults(), []);
  await viewer.press("t", "m", "g", "s", "l", "i");
});

test("axe-core reports nothing serious in the exploded view", async () => {
  await viewer.click("#guide-close");
  await viewer.select("foot");
  await viewer.page.fill("#numeric-2", "-5");
  await viewer.click("#numeric-apply");
  await tabTo("#view");
  await viewer.press("e");
  await viewer.page.locator("[data-banner=exploded]").waitFor();
  assert.deepEqual(await faults(), []);
  await viewer.press("e");
});

test("axe-core reports nothing serious in the dialogs", async () => {
  await viewer.press("h");
  assert.deepEqual(await faults(), []);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.click("#export");
  assert.deepEqual(await faults(), []);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.click("#open");
  await viewer.page.locator("#samples .card").first().waitFor();
  assert.deepEqual(await faults(), []);
  await viewer.page.keyboard.press("Escape");
});

test("every button can be reached by Tab", async () => {
  await viewer.select("foot");
  const reached = await reachedByTab(viewer.page, 80);
  for (const id of [
    "open",
    "response-slide",
    "gizmo",
    "section",
    "measure",
    "plan",
    "fit",
    "theme",
    "help",
    "tree-search",
    "view",
    "take-out",
    "isolate",
    "find-path",
    "why",
    "numeric-0",
    "undo",
    "export",
    "save",
    "scrub",
    "play",
    "speed",
    "follow",
  ])
    assert.ok(reached.has(id), id);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
