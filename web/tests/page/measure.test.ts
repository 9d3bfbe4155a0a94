// SPDX-License-Identifier: Apache-2.0
// Measuring with snapping, and sections by number and by face, on parts of known sizes.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { holedPlate } from "../support/plate.ts";
import { useViewer, viewer } from "../support/scene.ts";

useViewer([], {
  waits: false,
  prepare: async () => {
    await viewer.page.setInputFiles("#file-picker", {
      name: "plate.obj",
      mimeType: "text/plain",
      buffer: Buffer.from(
        holedPlate({
          sides: [60, 40, 10],
          holes: [
            [15, 20],
            [45, 20],
          ],
          diameter: 12,
        }),
      ),
    });
    await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model?.name === "plate.obj");
    await viewer.model();
  },
});
beforeEach(async () => {
  await viewer.page.focus("#view");
  await viewer.press("Escape", "3", "f");
});

type Point = [number, number, number];
const label = () => viewer.page.locator("#measure-label").innerText();
async function click(point: Point): Promise<void> {
  const at = await viewer.page.evaluate((p) => window.dismantle!.project(p), point);
  await viewer.page.mouse.click(at.x, at.y);
  await viewer.idle();
}

test("an edge has its length, a hole its diameter, and two holes their distance", async () => {
  await viewer.press("m");
  await click([30, 0.1, 10]);
  assert.match(await label(), /^Edge 60\.00 mm\./);
  await viewer.press("m", "m");
  await click([15 - 6.1, 20, 10]);
  assert.match(await label(), /^Diameter 12\.00 mm\./);
  await click([45 + 6.1, 20, 10]);
  assert.match(await label(), /^30\.00 mm \(x 30\.00, y 0\.00, z 0\.00\)$/);
  await viewer.press("m");
});

test("the cursor snaps to a corner", async () => {
  await viewer.press("m");
  await click([0.3, 0.3, 10]);
  assert.match(await label(), /^Point x 0\.00, y 0\.00, z 10\.00\./);
  await click([59.7, 39.7, 10]);
  assert.match(await label(), /^72\.11 mm \(x 60\.00, y 40\.00, z 0\.00\)$/);
  await viewer.press("m");
});

test("two faces have their distance, or their angle", async () => {
  await viewer.press("m");
  await click([30, 30, 10]);
  assert.match(await label(), /^Flat face\./);
  await viewer.press("6");
  await click([30, 30, 0]);
  assert.match(await label(), /^10\.00 mm/);
  await viewer.press("1");
  await click([30, 0, 5]);
  await viewer.press("3");
  await click([30, 30, 10]);
  assert.match(await label(), /angle 90\.0°$/);
  await viewer.press("m");
});

test("what a click would pick is outlined before it", async () => {
  await viewer.press("m");
  const before = await viewer.picture();
  const at = await viewer.page.evaluate((p) => window.dismantle!.project(p), [15 - 6.1, 20, 10] as Point);
  await viewer.page.mouse.move(at.x, at.y);
  await viewer.idle();
  assert.notEqual(await viewer.picture(), before);
  await viewer.press("m");
});

test("in inches, measures are in inches", async () => {
  await viewer.press("u", "m");
  await click([30, 0.1, 10]);
  assert.match(await label(), /^Edge 2\.3622 in\./);
  await viewer.press("m", "u");
});

const numberOf = (id: string) => viewer.page.locator(`.section-row:has(#section-${id}) input[type=number]`);

test("a section plane is placed by a number", async () => {
  await viewer.press("s");
  assert.equal(await numberOf("1").inputValue(), "20");
  await numberOf("1").fill("35");
  await viewer.press("Enter");
  const kept = (y: number) =>
    viewer.page.evaluate((at) => {
      const { x, y: top } = window.dismantle!.project([30, at, 10]);
      return window.dismantle!.at(x, top);
    }, y);
  assert.equal(await kept(30), null);
  assert.equal(await kept(38), "plate");
  await viewer.page.focus("#view");
  await viewer.press("s");
});

test("a section by a face starts at the face, and moves by a number", async () => {
  await viewer.press("s");
  await viewer.page.uncheck("#section-1");
  await viewer.click("#section-face");
  await click([30, 30, 10]);
  assert.equal(await numberOf("plane").inputValue(), "0");
  // What is cut away cannot be picked.
  const isThere = () =>
    viewer.page.evaluate(() => {
      const { x, y } = window.dismantle!.project([30, 30, 10]);
      return window.dismantle!.at(x, y) === "plate";
    });
  for (const [offset, kept] of [
    ["-4", false],
    ["1", true],
  ] as const) {
    await numberOf("plane").fill(offset);
    await viewer.press("Enter");
    assert.equal(await isThere(), kept, offset);
  }
  await viewer.page.uncheck("#section-plane");
  await viewer.page.focus("#view");
  await viewer.press("s");
});

test("a curved face is refused with a note", async () => {
  await viewer.press("1", "s");
  await viewer.page.uncheck("#section-1");
  await viewer.page.evaluate(() => {
    const { viewport, session } = window.dismantle!.app;
    void session;
    const { rig } = viewport;
    rig.lookFrom(rig.axis("back").set(-0.5, 0, 1));
  });
  await viewer.press("f");
  await viewer.click("#section-face");
  await click([45 + 6, 20, 8]);
  await viewer.page.locator(".toast", { hasText: "not flat" }).waitFor();
  await viewer.page.focus("#view");
  await viewer.press("s");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
