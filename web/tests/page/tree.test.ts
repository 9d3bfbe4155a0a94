// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { useMicroscope, viewer } from "../support/scene.ts";

useMicroscope();
beforeEach(async () => {
  await viewer.page.fill("#tree-search", "");
  await viewer.page.focus("#view");
  await viewer.press("Escape", "1");
});

const row = (name: string) =>
  viewer.page.locator("#tree-panel .row", { has: viewer.page.locator(`.name:text-is("${name}")`) }).last();
const drawn = (name: string) => viewer.page.evaluate((n) => window.dismantle!.drawn(n), name);
const shownRows = () => viewer.page.locator("#tree-panel .row:not(.group):visible").count();

test("clicks in the view and in the tree select in both", async () => {
  const { x, y } = await viewer.visiblePoint("head");
  await viewer.page.mouse.click(x, y);
  await viewer.idle();
  assert.deepEqual(await viewer.selection(), ["head"]);
  assert.equal(await row("head").getAttribute("aria-selected"), "true");
  await row("base").click();
  await viewer.idle();
  assert.deepEqual(await viewer.selection(), ["base"]);
  assert.equal(await viewer.page.locator("#selection-name").innerText(), "base");
});

test("Ctrl adds and removes; a group selects its components", async () => {
  await row("base").click();
  await row("arm").click({ modifiers: ["Control"] });
  assert.deepEqual(await viewer.selection(), ["base", "arm"]);
  await row("base").click({ modifiers: ["Control"] });
  assert.deepEqual(await viewer.selection(), ["arm"]);
  await viewer.page.locator(".row.group .name", { hasText: "stand" }).click();
  assert.deepEqual(await viewer.selection(), ["base", "foot", "foot#2", "foot#3", "foot#4", "arm screw M8x28"]);
});

test("the search filters by name", async () => {
  await viewer.press("/");
  await viewer.page.keyboard.type("objective");
  assert.equal(await shownRows(), 3);
  await viewer.page.fill("#tree-search", "no such thing");
  assert.equal(await shownRows(), 0);
  assert.equal(await viewer.page.locator("text=No matching component").isVisible(), true);
});

test("the eye hides a component, and a banner says that it still collides", async () => {
  const before = await viewer.picture();
  await row("head").hover();
  await row("head").locator("button").last().click();
  await viewer.idle();
  assert.equal((await viewer.state()).components[await viewer.index("head")].hidden, true);
  assert.equal(await drawn("head"), false);
  assert.ok((await viewer.picture()) !== before);
  assert.equal(await viewer.page.locator("[data-banner=hidden]").count(), 1);
  await viewer.click("[data-banner=hidden] button");
  assert.equal(await drawn("head"), true);
});

test("Space hides the selection and shows it again", async () => {
  await row("tube").click();
  await viewer.page.focus("#view");
  await viewer.press(" ");
  assert.equal(await drawn("tube"), false);
  await viewer.press(" ");
  assert.equal(await drawn("tube"), true);
});

test("Space hides also after a button was clicked", async () => {
  await row("tube").click();
  await viewer.click("#xray");
  await viewer.press(" ");
  assert.equal(await drawn("tube"), false);
  assert.equal(await viewer.page.getAttribute("#xray", "aria-pressed"), "true");
  await viewer.press(" ");
  assert.equal(await drawn("tube"), true);
  await viewer.click("#xray");
});

test("isolate shows one component alone, and can be undone", async () => {
  await row("condenser").click();
  await viewer.click("#isolate");
  assert.equal((await viewer.state()).isolated, true);
  assert.equal(await drawn("condenser"), true);
  assert.equal(await drawn("base"), false);
  await viewer.click("[data-banner=isolated] button");
  assert.equal((await viewer.state()).isolated, false);
  assert.equal(await drawn("base"), true);
});

test("X-ray makes a component translucent, and changes nothing else", async () => {
  const before = await viewer.picture();
  await row("arm").hover();
  await row("arm").locator("button").first().click();
  await viewer.page.mouse.move(400, 400);
  await viewer.idle();
  assert.equal(await row("arm").locator("button").first().getAttribute("aria-pressed"), "true");
  assert.ok((await viewer.picture()) !== before);
  assert.equal((await viewer.state()).components[await viewer.index("arm")].hidden, undefined);
});

test("the tree works by keyboard", async () => {
  await viewer.page.focus("#tree-panel [tabindex='0']");
  await viewer.press("Home", "ArrowLeft");
  assert.equal(await shownRows(), 0);
  await viewer.press("ArrowRight", "ArrowDown", "ArrowDown", "Enter");
  assert.deepEqual(await viewer.selection(), ["base"]);
});

test("the neighbours of the selection are listed with their state", async () => {
  await row("specimen slide").click();
  await viewer.page.locator("#pairs .badge.contact").first().waitFor();
  assert.match(await viewer.page.locator("#pairs").innerText(), /stage plate/);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
