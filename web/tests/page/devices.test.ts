// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";
import { kSpaceMouse } from "../support/space_mouse.ts";

useMicroscope({
  view: "1",
  before: async (page) => {
    await page.addInitScript(fakeMouse, kSpaceMouse);
    await page.addInitScript(fakePad);
  },
});

/// A 3D mouse whose reports the test writes.
function fakeMouse(collections: object): void {
  const device = Object.assign(new EventTarget(), {
    opened: false,
    productName: "SpaceMouse",
    collections,
    async open() {
      device.opened = true;
    },
  });
  const hid = Object.assign(new EventTarget(), {
    getDevices: async () => [device],
    requestDevice: async () => [device],
  });
  Object.defineProperty(navigator, "hid", { value: hid });
  Object.assign(window, {
    sendReport: (...axes: number[]) => {
      const data = new DataView(Int16Array.from(axes).buffer);
      device.dispatchEvent(Object.assign(new Event("inputreport"), { reportId: 1, data }));
    },
  });
}

/// A gamepad whose left stick is as far to the right as the test says.
function fakePad(): void {
  const buttons = Array.from({ length: 17 }, () => ({ value: 0 }));
  const pad = () => ({
    mapping: "standard",
    axes: [(window as unknown as { pushed: number }).pushed ?? 0, 0, 0, 0],
    buttons,
  });
  Object.defineProperty(navigator, "getGamepads", { value: () => [pad()] });
}

const deflect = (...axes: number[]) =>
  viewer.page.evaluate(
    (values) => (window as unknown as { sendReport: (...v: number[]) => void }).sendReport(...values),
    axes,
  );

test("with nothing selected the 3D mouse moves the view", async () => {
  const distance = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.rig.current.distance);
  const start = await distance();
  await deflect(0, -350, 0, 0, 0, 0);
  await viewer.page.waitForFunction((d) => window.dismantle!.app.viewport.rig.current.distance > 1.1 * d, start);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.press("f");
  assert.equal((await viewer.state()).moves.length, 0);
});

test("what is selected moves with it, stops at contact, and is one entry of undo", async () => {
  await viewer.select(kSlide);
  await deflect(100, 0, 120, 0, 0, 0); // right, and down onto the stage
  await viewer.page.waitForFunction((name) => window.dismantle!.drawnMatrix(name)[12] > 10, kSlide);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);
  await viewer.idle();
  const [x, , z] = await viewer.shift(kSlide);
  assert.ok(x > 10 && Math.abs(z) < 0.2, `${x} ${z}`);
  assert.equal((await viewer.state()).moves.length, 1);
});

test("a gamepad moves it, too", async () => {
  const start = await viewer.shift(kSlide);
  const push = (x: number) =>
    viewer.page.evaluate((value) => {
      Object.assign(window, { pushed: value });
      window.dispatchEvent(new Event("gamepadconnected"));
    }, x);
  await push(-0.5);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] < (x as number) - 5,
    [kSlide, start[0]],
  );
  await push(0);
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);
  await viewer.idle();
  assert.equal((await viewer.state()).moves.length, 2);
});

test("Esc in mid-motion goes back", async () => {
  const [start] = await viewer.shift(kSlide);
  await deflect(300, 0, 0, 0, 0, 0);
  await viewer.page.waitForFunction(
    ([name, x]) => window.dismantle!.drawnMatrix(name as string)[12] > (x as number) + 3,
    [kSlide, start],
  );
  await viewer.page.keyboard.press("Escape");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);
  await deflect(0, 0, 0, 0, 0, 0);
  await viewer.idle();
  assert.equal((await viewer.shift(kSlide))[0], start);
});
