// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { after, test } from "node:test";
import { sourceFolder } from "../support/environment.ts";
import { useViewer, viewer } from "../support/scene.ts";
import { isPresent } from "../support/step.ts";

const folder = mkdtempSync(join(tmpdir(), "dismantle-root-"));
useViewer(["--root", folder], { waits: false });
after(() => rmSync(folder, { recursive: true }));

const modelName = () => viewer.page.evaluate(() => window.dismantle!.app.session.store.model?.name ?? null);

/// A cube with one facet a side, as an OBJ file.
const kCube = `o cube
${[0, 1, 2, 3, 4, 5, 6, 7].map((k) => `v ${k & 1 ? 10 : 0} ${k & 2 ? 10 : 0} ${k & 4 ? 10 : 0}`).join("\n")}
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
`;

test("without an assembly the start page offers the samples", async () => {
  await viewer.page.locator("#samples .card").first().waitFor();
  assert.equal(await viewer.page.locator("#samples .card").count(), 4);
});

test("a clicked sample is opened, and the start page closes", async () => {
  await viewer.page.click("[data-sample=microscope]");
  await viewer.model();
  assert.equal(await modelName(), "microscope.step");
  assert.equal(await viewer.page.isVisible("#open-dialog"), false);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 41);
});

test("a chosen file is uploaded and replaces the model", async () => {
  await viewer.page.setInputFiles("#file-picker", {
    name: "cube.obj",
    mimeType: "text/plain",
    buffer: Buffer.from(kCube),
  });
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "cube.obj");
  await viewer.idle();
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 1);
  assert.ok(await viewer.visiblePoint("cube"));
});

test("an unreadable file gives an error message, and the model stays", async () => {
  await viewer.page.setInputFiles("#file-picker", {
    name: "broken.step",
    mimeType: "text/plain",
    buffer: Buffer.from("no STEP"),
  });
  await viewer.page.locator(".toast.warning", { hasText: "broken.step" }).waitFor();
  assert.equal(await modelName(), "cube.obj");
});

test("a file dropped on the page is opened", async () => {
  await viewer.page.evaluate((cube) => {
    const carried = new DataTransfer();
    carried.items.add(new File([cube], "dropped.obj"));
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, cancelable: true }));
  }, kCube);
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "dropped.obj");
  await viewer.idle();
});

test("files under the roots are listed and opened, and become recent", async () => {
  writeFileSync(join(folder, "box.obj"), kCube);
  await viewer.click("#open");
  await viewer.page.locator(".roots h3", { hasText: basename(folder) }).waitFor();
  await viewer.page.click('.roots .link-button:text-is("box.obj")');
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "box.obj");
  await viewer.click("#open");
  await viewer.page.click('#recent .link-button:text-is("box.obj")');
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.number === 5);
  assert.equal(await modelName(), "box.obj");
});

/// Cancels a running import.
async function cancelImport(name: string): Promise<void> {
  await viewer.page.locator("[data-banner=job]", { hasText: name }).waitFor();
  await viewer.page.click("[data-banner=job] button");
  await viewer.page.locator("[data-banner=job]").waitFor({ state: "detached" });
  await viewer.idle();
  assert.equal(await modelName(), "box.obj");
}

test("a long import shows its progress and can be cancelled", async () => {
  await viewer.click("#open");
  await viewer.page.click("[data-sample=lathe]");
  await cancelImport("lathe.step");
});

const kLarge = "../shared/data/assemblies/o2ac_fixture/original/fixture_diagonal.step";

test("the import of a third-party assembly can be cancelled", {
  skip: !isPresent(kLarge) && `${kLarge} is not here`,
}, async () => {
  await viewer.page.setInputFiles("#file-picker", join(sourceFolder(), kLarge));
  await cancelImport("fixture_diagonal.step");
});

test("a size that assemblies do not have is questioned, and the unit can be changed", async () => {
  const huge = kCube.replaceAll("10", "50000");
  await viewer.page.setInputFiles("#file-picker", {
    name: "huge.obj",
    mimeType: "text/plain",
    buffer: Buffer.from(huge),
  });
  const banner = viewer.page.locator("[data-banner=size]", { hasText: "50 m long, read in mm" });
  await banner.waitFor();
  await banner.locator("select").selectOption("um");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.units === "um");
  await banner.waitFor({ state: "detached" });
  assert.equal(await modelName(), "huge.obj");
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.model!.bounds[1][0]), 50);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
