// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { box } from "../support/box.ts";
import { useViewer, viewer } from "../support/scene.ts";

useViewer([], { waits: false });
/// Folders of chosen files; the browser reads them later.
const chosen: string[] = [];
after(() => {
  for (const used of chosen) rmSync(used, { recursive: true });
});

/// Chooses a folder with these files.
async function chooseFolder(name: string, files: Record<string, string>): Promise<void> {
  const from = mkdtempSync(join(tmpdir(), "dismantle-chosen-"));
  chosen.push(from);
  for (const [path, content] of Object.entries(files)) {
    mkdirSync(dirname(join(from, name, path)), { recursive: true });
    writeFileSync(join(from, name, path), content);
  }
  await viewer.page.setInputFiles("#folder-picker", join(from, name));
}

const opened = (name: string) =>
  viewer.page.waitForFunction((wanted) => window.dismantle?.app.session.store.model?.name === wanted, name);

/// The colours in which the components are drawn, by their names.
const drawnColors = () =>
  viewer.page.evaluate(() =>
    Object.fromEntries(
      window.dismantle!.app.viewport.model!.components.map(({ raw }) => [
        raw.name,
        raw.color.map((part) => Math.round(part * 1000) / 1000).join(),
      ]),
    ),
  );

test("equal parts of a folder of meshes are one item, wherever they are and however they are turned", async () => {
  await viewer.page.locator("#samples .card").first().waitFor();
  await chooseFolder("shelf", {
    "1.obj": box([0, 0, 0], [10, 20, 30]),
    "2.obj": box([40, 0, 0], [60, 30, 10]), // turned
    "3.obj": box([80, 0, 0], [110, 10, 20]), // turned otherwise
    "4.obj": box([0, 50, 0], [10, 60, 10]),
  });
  await opened("shelf");
  await viewer.idle();
  await viewer.select("2");
  await viewer.click("#select-similar");
  assert.deepEqual((await viewer.selection()).sort(), ["1", "2", "3"]);
  await viewer.page.click("#export");
  const bill = (await viewer.saved("#export-bom-csv")).bytes.toString().trim().split(/\r?\n/);
  assert.equal(bill.length, 3, bill.join("\n")); // a head, and two items
  assert.match(bill.join("\n"), /^1,[^,]*,3,/m);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.keyboard.press("Escape");
});

test("parts without colours are drawn in different ones", async () => {
  const colors = Object.values(await drawnColors());
  assert.equal(new Set(colors).size, 4, colors.join(" "));
});

test("each visual of a URDF's link is a component of its colour, in a group of the link", async () => {
  const visual = (mesh: string, rgb: string) =>
    `<visual><geometry><mesh filename="${mesh}.obj"/></geometry><material name="${mesh}"><color rgba="${rgb} 1"/></material></visual>`;
  await chooseFolder("arm", {
    "arm.urdf": `<robot name="arm"><link name="forearm">${visual("tube", "1 1 1")}${visual("servo", "0 0 0")}</link></robot>`,
    "tube.obj": box([0, 0, 0], [10, 10, 80]),
    "servo.obj": box([0, 0, 80], [20, 10, 100]),
  });
  await opened("arm.urdf");
  await viewer.idle();
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 2);
  await viewer.page.locator("#tree-panel .row.group", { hasText: "forearm" }).waitFor();
  const colors = Object.values(await drawnColors());
  assert.deepEqual([...colors].sort(), ["0,0,0,1", "1,1,1,1"]);
});

test("a group without components is neither gone nor selected", async () => {
  const positions = new Float32Array([0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9]);
  const faces = new Uint16Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  const bytes = Buffer.concat([Buffer.from(positions.buffer), Buffer.from(faces.buffer)]);
  const gltf = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      { name: "clamp", children: [1, 3] },
      { name: "sketches", children: [2] },
      { name: "outline" },
      { name: "jaw", mesh: 0 },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [9, 9, 9] },
      { bufferView: 1, componentType: 5123, count: 12, type: "SCALAR" },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 24 },
    ],
    buffers: [{ byteLength: 72, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
  };
  await viewer.page.setInputFiles("#file-picker", {
    name: "clamp.gltf",
    mimeType: "model/gltf+json",
    buffer: Buffer.from(JSON.stringify(gltf)),
  });
  await opened("clamp.gltf");
  await viewer.idle();
  await viewer.select("jaw");
  const group = viewer.page.locator("#tree-panel .row.group", { hasText: "sketches" });
  assert.doesNotMatch((await group.getAttribute("class"))!, /gone/);
  assert.equal(await group.getAttribute("aria-selected"), "false");
  assert.equal(await viewer.page.locator("#tree-panel .row[aria-selected=true]:not(.group)").count(), 1);
});

test("characters that no font of the PDF has are told", async () => {
  await chooseFolder("stand", {
    "\ue123 plate.obj": box([0, 0, 0], [10, 10, 2]),
    "foot.obj": box([0, 0, 5], [9, 9, 9]),
  });
  await opened("stand");
  await viewer.idle();
  await viewer.takeOut("foot");
  await viewer.page.click("#export");
  await viewer.saved("#instructions-pdf");
  await viewer.page.locator(".toast.warning", { hasText: /^The PDF: .*item/ }).waitFor();
  await viewer.page.keyboard.press("Escape");
});

test("a size below that of assemblies is questioned, and can be kept", async () => {
  await viewer.page.setInputFiles("#file-picker", {
    name: "tiny.obj",
    mimeType: "text/plain",
    buffer: Buffer.from(box([0, 0, 0], [0.01, 0.02, 0.03])),
  });
  await opened("tiny.obj");
  const banner = viewer.page.locator("[data-banner=size]", { hasText: "long, read in mm" });
  await banner.waitFor();
  await banner.locator("button", { hasText: "Keep" }).click();
  await banner.waitFor({ state: "detached" });
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.model!.units), "mm");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
