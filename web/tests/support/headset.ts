// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { viewer } from "./scene.ts";
import { sourceFolder } from "./tree.ts";

export type Place = { x: number; y: number; z: number };
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

/// Some pictures in the headset.
export const frames = (count = 3) =>
  viewer.page.evaluate(async (n) => {
    for (let i = 0; i < n; ++i) await new Promise((resolve) => requestAnimationFrame(resolve));
  }, count);

/// A place in the room: of a component's upper side, one that a hand that is `from` away from it sees.
export const inRoom = (name: string, from: Place): Promise<Place> =>
  viewer.page.evaluate(
    ([n, offset]) => {
      const { headset, viewport } = window.dismantle!.app;
      const { index, bounds } = viewport
        .model!.components.map((view) => ({ index: view.index, name: view.raw.name, bounds: view.bounds() }))
        .find((candidate) => candidate.name === n)!;
      const roomFromWorld = headset.stage.matrix;
      const { ray } = headset.hands[0];
      for (let part = 0.05; part < 1; part += 0.05) {
        const point = bounds.min.clone().lerp(bounds.max, 0.5);
        point.x = bounds.min.x + part * (bounds.max.x - bounds.min.x);
        point.z = bounds.max.z;
        const { x, y, z } = point.applyMatrix4(roomFromWorld);
        ray.origin.copy(point).add(offset as Place);
        ray.direction.copy(point).sub(ray.origin).normalize();
        const hit = viewport.castWorld(ray.clone().applyMatrix4(roomFromWorld.clone().invert()));
        if (hit?.component === index) return { x, y, z };
      }
      throw new Error(`${n} cannot be seen from there`);
    },
    [name, from] as const,
  );

const button = (id: string): Promise<Place> =>
  viewer.page.evaluate((name) => {
    const { x, y, z } = window.dismantle!.app.headset.panel.centerOf(name)!;
    return { x, y, z };
  }, id);

/// Metres of the room for a millimetre of the world.
export const scale = () => viewer.page.evaluate(() => window.dismantle!.app.headset.stage.matrix.getMaxScaleOnAxis());

export const kFront = { x: 0, y: 0.07, z: 0.25 };
export const plus = (a: Place, b: Place): Place => ({ x: a.x + b.x, y: a.y + b.y, z: a.z + b.z });

/// Points from above with one hand and presses the trigger. Gives where the hand is.
export async function take(side: "left" | "right", name: string, from = kFront): Promise<Place> {
  const there = await inRoom(name, from);
  const hand = plus(there, from);
  await aimHand(viewer.page, side, hand, there);
  await frames();
  await press(viewer.page, side, "trigger", 1);
  await frames();
  return hand;
}

/// Moves a hand that points as before.
export async function carry(side: "left" | "right", from: Place, by: Place, aim: Place): Promise<void> {
  for (let i = 1; i <= 8; ++i) {
    const part = { x: (by.x * i) / 8, y: (by.y * i) / 8, z: (by.z * i) / 8 };
    const at = plus(from, part);
    await aimHand(viewer.page, side, at, plus(at, aim));
    await frames(2);
  }
  await viewer.idle();
}

/// Until nothing is in hand any more.
export const handsEmpty = () =>
  viewer.page.waitForFunction(() => {
    const { drag, session } = window.dismantle!.app;
    return !drag.active && session.store.state!.hand === null;
  });

export async function letGo(side: "left" | "right"): Promise<void> {
  await press(viewer.page, side, "trigger", 0);
  await handsEmpty();
  await viewer.idle();
}

export const kAhead = { x: -kFront.x, y: -kFront.y, z: -kFront.z };

/// Both hands grip the room, and are pulled apart to twice as far.
export async function pullApart(): Promise<void> {
  const at = (x: number, z: number) => ({ x, y: 1.2, z });
  await aimHand(viewer.page, "left", at(-0.1, -0.3), at(-0.1, -1.3));
  await aimHand(viewer.page, "right", at(0.1, -0.3), at(0.1, -1.3));
  await frames();
  for (const side of ["left", "right"] as const) await press(viewer.page, side, "squeeze", 1);
  await frames();
  await aimHand(viewer.page, "right", at(0.3, -0.3), at(0.3, -1));
  await frames();
  for (const side of ["left", "right"] as const) await press(viewer.page, side, "squeeze", 0);
}

/// Where the scene stands in the room.
export const stage = () => viewer.page.evaluate(() => window.dismantle!.app.headset.stage.matrix.toArray());

/// Points with the right hand at a button of the panel on the left wrist, and presses the trigger.
export async function pressOnWrist(id: string): Promise<void> {
  await aimHand(viewer.page, "left", { x: -0.25, y: 1.2, z: -0.3 }, { x: -0.25, y: 1.2, z: -1 });
  await frames();
  const there = await button(id);
  await aimHand(viewer.page, "right", plus(there, { x: 0.1, y: 0.1, z: 0.25 }), there);
  await frames();
  await press(viewer.page, "right", "trigger", 1);
  await frames();
  await press(viewer.page, "right", "trigger", 0);
  await frames();
}
