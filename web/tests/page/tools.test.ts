// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { beforeEach, test } from "node:test";
import { kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope();
beforeEach(async () => {
  await viewer.page.focus("#view");
  if ((await viewer.page.locator("[data-banner=section]").count()) > 0) await viewer.press("s");
  await viewer.press("Escape", "1", "f");
});

test("a section cuts the model, and what is cut away cannot be grabbed", async () => {
  const whole = await viewer.picture();
  const inFront = await viewer.visiblePoint("arm");
  await viewer.press("s");
  assert.ok((await viewer.picture()) !== whole);
  assert.equal(await viewer.page.locator("[data-banner=section]").count(), 1);
  assert.notEqual(await viewer.page.evaluate(({ x, y }) => window.dismantle!.at(x, y), inFront), "arm");
  const half = await viewer.picture();
  await viewer.page.locator("#section-panel input[type=range]").nth(1).fill("0.3");
  await viewer.idle();
  assert.ok((await viewer.picture()) !== half);
  await viewer.page.focus("#view");
  await viewer.press("s");
  assert.ok((await viewer.picture()) === whole);
});

test("the section of a solid is capped: flat and hatched, with two colours only", async () => {
  const position = await viewer.page.evaluate(() => {
    const { min, max } = window
      .dismantle!.app.viewport.model!.components.find(({ raw }) => raw.name === "base")!
      .bounds();
    return window.dismantle!.project([0.8 * min.x + 0.2 * max.x, (min.y + max.y) / 2, 0.5 * min.z + 0.5 * max.z]);
  });
  await viewer.press("s");
  await viewer.page.locator("#section-panel input[type=range]").nth(1).fill("0.5");
  await viewer.idle();
  const reds = await viewer.page.evaluate(({ x, y }) => {
    const box = window.dismantle!.app.viewport.canvas.getBoundingClientRect();
    const { data, width } = window.dismantle!.imageData();
    const [left, top] = [x - box.left - 6, y - box.top - 6].map(Math.trunc);
    const patch = Array.from(
      { length: 12 * 12 },
      (_, i) => data[4 * ((top + Math.floor(i / 12)) * width + left + (i % 12))],
    );
    return [...new Set(patch)].sort((a, b) => a - b);
  }, position);
  const jumps = reds.filter((red, i) => i > 0 && red - reds[i - 1] > 8);
  assert.ok(jumps.length === 1 && reds.length < 6, `${reds}`);
  await viewer.press("s");
});

test("measure gives the distance of two clicked points", async () => {
  await viewer.press("m");
  const [a, b] = [await viewer.visiblePoint("base"), await viewer.visiblePoint("eyepiece")];
  await viewer.page.mouse.click(a.x, a.y);
  await viewer.page.mouse.click(b.x, b.y);
  await viewer.idle();
  const label = await viewer.page.locator("#measure-label").innerText();
  const distance = Number(/([\d.]+) mm/.exec(label)![1]);
  assert.ok(distance > 200 && distance < 450, label);
  assert.deepEqual(await viewer.selection(), []);
  await viewer.press("Escape");
  assert.equal(await viewer.page.isVisible("#measure-label"), false);
});

test("a screenshot is a PNG", async () => {
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.page.click("#screenshot")]);
  const bytes = readFileSync((await download.path())!);
  assert.equal(download.suggestedFilename(), "microscope.png");
  assert.equal(bytes.subarray(1, 4).toString(), "PNG");
  assert.ok(bytes.length > 5000, `${bytes.length}`);
});

/// Centre of a component's box on the page.
const centerOf = (component: string) =>
  viewer.page.evaluate((name) => {
    const view = window.dismantle!.app.viewport.model!.components.find(({ raw }) => raw.name === name)!;
    const { min, max } = view.bounds();
    return window.dismantle!.project([(min.x + max.x) / 2, (min.y + max.y) / 2, (min.z + max.z) / 2]);
  }, component);

test("the gizmo's arrows move along an axis only, its rings rotate", async () => {
  await viewer.select(kSlide);
  await viewer.press("g", "f");
  const center = await centerOf(kSlide);
  await viewer.page.mouse.move(center.x + 70, center.y);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(center.x + 190, center.y - 30, { steps: 5 });
  await viewer.idle();
  await viewer.release();
  const [x, y, z] = await viewer.shift(kSlide);
  assert.ok(x > 3 && Math.abs(y) < 0.2 && Math.abs(z) < 0.2, `${[x, y, z]}`);

  await viewer.press("3", "f");
  const middle = await centerOf(kSlide);
  const onRing = (angle: number) => [middle.x + 58 * Math.cos(angle), middle.y - 58 * Math.sin(angle)] as const;
  await viewer.page.mouse.move(...onRing(0.7));
  await viewer.page.mouse.down();
  for (const angle of [0.75, 0.8, 0.85, 0.9]) await viewer.page.mouse.move(...onRing(angle));
  await viewer.idle();
  await viewer.release();
  const [, , , , turnX, turnY, turnZ] = (await viewer.state()).components[await viewer.index(kSlide)].pose!;
  // The rotation follows the pointer: 0.2 rad, less the first pixels that start the drag.
  assert.ok(turnZ > Math.sin(0.05) && turnZ < Math.sin(0.11), `${turnZ}`);
  assert.ok(Math.hypot(turnX, turnY) < 0.1 * Math.abs(turnZ), `${[turnX, turnY, turnZ]}`);
  await reset();
  await viewer.page.focus("#view");
  await viewer.press("g");
});

test("the help opens and closes", async () => {
  await viewer.press("h");
  assert.equal(await viewer.page.isVisible("#help-dialog"), true);
  await viewer.page.keyboard.press("Escape");
  assert.equal(await viewer.page.isVisible("#help-dialog"), false);
});

test("a clicked arrow of a free direction takes the component out along it", async () => {
  await viewer.select(kSlide);
  await viewer.press("d");
  await viewer.page.locator("#directions .direction.free").first().waitFor();
  const arrows = await viewer.page.evaluate(() => window.dismantle!.app.viewport.directions.arrows.length);
  assert.ok(arrows >= 2, `${arrows}`);
  const tip = await viewer.page.evaluate(() => {
    const { directions, rig } = window.dismantle!.app.viewport;
    const arrow = directions.arrows.find(({ direction }) => direction.x > 0.99)!;
    const end = arrow.point.clone().addScaledVector(arrow.direction, rig.pixelSize(arrow.point) * 50);
    return window.dismantle!.project(end.toArray());
  });
  await viewer.page.mouse.click(tip.x, tip.y);
  await viewer.page.waitForFunction(
    (i) => window.dismantle!.app.session.store.state!.components[i].removed,
    await viewer.index(kSlide),
  );
  await viewer.idle();
  assert.equal(await viewer.page.evaluate((n) => window.dismantle!.drawn(n), kSlide), false);
});

test("put back returns the component to its assembled position", async () => {
  await viewer.select(kSlide);
  await viewer.click("#put-back");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic === null);
  await viewer.idle();
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.equal(await viewer.page.evaluate((n) => window.dismantle!.drawn(n), kSlide), true);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
