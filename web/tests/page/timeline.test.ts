// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { closeBrowser, Server, Viewer } from "../support/page.ts";

let server: Server;
let viewer: Viewer;
const kSlide = "specimen slide";

before(async () => {
  server = await Server.start("--sample", "microscope");
  viewer = await Viewer.open(server);
  await viewer.press("1");
});
after(async () => {
  await closeBrowser();
  await server.stop();
});

test("without a recording there is nothing to play", async () => {
  assert.equal(await viewer.page.isDisabled("#play"), true);
  assert.match(await viewer.page.locator("#timeline").innerText(), /recorded here/);
});

test("two drags are two blocks on the line of time", async () => {
  await viewer.grab(kSlide, 40, 0);
  await viewer.letGo();
  await viewer.grab("eyepiece", 0, -40);
  await viewer.letGo();
  assert.equal(await viewer.page.locator("#timeline .block").count(), 2);
  assert.equal(await viewer.page.isEnabled("#play"), true);
});

test("the recording is saved as a path file", async () => {
  const [download] = await Promise.all([viewer.page.waitForEvent("download"), viewer.page.click("#save")]);
  assert.equal(download.suggestedFilename(), "microscope.path.json");
  const path = JSON.parse(readFileSync((await download.path())!, "utf8"));
  assert.equal(path.format, "dismantle-path");
  assert.deepEqual(
    path.moves.map((move: { components: string[] }) => move.components[0]),
    [kSlide, "eyepiece"],
  );
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
