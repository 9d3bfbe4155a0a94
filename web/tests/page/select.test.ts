// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { camera, kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });
beforeEach(async () => {
  await viewer.page.focus("#view");
  await viewer.press("Escape", "1", "f");
});

const row = (name: string) =>
  viewer.page.locator("#tree-panel .row:not(.group)").filter({ has: viewer.page.locator(`.name:text-is("${name}")`) });
const menu = "#context-menu";
const item = (action: string) => viewer.page.locator(`${menu} [data-action=${action}]`);

/// Drags a box with Shift between two points of the view, as fractions of its size.
async function drawBox(from: [number, number], to: [number, number]): Promise<string | undefined> {
  const area = (await viewer.page.locator("#view").boundingBox())!;
  const at = ([x, y]: [number, number]) => [area.x + x * area.width, area.y + y * area.height] as const;
  await viewer.page.keyboard.down("Shift");
  await viewer.page.mouse.move(...at(from));
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(...at(to), { steps: 4 });
  const rule = await viewer.page.getAttribute("#selection-box", "data-rule");
  await viewer.page.mouse.up();
  await viewer.page.keyboard.up("Shift");
  await viewer.idle();
  return rule ?? undefined;
}

test("components of the same shape are selected together", async () => {
  await viewer.select("foot#3");
  await viewer.click("#select-similar");
  assert.deepEqual((await viewer.selection()).sort(), ["foot", "foot#2", "foot#3", "foot#4"]);
});

test("Shift selects the rows between two clicks", async () => {
  await row("foot").click();
  await row("foot#3").click({ modifiers: ["Shift"] });
  assert.deepEqual(await viewer.selection(), ["foot", "foot#2", "foot#3"]);
  await row("base").click({ modifiers: ["Shift"] });
  assert.deepEqual(await viewer.selection(), ["base", "foot"]);
});

test("a box drawn to the right selects what is inside, without moving the view", async () => {
  const before = await camera();
  assert.equal(await drawBox([0.02, 0.02], [0.98, 0.98]), "inside");
  assert.equal((await viewer.selection()).length, 41);
  assert.deepEqual(await camera(), before);
  assert.equal(await viewer.page.isVisible("#selection-box"), false);
});

test("a box drawn to the left also selects what it crosses", async () => {
  assert.equal(await drawBox([0.02, 0.6], [0.98, 0.98]), "inside");
  const inside = await viewer.selection();
  assert.equal(await drawBox([0.98, 0.6], [0.02, 0.98]), "crossing");
  const crossed = await viewer.selection();
  assert.ok(inside.includes("foot") && !inside.includes("arm"), inside.join());
  assert.ok(crossed.length > inside.length && inside.every((name) => crossed.includes(name)));
});

test("the right button opens a menu on a component, and still orbits", async () => {
  const { x, y } = await viewer.visiblePoint(kSlide);
  await viewer.page.mouse.click(x, y, { button: "right" });
  await viewer.page.locator(menu).waitFor();
  assert.deepEqual(await viewer.selection(), [kSlide]);
  assert.equal(await item("putBack").isDisabled(), true);
  await item("xray").click();
  assert.equal(await viewer.page.isVisible(menu), false);
  assert.equal(await viewer.page.getAttribute("#xray", "aria-pressed"), "true");
  await viewer.click("#xray");

  const before = await camera();
  await viewer.page.mouse.move(x, y);
  await viewer.page.mouse.down({ button: "right" });
  await viewer.page.mouse.move(x + 40, y, { steps: 3 });
  await viewer.page.mouse.up({ button: "right" });
  await viewer.idle();
  assert.notDeepEqual((await camera()).orientation, before.orientation);
  assert.equal(await viewer.page.isVisible(menu), false);
});

test("the menu takes a component out, and selects similar ones", async () => {
  await row("foot").click({ button: "right" });
  await item("selectSimilar").click();
  assert.equal((await viewer.selection()).length, 4);
  await row(kSlide).click({ button: "right" });
  await item("takeOut").click();
  await viewer.page.waitForFunction(
    (i) => window.dismantle!.app.session.store.state!.components[i].removed,
    await viewer.index(kSlide),
  );
  await viewer.idle();
});

test("the menu works by keyboard, and closes with Escape", async () => {
  await row("base").click();
  await row("base").press("Shift+F10");
  await viewer.page.locator(menu).waitFor();
  await viewer.page.keyboard.press("End");
  assert.equal(await viewer.page.evaluate(() => (document.activeElement as HTMLElement).dataset.action), "fit");
  await viewer.page.keyboard.press("Escape");
  assert.equal(await viewer.page.isVisible(menu), false);
  assert.deepEqual(await viewer.selection(), ["base"]);
});

test("on empty space the menu shows hidden components again", async () => {
  await viewer.select("head");
  await viewer.press(" ");
  const area = (await viewer.page.locator("#view").boundingBox())!;
  await viewer.page.mouse.click(area.x + 6, area.y + area.height / 2, { button: "right" });
  await item("showAll").click();
  await viewer.idle();
  assert.equal((await viewer.state()).components[await viewer.index("head")].hidden, undefined);
});

test("keys that need a selection say so", async () => {
  for (const key of ["n", "q"]) {
    await viewer.page.keyboard.press(key);
    await viewer.page.locator(".toast", { hasText: "Select a component first." }).first().waitFor();
    await viewer.page.locator(".toast button").first().click();
  }
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
