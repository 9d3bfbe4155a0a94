// SPDX-License-Identifier: Apache-2.0
// STEP assemblies of users, each with a component on which the gestures are tested.
import assert from "node:assert/strict";
import { copyFileSync, existsSync } from "node:fs";
import { basename, join } from "node:path";
import { sourceFolder } from "./environment.ts";
import { server, viewer, waitForRemoved } from "./scene.ts";

/// A third-party assembly: a plate, two brackets, a rod, bolts and nuts.
export const kThirdParty = "../shared/data/assemblies/as1_oc_214/original/as1-oc-214.stp";
/// True if a file of the source folder exists. Throws if not and DISMANTLE_REQUIRE_DATA is set: no test may skip then.
export function isPresent(file: string): boolean {
  const present = existsSync(join(sourceFolder(), file));
  assert.ok(present || !process.env.DISMANTLE_REQUIRE_DATA, `DISMANTLE_REQUIRE_DATA is set, and there is no ${file}`);
  return present;
}

/// A direction or a position, world frame.
export type Direction = [number, number, number];

/// A component that can be grabbed, with a free direction and a perpendicular one that is blocked at once.
export interface Case {
  name: string;
  free: Direction;
  blocked: Direction;
}

/// The component set by `choose`.
export let chosen: Case;

async function upload(file: string): Promise<void> {
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.page.waitForFunction((name) => window.dismantle!.app.session.store.model?.name === name, basename(file));
  await viewer.model();
}

/// Finds a free and a blocked direction of a component, and a view in which both are perpendicular to the line of
/// sight.
export function lookAt(name: string): Promise<Case> {
  return viewer.page.evaluate(async (wanted) => {
    const { session, viewport } = window.dismantle!.app;
    const { components } = session.store.model!;
    const index = components.findIndex((component) => component.name === wanted);
    const directions = (await session.send("free_directions", { components: [index] }))!.directions;
    const axis = (direction: number[]) => direction.findIndex((value) => Math.abs(value) > 0.9999);
    const free = directions.find(({ free, direction }) => free && axis(direction) >= 0)?.direction;
    const isAxis = (at: number) => directions.some(({ direction }) => axis(direction) === at);
    for (const across of [0, 1, 2].filter((k) => free && k !== axis(free) && !isAxis(k))) {
      const third = [0, 1, 2].find((k) => k !== axis(free!) && k !== across)!;
      for (const sign of [-1, 1]) {
        const box = viewport.model!.components[index].bounds();
        viewport.rig.fit(box.expandByScalar(0.6 * box.max.distanceTo(box.min)));
        viewport.rig.lookFrom(viewport.rig.axis("back").set(0, 0, 0).setComponent(third, sign));
        await window.dismantle!.idle();
        const blocked: Direction = [0, 0, 0];
        blocked[across] = 1;
        if (window.dismantle!.visiblePoint(wanted)) return { name: wanted, free: free!, blocked };
      }
    }
    throw new Error(`${wanted} cannot be grabbed: ${JSON.stringify(directions)}`);
  }, name);
}

/// Pointer offset for an offset of the chosen component along its free and its blocked direction [px].
export function pointerOffset(along: number, across: number): Promise<[number, number]> {
  return viewer.page.evaluate(
    ([{ name, free, blocked }, a, b]) => {
      const { rig, model } = window.dismantle!.app.viewport;
      const { min, max } = model!.components.find(({ raw }) => raw.name === name)!.bounds();
      const center = min.clone().lerp(max, 0.5);
      const pixel = rig.pixelSize(center);
      const [from, to] = [
        center.toArray(),
        center.toArray().map((value, k) => value + pixel * (a * free[k] + b * blocked[k])),
      ];
      const [p, q] = [window.dismantle!.project(from as Direction), window.dismantle!.project(to as Direction)];
      return [q.x - p.x, q.y - p.y];
    },
    [chosen, along, across] as const,
  );
}

/// Drags the chosen component by an offset along its free and its blocked direction [px].
export const grab = async (along: number, across: number) =>
  viewer.grab(chosen.name, ...(await pointerOffset(along, across)));
/// Travel of the chosen component along a direction, in the engine [mm].
export const travel = async (direction: Direction) =>
  (await viewer.shift(chosen.name)).reduce((sum, value, k) => sum + value * direction[k], 0);
/// Asserts that the chosen component is drawn at the engine's position.
export const drawnAsInEngine = async () =>
  assert.deepEqual(await viewer.drawnShift(chosen.name), await viewer.shift(chosen.name));
/// Waits until it is removed, or put back.
export const chosenRemoved = (removed: boolean) => waitForRemoved(chosen.name, removed);
/// True if the chosen component is visible.
export const isDrawn = () => viewer.page.evaluate((n) => window.dismantle!.drawn(n), chosen.name);

/// Chooses the component for the other functions, and looks at it.
export async function choose(name: string): Promise<void> {
  chosen = await lookAt(name);
}

/// Uploads an assembly and chooses one of its components. Returns its path on the server.
export async function send(from: string, components: number, name: string): Promise<string> {
  const file = join(server.home, basename(from));
  copyFileSync(join(sourceFolder(), from), file);
  await upload(file);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), components);
  await choose(name);
  return file;
}
