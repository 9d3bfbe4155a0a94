// SPDX-License-Identifier: Apache-2.0
import type { Page } from "playwright-core";
import { viewer } from "./scene.ts";
import { kSpaceMouse } from "./space_mouse.ts";

/// Gives a page a fake 3D mouse and a fake gamepad, driven by `deflect` and `pushStick`.
export async function connectDevices(page: Page): Promise<void> {
  await page.addInitScript(fakeMouse, kSpaceMouse);
  await page.addInitScript(fakePad);
}

/// A 3D mouse whose reports the test sends.
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

/// A gamepad whose left stick the test moves.
function fakePad(): void {
  const buttons = Array.from({ length: 17 }, () => ({ value: 0 }));
  const pad = () => ({
    mapping: "standard",
    axes: [(window as unknown as { pushed: number }).pushed ?? 0, 0, 0, 0],
    buttons,
  });
  Object.defineProperty(navigator, "getGamepads", { value: () => [pad()] });
}

/// Sends the six axes of the 3D mouse.
export const deflect = (...axes: number[]) =>
  viewer.page.evaluate(
    (values) => (window as unknown as { sendReport: (...v: number[]) => void }).sendReport(...values),
    axes,
  );

/// Moves the gamepad's left stick to the right.
export const pushStick = (x: number) =>
  viewer.page.evaluate((value) => {
    Object.assign(window, { pushed: value });
    window.dispatchEvent(new Event("gamepadconnected"));
  }, x);
