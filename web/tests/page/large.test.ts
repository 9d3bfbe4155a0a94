// SPDX-License-Identifier: Apache-2.0
// A model as large as should stay fluid on an ordinary laptop. Draw calls are checked; render times are printed only,
// since tests render in software.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { ballsGlb } from "../support/large_glb.ts";
import { dragView, server, useViewer, viewer } from "../support/scene.ts";

const kComponents = 300;
const { bytes, triangles } = ballsGlb(kComponents, 23);
useViewer([], { waits: false, prepare: open });

async function open(): Promise<void> {
  const file = join(server.home, "balls.glb");
  writeFileSync(file, bytes);
  await viewer.page.setInputFiles("#file-picker", file);
  await viewer.model();
  await count();
}

/// The cost of a render.
interface RenderCost {
  calls: number;
  triangles: number;
  milliseconds: number;
}
const renders = () => viewer.page.evaluate(() => (window as unknown as { renders: RenderCost[] }).renders);

/// Records the cost of all renders from now on.
function count(): Promise<void> {
  return viewer.page.evaluate(() => {
    const { viewport } = window.dismantle!.app;
    const counted: RenderCost[] = [];
    viewport.afterRender.add(() => counted.push({ ...viewport.cost }));
    Object.assign(window, { renders: counted });
  });
}

/// The costs of the renders during an action.
async function rendersDuring(act: () => Promise<void>): Promise<RenderCost[]> {
  const { length } = await renders();
  await act();
  return (await renders()).slice(length);
}

const orbit = () => dragView("right", { x: 400, y: 250 }, 60, 30);

test("300 components of 600,000 triangles are drawn with few draw calls", async (t) => {
  assert.ok(triangles >= 600_000, `${triangles}`);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), kComponents);
  const drawn = await rendersDuring(orbit);
  const times = drawn.map(({ milliseconds }) => milliseconds).sort((a, b) => a - b);
  assert.ok(drawn.length > 0);
  for (const { calls, triangles: seen } of drawn) {
    assert.ok(calls < 16, `${calls} calls`); // four of them for the axes in the corner
    assert.ok(seen >= triangles, `${seen} triangles`);
  }
  const [median, max] = [times[times.length >> 1], times[times.length - 1]];
  t.diagnostic(`${drawn[0].calls} calls; page thread ${median.toFixed(1)} ms a render (maximum ${max.toFixed(1)} ms)`);
  assert.ok(median < 100, `${median} ms`);
});

test("a moving component adds few draw calls, and nothing is rendered without changes", async (t) => {
  await viewer.press("1", "f");
  const still = (await rendersDuring(orbit))[0].calls;
  await viewer.press("1", "f");
  const drawn = await rendersDuring(() => viewer.grab("ball 1", -20, 0, 3));
  const max = Math.max(...drawn.map(({ calls }) => calls));
  t.diagnostic(`${max} calls while a component is moved, ${still} while none is`);
  assert.ok(max < still + 10, `${max} ${still}`);
  await viewer.release();
  assert.ok((await viewer.shift("ball 1"))[0] < -1, `${await viewer.shift("ball 1")}`);
  const idle = await rendersDuring(() => viewer.page.waitForTimeout(1500));
  assert.equal(idle.length, 0);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
