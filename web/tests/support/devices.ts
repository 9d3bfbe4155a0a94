// SPDX-License-Identifier: Apache-2.0
import type { Page } from "playwright-core";
import { viewer } from "./scene.ts";
import { kSpaceMouse } from "./space_mouse.ts";

/// Gives a page a 3D mouse and a gamepad, which do what `deflect` and `pushStick` say.
export async function connectDevices(page: Page): Promise<void> {
  await page.addInitScript(fakeMouse, kSpaceMouse);
  await page.addInitScript(fakePad);
}

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

/// The six axes of the 3D mouse, as its report has them.
export const deflect = (...axes: number[]) =>
  viewer.page.evaluate(
    (values) => (window as unknown as { sendReport: (...v: number[]) => void }).sendReport(...values),
    axes,
  );

/// How far the gamepad's left stick is to the right.
export const pushStick = (x: number) =>
  viewer.page.evaluate((value) => {
    Object.assign(window, { pushed: value });
    window.dispatchEvent(new Event("gamepadconnected"));
  }, x);
