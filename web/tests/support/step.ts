// SPDX-License-Identifier: Apache-2.0
// Assemblies that come as STEP files of the user's, and a component of each with which tests do what others do in a sample.
import assert from "node:assert/strict";
import { copyFileSync, existsSync } from "node:fs";
import { basename, join } from "node:path";
import { server, viewer } from "./scene.ts";
import { sourceFolder } from "./tree.ts";

/// One that nobody of the project wrote: a plate, two brackets, a rod, bolts and nuts.
export const kOfOthers = "../shared/data/assemblies/as1_oc_214/original/as1-oc-214.stp";
export const isThere = (file: string): boolean => existsSync(join(sourceFolder(), file));

export type Way = [number, number, number];

/// A component that can be taken hold of from one side: a way that is free for it, and across it one that is blocked at once.
export interface Case {
  name: string;
  free: Way;
  blocked: Way;
}

/// What `choose` looked for.
export let chosen: Case;

async function upload(file: string): Promise<void> {
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.page.waitForFunction((name) => window.dismantle!.app.session.store.model?.name === name, basename(file));
  await viewer.model();
}

/// What is free for a component and what is not; looks at it from where both ways lie across the line of sight.
export function lookAt(name: string): Promise<Case> {
  return viewer.page.evaluate(async (wanted) => {
    const { session, viewport } = window.dismantle!.app;
    const { components } = session.store.model!;
    const index = components.findIndex((component) => component.name === wanted);
    const ways = (await session.ask("free_directions", { components: [index] }))!.directions;
    const axis = (way: number[]) => way.findIndex((value) => Math.abs(value) > 0.9999);
    const free = ways.find((way) => way.free && axis(way.direction) >= 0)?.direction;
    const isWay = (at: number) => ways.some(({ direction }) => axis(direction) === at);
    for (const across of [0, 1, 2].filter((k) => free && k !== axis(free) && !isWay(k))) {
      const third = [0, 1, 2].find((k) => k !== axis(free!) && k !== across)!;
      for (const sign of [-1, 1]) {
        const box = viewport.model!.components[index].bounds();
        viewport.rig.fit(box.expandByScalar(0.6 * box.max.distanceTo(box.min)));
        viewport.rig.lookFrom(viewport.rig.axis("back").set(0, 0, 0).setComponent(third, sign));
        await window.dismantle!.idle();
        const blocked: Way = [0, 0, 0];
        blocked[across] = 1;
        if (window.dismantle!.placeOf(wanted)) return { name: wanted, free: free!, blocked };
      }
    }
    throw new Error(`${wanted} cannot be taken hold of: ${JSON.stringify(ways)}`);
  }, name);
}

/// The way of the pointer for ways of the chosen component along what is free and what is blocked [px].
export function pointerWay(along: number, across: number): Promise<[number, number]> {
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
      const [p, q] = [window.dismantle!.project(from as Way), window.dismantle!.project(to as Way)];
      return [q.x - p.x, q.y - p.y];
    },
    [chosen, along, across] as const,
  );
}

export const grab = async (along: number, across: number) =>
  viewer.grab(chosen.name, ...(await pointerWay(along, across)));
/// How far the engine has the component along a way [mm].
export const gone = async (way: Way) =>
  (await viewer.shift(chosen.name)).reduce((sum, value, k) => sum + value * way[k], 0);
export const drawnAsInEngine = async () =>
  assert.deepEqual(await viewer.drawnShift(chosen.name), await viewer.shift(chosen.name));
export const isRemoved = (removed: boolean) =>
  viewer.page.waitForFunction(
    ([name, wanted]) => {
      const { model, state } = window.dismantle!.app.session.store;
      const index = model!.components.findIndex((c) => c.name === name);
      return state!.automatic === null && Boolean(state!.components[index].removed) === wanted;
    },
    [chosen.name, removed] as const,
  );
export const isDrawn = () => viewer.page.evaluate((n) => window.dismantle!.drawn(n), chosen.name);

/// Has the other functions be about this component, and looks at it.
export async function choose(name: string): Promise<void> {
  chosen = await lookAt(name);
}

/// Sends an assembly of the tree or beside it, and chooses one of its components. Gives where the server finds it.
export async function send(from: string, components: number, name: string): Promise<string> {
  const file = join(server.home, basename(from));
  copyFileSync(join(sourceFolder(), from), file);
  await upload(file);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), components);
  await choose(name);
  return file;
}
