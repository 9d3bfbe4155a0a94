// SPDX-License-Identifier: Apache-2.0
// Assemblies that come as STEP files of the user's.
import assert from "node:assert/strict";
import { copyFileSync, existsSync } from "node:fs";
import { basename, join } from "node:path";
import { test } from "node:test";
import { audit, server, useViewer, viewer } from "../support/scene.ts";
import { sourceFolder } from "../support/tree.ts";

useViewer([], { waits: false });

const kShared = join(sourceFolder(), "../shared/data/assemblies/as1_oc_214/original/as1-oc-214.stp");

async function upload(file: string): Promise<void> {
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.page.waitForFunction((name) => window.dismantle!.app.session.store.model?.name === name, basename(file));
  await viewer.model();
}

/// The first component that has a free direction, and that.
function freeComponent(): Promise<{ name: string; direction: number[] }> {
  return viewer.page.evaluate(async () => {
    const { session } = window.dismantle!.app;
    for (const [i, { name }] of session.store.model!.components.entries()) {
      const answer = await session.ask("free_directions", { components: [i] });
      const way = answer?.directions.find(({ free }) => free);
      if (way) return { name, direction: way.direction };
    }
    throw new Error("nothing is free");
  });
}

/// Moves a component by numbers along a direction that is free, then takes it out and puts it back.
async function takeApart(): Promise<void> {
  const { name, direction } = await freeComponent();
  await viewer.select(name);
  for (const k of [0, 1, 2]) await viewer.page.fill(`#numeric-${k}`, String(12 * direction[k]));
  await viewer.click("#numeric-apply");
  const shift = await viewer.shift(name);
  const along = shift.reduce((sum, value, k) => sum + value * direction[k], 0);
  assert.ok(Math.abs(along - 12) < 0.05, `${name} ${shift} ${direction}`);
  assert.deepEqual(await viewer.drawnShift(name), shift);
  await viewer.takeOut(name);
  await viewer.select(name);
  await viewer.click("#put-back");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic === null);
  await viewer.idle();
  assert.ok(Math.hypot(...(await viewer.shift(name))) < 1e-9);
  await audit();
}

test("a sample sent as a STEP file is opened and taken apart", async () => {
  const file = join(server.home, "mine.step");
  copyFileSync(server.fileOf("microscope.step"), file);
  await upload(file);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 41);
  await takeApart();
});

test("so is a STEP file that nobody of the project wrote", async (t) => {
  if (!existsSync(kShared)) return t.skip("../shared/data is not here");
  const file = join(server.home, basename(kShared));
  copyFileSync(kShared, file);
  await upload(file);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 18);
  await takeApart();
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
