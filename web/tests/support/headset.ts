// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { sourceFolder } from "./tree.ts";

type Place = { x: number; y: number; z: number };
type Side = "left" | "right";

interface Controller {
  position: { set(x: number, y: number, z: number): void };
  quaternion: { set(x: number, y: number, z: number, w: number): void };
  updateButtonValue(button: string, value: number): void;
}

interface Device {
  controllers: Record<Side, Controller>;
  position: { set(x: number, y: number, z: number): void };
  installRuntime(options: { forceInstall: boolean }): void;
}

declare global {
  interface Window {
    headset: Device;
  }
}

/// Gives a page a headset with two controllers: `iwer`, which speaks WebXR as a browser does, and moves as a test says.
export async function wearHeadset(page: Page): Promise<void> {
  await page.addInitScript(readFileSync(join(sourceFolder(), "web/node_modules/iwer/build/iwer.min.js"), "utf8"));
  await page.addInitScript(() => {
    const iwer = (window as unknown as { IWER: { XRDevice: new (config: object) => Device; metaQuest3: object } }).IWER;
    window.headset = new iwer.XRDevice(iwer.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
  });
}

/// A controller at a place, pointing at another one.
export function aimHand(page: Page, side: Side, at: Place, target: Place): Promise<void> {
  const way = { x: target.x - at.x, y: target.y - at.y, z: target.z - at.z };
  const long = Math.hypot(way.x, way.y, way.z);
  // From -z, as a controller points, onto the way: the half-way rotation.
  const [x, y, z] = [way.x / long, way.y / long, way.z / long];
  const turn = { x: y, y: -x, z: 0, w: 1 - z };
  const size = Math.hypot(turn.x, turn.y, turn.w);
  const unit =
    size < 1e-9 ? { x: 0, y: 1, z: 0, w: 0 } : { x: turn.x / size, y: turn.y / size, z: 0, w: turn.w / size };
  return page.evaluate(
    ([hand, p, q]) => {
      const controller = window.headset.controllers[hand as Side];
      const [place, rotation] = [p as Place, q as Place & { w: number }];
      controller.position.set(place.x, place.y, place.z);
      controller.quaternion.set(rotation.x, rotation.y, rotation.z, rotation.w);
    },
    [side, at, unit] as const,
  );
}

export function press(page: Page, side: Side, button: "trigger" | "squeeze", value: 0 | 1): Promise<void> {
  return page.evaluate(
    ([hand, name, amount]) =>
      window.headset.controllers[hand as Side].updateButtonValue(name as string, amount as number),
    [side, button, value] as const,
  );
}
