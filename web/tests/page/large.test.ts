// SPDX-License-Identifier: Apache-2.0
// As many components and triangles as are to stay fluid on an ordinary laptop: what a picture asks of the page is counted here, and
// what it takes is printed (the pictures themselves are drawn in software where the tests run).
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { ballsGlb } from "../support/large_glb.ts";
import { server, useViewer, viewer } from "../support/scene.ts";

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

/// What a picture cost.
interface Picture {
  calls: number;
  triangles: number;
  milliseconds: number;
}
const pictures = () => viewer.page.evaluate(() => (window as unknown as { pictures: Picture[] }).pictures);

/// Counts all pictures from now on.
function count(): Promise<void> {
  return viewer.page.evaluate(() => {
    const { viewport } = window.dismantle!.app;
    const counted: Picture[] = [];
    viewport.afterPicture.add(() => counted.push({ ...viewport.cost }));
    Object.assign(window, { pictures: counted });
  });
}

/// What the pictures cost that are drawn while something is done.
async function picturesOf(act: () => Promise<void>): Promise<Picture[]> {
  const { length } = await pictures();
  await act();
  return (await pictures()).slice(length);
}

const turn = async () => {
  await viewer.page.mouse.move(400, 250);
  await viewer.page.mouse.down({ button: "right" });
  await viewer.page.mouse.move(460, 280, { steps: 4 });
  await viewer.page.mouse.up({ button: "right" });
  await viewer.idle();
};

test("300 components of 600,000 triangles are drawn with a few calls", async (t) => {
  assert.ok(triangles >= 600_000, `${triangles}`);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), kComponents);
  const drawn = await picturesOf(turn);
  const times = drawn.map(({ milliseconds }) => milliseconds).sort((a, b) => a - b);
  assert.ok(drawn.length > 0);
  for (const { calls, triangles: seen } of drawn) {
    assert.ok(calls < 12, `${calls} calls`);
    assert.ok(seen >= triangles, `${seen} triangles`);
  }
  const [median, most] = [times[times.length >> 1], times[times.length - 1]];
  t.diagnostic(
    `${drawn[0].calls} calls; the page is kept ${median.toFixed(1)} ms a picture (at most ${most.toFixed(1)} ms)`,
  );
  assert.ok(median < 100, `${median} ms`);
});

test("a component that moves costs no more calls, and where nothing changes nothing is drawn", async (t) => {
  await viewer.press("1", "f");
  const still = (await picturesOf(turn))[0].calls;
  await viewer.press("1", "f");
  const drawn = await picturesOf(() => viewer.grab("ball 1", -20, 0, 3));
  const most = Math.max(...drawn.map(({ calls }) => calls));
  t.diagnostic(`${most} calls while a component is moved, ${still} while none is`);
  assert.ok(most < still + 10, `${most} ${still}`);
  await viewer.letGo();
  assert.ok((await viewer.shift("ball 1"))[0] < -1, `${await viewer.shift("ball 1")}`);
  const idle = await picturesOf(() => viewer.page.waitForTimeout(1500));
  assert.equal(idle.length, 0);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
