// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import type { WebGLRenderer } from "three";
import { sourceFolder } from "./environment.ts";
import { viewer } from "./scene.ts";

export type Point = { x: number; y: number; z: number };
type Side = "left" | "right";

/// One of so many frames of the headset is drawn.
const kPicturePeriod = 5;

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

/// Gives a page a headset with two controllers, emulated by `iwer`.
export async function connectHeadset(page: Page): Promise<void> {
  await page.addInitScript(readFileSync(join(sourceFolder(), "web/node_modules/iwer/build/iwer.min.js"), "utf8"));
  await page.addInitScript(() => {
    const iwer = (window as unknown as { IWER: { XRDevice: new (config: object) => Device; metaQuest3: object } }).IWER;
    window.headset = new iwer.XRDevice(iwer.metaQuest3);
    window.headset.installRuntime({ forceInstall: true });
  });
}

/// Enters the headset. Every frame redraws its picture, which no test examines: it is kept small, and most are not drawn.
export async function enterHeadset(): Promise<void> {
  await viewer.page.click("#headset");
  await viewer.page.waitForFunction(() => window.dismantle!.app.headset.active);
  await viewer.page.evaluate((period) => {
    const { viewport } = window.dismantle!.app;
    Object.assign(viewport.canvas, { width: 160, height: 100 });
    const { renderer } = viewport as unknown as { renderer: WebGLRenderer };
    const render = renderer.render.bind(renderer);
    let count = 0;
    renderer.render = (scene, camera) => {
      if (!renderer.xr.isPresenting || count++ % period === 0) render(scene, camera);
    };
  }, kPicturePeriod);
  await frames(20);
}

/// Places a controller so that it points at a target.
export function aimHand(page: Page, side: Side, at: Point, target: Point): Promise<void> {
  const offset = { x: target.x - at.x, y: target.y - at.y, z: target.z - at.z };
  const length = Math.hypot(offset.x, offset.y, offset.z);
  // The rotation from -z, along which controllers point, to the offset.
  const [x, y, z] = [offset.x / length, offset.y / length, offset.z / length];
  const turn = { x: y, y: -x, z: 0, w: 1 - z };
  const size = Math.hypot(turn.x, turn.y, turn.w);
  const unit =
    size < 1e-9 ? { x: 0, y: 1, z: 0, w: 0 } : { x: turn.x / size, y: turn.y / size, z: 0, w: turn.w / size };
  return page.evaluate(
    ([hand, p, q]) => {
      const controller = window.headset.controllers[hand as Side];
      const [position, rotation] = [p as Point, q as Point & { w: number }];
      controller.position.set(position.x, position.y, position.z);
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

/// Waits for some frames of the headset.
export const frames = (count = 2 * kPicturePeriod) =>
  viewer.page.evaluate(async (n) => {
    for (let i = 0; i < n; ++i) await new Promise((resolve) => requestAnimationFrame(resolve));
  }, count);

/// A point on the upper side of a component, in the room, that is visible from a hand at offset `from`.
export const inRoom = (name: string, from: Point): Promise<Point> =>
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
        ray.origin.copy(point).add(offset as Point);
        ray.direction.copy(point).sub(ray.origin).normalize();
        const hit = viewport.castWorld(ray.clone().applyMatrix4(roomFromWorld.clone().invert()));
        if (hit?.component === index) return { x, y, z };
      }
      throw new Error(`${n} cannot be seen from there`);
    },
    [name, from] as const,
  );

const button = (id: string): Promise<Point> =>
  viewer.page.evaluate((name) => {
    const { x, y, z } = window.dismantle!.app.headset.panel.centerOf(name)!;
    return { x, y, z };
  }, id);

/// Scale of the scene: metres in the room for 1 mm.
export const scale = () => viewer.page.evaluate(() => window.dismantle!.app.headset.stage.matrix.getMaxScaleOnAxis());

export const kFront = { x: 0, y: 0.07, z: 0.25 };
export const plus = (a: Point, b: Point): Point => ({ x: a.x + b.x, y: a.y + b.y, z: a.z + b.z });

/// Points at a component with one hand and presses the trigger. Returns the hand's position.
export async function grabWith(side: "left" | "right", name: string, from = kFront): Promise<Point> {
  const there = await inRoom(name, from);
  const hand = plus(there, from);
  await aimHand(viewer.page, side, hand, there);
  await frames();
  await press(viewer.page, side, "trigger", 1);
  await frames();
  return hand;
}

/// Moves a hand without changing its direction.
export async function moveHand(side: "left" | "right", from: Point, by: Point, aim: Point): Promise<void> {
  for (let i = 1; i <= 8; ++i) {
    const part = { x: (by.x * i) / 8, y: (by.y * i) / 8, z: (by.z * i) / 8 };
    const at = plus(from, part);
    await aimHand(viewer.page, side, at, plus(at, aim));
    await frames(2);
  }
  await viewer.idle();
}

/// Waits until nothing is held.
export const waitForRelease = () =>
  viewer.page.waitForFunction(() => {
    const { drag, session } = window.dismantle!.app;
    return !drag.active && session.store.state!.hand === null;
  });

export async function releaseHand(side: "left" | "right"): Promise<void> {
  await press(viewer.page, side, "trigger", 0);
  await waitForRelease();
  await viewer.idle();
}

export const kAhead = { x: -kFront.x, y: -kFront.y, z: -kFront.z };

/// Grips the scene with both hands and doubles their distance.
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

/// Placement of the scene in the room.
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
