// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { after, test } from "node:test";
import { box } from "../support/box.ts";
import { sourceFolder } from "../support/environment.ts";
import { useViewer, viewer } from "../support/scene.ts";
import { isPresent } from "../support/step.ts";

const folder = mkdtempSync(join(tmpdir(), "dismantle-root-"));
useViewer(["--root", folder], { waits: false });
/// Folders of chosen files; the browser reads them later.
const chosen: string[] = [];
after(() => {
  for (const used of [folder, ...chosen]) rmSync(used, { recursive: true });
});

const modelName = () => viewer.page.evaluate(() => window.dismantle!.app.session.store.model?.name ?? null);

const kCube = `o cube\n${box([0, 0, 0], [10, 10, 10])}`;

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

/// A robot arm of two links, whose meshes are in another folder.
const kArm = `<robot name="arm">
${["base", "link"].map((name) => `<link name="${name}"><visual><geometry><mesh filename="../meshes/${name}.obj"/></geometry></visual></link>`).join("\n")}
<joint name="joint" type="fixed"><parent link="base"/><child link="link"/><origin xyz="20 0 0"/></joint>
</robot>`;

/// Chooses or drops files with paths below one folder.
async function choose(files: Record<string, string>, picker: "#file-picker" | "#folder-picker"): Promise<void> {
  const from = mkdtempSync(join(tmpdir(), "dismantle-chosen-"));
  chosen.push(from);
  for (const [path, content] of Object.entries(files)) {
    mkdirSync(dirname(join(from, path)), { recursive: true });
    writeFileSync(join(from, path), content);
  }
  const paths = Object.keys(files).map((path) => join(from, path));
  await viewer.page.setInputFiles(
    picker,
    picker === "#folder-picker" ? join(from, Object.keys(files)[0].split("/")[0]) : paths,
  );
}

const rows = () => viewer.page.locator("#tree-panel .row:not(.group)").count();

test("several chosen meshes are one assembly", async () => {
  await choose({ "a.obj": kCube, "b.obj": kCube, "c.obj": kCube }, "#file-picker");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.components.length === 3);
  await viewer.idle();
  assert.equal(await rows(), 3);
});

test("a chosen folder of meshes is opened by its name", async () => {
  await choose({ "vice/a.obj": kCube, "vice/b.obj": kCube, "vice/notes.txt": "no part" }, "#folder-picker");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "vice");
  assert.equal(await rows(), 2);
});

test("a URDF is opened with the meshes of its folder", async () => {
  await choose(
    { "robot/urdf/arm.urdf": kArm, "robot/meshes/base.obj": kCube, "robot/meshes/link.obj": kCube },
    "#folder-picker",
  );
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "arm.urdf");
  assert.equal(await rows(), 2);
});

test("a URDF without its meshes is refused with what to do", async () => {
  await choose({ "arm.urdf": kArm }, "#file-picker");
  await viewer.page.locator(".toast.warning", { hasText: "keep both in one folder" }).waitFor();
});

test("several files dropped on the page are opened together", async () => {
  await viewer.page.evaluate((cube) => {
    const carried = new DataTransfer();
    for (const name of ["x.obj", "y.obj"]) carried.items.add(new File([cube], name));
    document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, cancelable: true }));
  }, kCube);
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.components[0].name === "x");
  assert.equal(await rows(), 2);
});

test("files of which none can be opened, or several, are refused with the reason", async () => {
  await choose({ "a.txt": "x", "b.txt": "y" }, "#file-picker");
  await viewer.page.locator(".toast.warning", { hasText: "no file has a known format" }).waitFor();
  await choose({ "a.urdf": kArm, "b.urdf": kArm }, "#file-picker");
  await viewer.page.locator(".toast.warning", { hasText: "a.urdf and b.urdf" }).waitFor();
  // The browser notes each refusal of the server.
  for (const problem of viewer.problems.splice(0)) assert.match(problem, /status of 409/);
});

test("an error calls an uploaded file by its name, once", async () => {
  await viewer.page.setInputFiles("#file-picker", {
    name: "empty.step",
    mimeType: "text/plain",
    buffer: Buffer.from(""),
  });
  const toast = viewer.page.locator(".toast.warning", { hasText: "empty.step" });
  await toast.waitFor();
  const words = await toast.innerText();
  assert.equal(words.split("empty.step").length, 2, words);
  assert.doesNotMatch(words, /\/tmp|dismantle-/);
});

test("a folder of meshes under a root is opened as a whole", async () => {
  mkdirSync(join(folder, "gears"));
  for (const name of ["a.obj", "b.obj"]) writeFileSync(join(folder, "gears", name), kCube);
  await viewer.click("#open");
  await viewer.page.click('.roots .link-button:text-is("gears/")');
  await viewer.page.click(".roots .link-button:has-text('Open this folder (2 meshes)')");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name.endsWith("/gears"));
  assert.equal(await rows(), 2);
  await viewer.click("#open");
  await viewer.page.click('#recent .link-button:text-is("box.obj")');
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.model!.name === "box.obj");
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
