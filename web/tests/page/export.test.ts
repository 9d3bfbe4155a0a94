// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { validateBytes } from "gltf-validator";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const open = () => viewer.page.click("#export");

test("without moves only the assembly's files can be exported", async () => {
  await open();
  assert.equal(await viewer.page.isDisabled("#export-moves-csv"), true);
  assert.equal(await viewer.page.isDisabled("#export-video"), true);
  const { name, bytes } = await viewer.saved("#export-bom-csv");
  assert.equal(name, "microscope-bom.csv");
  assert.match(bytes.toString(), /,foot,4,/);
  await viewer.press("Escape");
});

test("moves are exported as an animation, a page, tables and a path", async () => {
  await viewer.grab(kSlide, 40, 0);
  await viewer.release();
  await open();
  const glb = await viewer.saved("#export-animation-glb");
  assert.equal(glb.name, "microscope.glb");
  assert.equal(glb.bytes.toString("latin1", 0, 4), "glTF");
  const json = JSON.parse(glb.bytes.toString("utf8", 20, 20 + glb.bytes.readUInt32LE(12)));
  assert.equal(json.animations.length, 4);

  const page = await viewer.saved("#export-page-html");
  assert.equal(page.name, "microscope.html");
  assert.match(page.bytes.toString(), /^<!DOCTYPE html>[\s\S]*offline-model/);

  assert.match((await viewer.saved("#export-moves-csv")).bytes.toString(), /\r\n1,[^,]*,specimen slide,0,/);
  assert.equal(JSON.parse((await viewer.saved("#export-bom-json")).bytes.toString()).format, "dismantle-bill");
  assert.equal(JSON.parse((await viewer.saved("#export-path-json")).bytes.toString()).moves.length, 1);
});

test("the Khronos validator reports nothing for the animation and the page's own model", async () => {
  const model = await viewer.page.evaluate(async () => {
    const response = await window.dismantle!.app.session.connection.request("/api/model.glb");
    return [...new Uint8Array(await response.arrayBuffer())];
  });
  for (const bytes of [new Uint8Array((await viewer.saved("#export-animation-glb")).bytes), Uint8Array.from(model)]) {
    const { issues } = await validateBytes(bytes);
    assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
  }
});

test("a reversed path also puts the components back", async () => {
  await viewer.page.check("#export-reverse");
  assert.equal(JSON.parse((await viewer.saved("#export-path-json")).bytes.toString()).moves.length, 2);
});

test("the image is a PNG", async () => {
  assert.equal((await viewer.saved("#export-png")).bytes.toString("latin1", 1, 4), "PNG");
});

test("the playback is recorded as a video", async () => {
  await viewer.page.uncheck("#export-reverse");
  const { name, bytes } = await viewer.saved("#export-video");
  assert.equal(name, "microscope.webm");
  assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3);
  assert.ok(bytes.length > 5000, String(bytes.length));
  assert.equal(await viewer.page.locator("#export-dialog").isVisible(), false);
  await viewer.click("#play-stop");
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
