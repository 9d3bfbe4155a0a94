// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { connectDevices, deflect, pushStick } from "../support/devices.ts";
import { kSlide, useMicroscope, viewer, waitForEmptyHand, waitForRemoved } from "../support/scene.ts";

useMicroscope({ view: "1", before: connectDevices });

test("with nothing selected the 3D mouse moves the view", async () => {
  const distance = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.current.distance);
  const start = await distance();
  await deflect(0, -350, 0, 0, 0, 0);
  await viewer.page.waitForFunction((d) => window.dismantle!.app.viewport.rig.current.distance > 1.1 * d, start);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.press("f");
  assert.equal((await viewer.state()).moves.length, 0);
});

test("the 3D mouse moves the selection, which stops at contact; one undo entry", async () => {
  await viewer.select(kSlide);
  await deflect(100, 0, 120, 0, 0, 0); // right, and down onto the stage
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 10, kSlide);
  await deflect(0, 0, 0, 0, 0, 0);
  await waitForEmptyHand();
  await viewer.idle();
  const [x, , z] = await viewer.shift(kSlide);
  assert.ok(x > 10 && Math.abs(z) < 0.2, `${x} ${z}`);
  assert.equal((await viewer.state()).moves.length, 1);
});

test("a component pressed against a wall by a device is reported with its blocker and free directions, and N finds a path", async () => {
  await deflect(0, 0, 200, 0, 0, 0);
  await viewer.page
    .locator("[data-banner=stuck]", { hasText: /Blocked by stage plate; free: .*N: find a path/ })
    .waitFor();
  assert.ok((await viewer.page.locator("#tree-panel .badge.blocks").count()) > 0);
  const marks = await viewer.page.evaluate(() => {
    const { contacts, directions } = window.dismantle!.app.viewport;
    return [contacts.arrows.length, directions.arrows.length];
  });
  assert.ok(
    marks.every((count) => count > 0),
    `${marks}`,
  );
  await viewer.page.keyboard.press("n");
  await waitForRemoved(kSlide);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.idle();
  while ((await viewer.state()).moves.length > 1) await viewer.press("Control+z");
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.viewport.contacts.arrows.length), 0);
});

test("a gamepad moves the selection, too", async () => {
  const start = await viewer.shift(kSlide);
  await pushStick(-0.5);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] < (x as number) - 5,
    [kSlide, start[0]],
  );
  await pushStick(0);
  await waitForEmptyHand();
  await viewer.idle();
  assert.equal((await viewer.state()).moves.length, 2);
});

test("Esc during the motion returns to its start", async () => {
  const [start] = await viewer.shift(kSlide);
  await deflect(300, 0, 0, 0, 0, 0);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] > (x as number) + 3,
    [kSlide, start],
  );
  await viewer.page.keyboard.press("Escape");
  await waitForEmptyHand();
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.idle();
  assert.equal((await viewer.shift(kSlide))[0], start);
});
