// SPDX-License-Identifier: Apache-2.0
// A third-party STEP assembly: panels, views and tools. Its drags are in step.test.ts, input devices in
// step_devices.test.ts.
import assert from "node:assert/strict";
import { copyFileSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { after, test } from "node:test";
import { validateBytes } from "gltf-validator";
import { sourceFolder } from "../support/environment.ts";
import {
  auditPath,
  camera,
  dragView,
  guidePath,
  highlighted,
  reset,
  server,
  useViewer,
  viewer,
  waitForPlaybackEnd,
  waitForRemoved,
  waitForSearch,
} from "../support/scene.ts";
import { choose, chosen, grab, isPresent, kThirdParty, pointerOffset, travel } from "../support/step.ts";

const skip = isPresent(kThirdParty) ? false : `${kThirdParty} is not here`;
const folder = mkdtempSync(join(tmpdir(), "dismantle-step-"));
const kFile = basename(kThirdParty);
if (!skip) copyFileSync(join(sourceFolder(), kThirdParty), join(folder, kFile));

useViewer(["--root", folder], { waits: false });
after(() => rmSync(folder, { recursive: true }));

/// Waits until the page's n-th assembly is open.
async function opened(number: number): Promise<void> {
  await viewer.page.waitForFunction((n) => window.dismantle!.app.session.store.model?.number === n, number);
  await viewer.model();
}

test("the file opens from a folder, from the recent files, and when dropped", { skip }, async () => {
  await viewer.page.click(`.roots .link-button:text-is("${kFile}")`);
  await opened(1);
  await viewer.click("#open");
  await viewer.page.click(`#recent .link-button:text-is("${kFile}")`);
  await opened(2);
  copyFileSync(join(folder, kFile), join(server.home, kFile));
  await viewer.page.evaluate(
    ([name, content]) => {
      const carried = new DataTransfer();
      carried.items.add(new File([content], name));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, cancelable: true }));
    },
    [kFile, readFileSync(join(folder, kFile), "latin1")],
  );
  await opened(3);
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group)").count(), 18);
  await choose("nut");
});

/// Drags in the view. Returns what changed of the camera.
async function viewChange(button: "left" | "middle" | "right", position: { x: number; y: number }) {
  const start = await camera();
  await dragView(button, position, 50, 25);
  const end = await camera();
  return {
    rotated: String(start.orientation) !== String(end.orientation),
    moved: String(start.focus) !== String(end.focus),
  };
}

test("view controls move the camera only", { skip }, async () => {
  await viewer.press("Escape", "f");
  const views = new Set<string>();
  for (const key of ["1", "2", "3", "4", "5", "6"]) {
    await viewer.press(key);
    views.add(String((await camera()).orientation.map((value) => value.toFixed(3))));
  }
  assert.equal(views.size, 6);
  await viewer.press("1");
  assert.equal((await viewChange("left", { x: 190, y: 120 })).rotated, true);
  assert.equal((await viewChange("right", await viewer.visiblePoint("plate"))).rotated, true);
  assert.deepEqual(await viewChange("middle", await viewer.visiblePoint("plate")), { rotated: false, moved: true });
  await viewer.press("1", "f");
  const all = await camera();
  const { x, y } = await viewer.visiblePoint("l-bracket");
  await viewer.page.mouse.move(x, y);
  await viewer.idle();
  assert.equal(await viewer.page.locator("#status .subject").innerText(), "l-bracket");
  await viewer.page.mouse.wheel(0, -240);
  await viewer.page.waitForFunction((d) => window.dismantle!.app.viewport.rig.current.distance < d, all.distance);
  await viewer.idle();
  assert.equal(await viewer.page.evaluate((p) => window.dismantle!.at(p.x, p.y), { x, y }), "l-bracket");
  await viewer.page.mouse.dblclick(x, y);
  await viewer.idle();
  assert.ok((await camera()).distance < 0.8 * all.distance);
  await viewer.press("Escape", "f");
  const box = (await viewer.page.locator("#view").boundingBox())!;
  await viewer.page.mouse.click(box.x + box.width - 60, box.y + 60 - 26);
  await viewer.idle();
  assert.notDeepEqual((await camera()).orientation, all.orientation);
  await viewer.press("o");
  assert.equal(await viewer.page.getAttribute("#projection", "aria-pressed"), "true");
  await viewer.press("o");
  assert.equal((await viewer.state()).moves.length, 0);
});

test("touch gestures zoom the view and drag a component", { skip }, async () => {
  const touch = await viewer.touchscreen();
  await viewer.press("1", "f");
  const start = await camera();
  await touch("touchStart", { x: 350, y: 250, id: 0 }, { x: 450, y: 250, id: 1 });
  await touch("touchMove", { x: 310, y: 250, id: 0 }, { x: 490, y: 250, id: 1 });
  await touch("touchEnd");
  await viewer.idle();
  assert.ok((await camera()).distance < 0.7 * start.distance);
  await choose("nut");
  const { x, y } = await viewer.visiblePoint("nut");
  const [dx, dy] = await pointerOffset(40, 0);
  await touch("touchStart", { x, y, id: 0 });
  for (const part of [0.4, 0.7, 1]) await touch("touchMove", { x: x + part * dx, y: y + part * dy, id: 0 });
  await viewer.idle();
  await touch("touchEnd");
  await viewer.idle();
  assert.ok((await travel(chosen.free)) > 1);
  await viewer.press("Control+z");
});

test("the tree can be searched, and a group selected", { skip }, async () => {
  await viewer.page.focus("#view");
  await viewer.press("/");
  await viewer.page.keyboard.type("nut");
  assert.equal(await viewer.page.locator("#tree-panel .row:not(.group):visible").count(), 8);
  await viewer.page.fill("#tree-search", "");
  await viewer.page.locator("#tree-panel .row.group .name").nth(1).click();
  await viewer.idle();
  assert.ok((await viewer.selection()).length > 1);
  await viewer.page.focus("#view");
  await viewer.press("Escape");
});

test("theme, help, screenshot and stereo work", { skip }, async () => {
  await viewer.press("1", "f");
  const plain = await viewer.picture();
  await viewer.press("t");
  assert.notEqual(await viewer.picture(), plain);
  await viewer.press("t", "h");
  assert.equal(await viewer.page.isVisible("#help-dialog"), true);
  await viewer.page.keyboard.press("Escape");
  const { name, bytes } = await viewer.saved("#screenshot");
  assert.equal(name, "as1-oc-214.png");
  assert.equal(bytes.toString("latin1", 1, 4), "PNG");
  await viewer.page.focus("#view");
  const pictures = [plain];
  for (let mode = 0; mode < 2; ++mode) {
    await viewer.press("v");
    pictures.push(await viewer.picture());
  }
  assert.equal(new Set(pictures).size, 3);
  await viewer.press("v");
  assert.equal((await viewer.picture()) === plain, true);
});

test("a recording works as a guide: ghost, practice and playback", { skip }, async () => {
  await choose("nut");
  await grab(60, 0);
  await viewer.release();
  await viewer.click("#follow");
  const instruction = viewer.page.locator("#guide-step");
  await instruction.filter({ hasText: "Step 1 of 1: remove nut" }).waitFor();
  assert.deepEqual(await highlighted(), ["nut"]);
  await viewer.page.hover("#guide-show");
  const before = await viewer.picture();
  await viewer.page.click("#guide-show");
  await viewer.page.waitForFunction((picture) => window.dismantle!.app.viewport.canvas.toDataURL() !== picture, before);
  await viewer.page.check("#guide-practice");
  await viewer.idle();
  assert.match(await instruction.innerText(), /what comes next/);
  assert.deepEqual(await highlighted(), []);
  await choose("nut#2");
  await grab(30, 0);
  await viewer.release();
  const score = viewer.page.locator("#guide-score");
  assert.match(await score.innerText(), /1 out of order/);
  await choose("nut");
  await grab(0, 40);
  await viewer.release();
  assert.match(await score.innerText(), /[1-9]\d* contacts?,/);
  await grab(80, 0);
  await viewer.release();
  assert.match(await instruction.innerText(), /Done/);
  await viewer.page.uncheck("#guide-practice");
  await reset();
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => (window.dismantle!.app.session.playbackTime ?? 0) > 0);
  await waitForPlaybackEnd();
  assert.equal((await viewer.state()).playback!.blocked, null);
  assert.ok((await travel(chosen.free)) > 1);
  await viewer.click("#play-stop");
  await viewer.click("#guide-close");
});

test("the whole is planned around a fixed component; the plan passes the audit and explodes", {
  skip,
}, async () => {
  await viewer.page.focus("#view");
  await viewer.press("Escape", "l");
  await viewer.select("plate");
  await viewer.click("#plan-fix");
  assert.match(await viewer.page.locator("#plan-fixed").innerText(), /plate/);
  await viewer.page.check("#plan-all");
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  await viewer.idle();
  const { guide, search: found, moves } = await viewer.state();
  assert.equal(found!.complete, true);
  assert.equal(guide!.moves.length, found!.steps);
  assert.equal(moves.length, 0);
  const plate = await viewer.index("plate");
  assert.ok(guide!.moves.every(({ components }) => !components.includes(plate)));
  auditPath(await guidePath());
  await viewer.page.focus("#view");
  await viewer.press("l", "e");
  assert.match(await viewer.page.locator("#explode-step").innerText(), new RegExp(`of ${guide!.moves.length}`));
  await viewer.page.fill("#explode-slider", "1");
  await viewer.idle();
  const first = guide!.moves[0].components[0];
  const { components, playback } = await viewer.state();
  assert.ok(components[first].pose && playback!.blocked === null);
  await viewer.page.focus("#view");
  await viewer.press("e");
  await viewer.click("#guide-close");
});

test("blockers are shown; a path is found and can be played", { skip }, async () => {
  await viewer.select("bolt");
  await viewer.page.focus("#view");
  await viewer.press("q");
  await waitForSearch("why");
  await viewer.idle();
  const [reason] = (await viewer.state()).search!.reasons;
  assert.ok(reason.blockers.length > 0);
  assert.equal(await viewer.page.locator("#reason li").count(), reason.blockers.length);
  assert.equal(
    await viewer.page.evaluate(() => window.dismantle!.app.viewport.blocked.arrows.length),
    reason.blockers.length,
  );
  await viewer.page.click("#find-path");
  await waitForRemoved("bolt");
  await viewer.idle();
  const { moves } = await viewer.state();
  assert.ok(moves.length > 1, "blockers are removed first");
  await viewer.page.selectOption("#speed", "0.25"); // so that it does not end before it is paused
  await viewer.click("#play-start");
  const time = async () => (await viewer.state()).playback!.time;
  assert.equal(await time(), 0);
  await viewer.page.focus("#view");
  await viewer.press(".");
  assert.ok(Math.abs((await time()) - moves[1].start) < 1e-6);
  await viewer.page.keyboard.press("p");
  await viewer.page.waitForFunction((t) => window.dismantle!.app.session.playbackTime! > t, moves[1].start);
  await viewer.press("p");
  assert.equal((await viewer.state()).playback!.playing, false);
  await viewer.click("#play-stop");
});

test("all exports work", { skip }, async () => {
  await viewer.page.click("#export");
  const file = async (button: string) => {
    const { name, bytes } = await viewer.saved(`#export-${button}`);
    assert.match(name, /^as1-oc-214/);
    return bytes;
  };
  const { issues } = await validateBytes(new Uint8Array(await file("animation-glb")));
  assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
  assert.match((await file("page-html")).toString(), /^<!DOCTYPE html>[\s\S]*offline-model/);
  assert.match((await file("moves-csv")).toString(), /,bolt,/);
  assert.match((await file("bom-csv")).toString(), /,nut,8,/);
  assert.equal(JSON.parse((await file("bom-json")).toString()).format, "dismantle-bill");
  assert.equal((await file("png")).toString("latin1", 1, 4), "PNG");
  await viewer.page.check("#export-reverse");
  const path = (await file("path-json")).toString();
  assert.equal(JSON.parse(path).format, "dismantle-path");
  await viewer.page.uncheck("#export-reverse");
  const video = await file("video");
  assert.ok(video.readUInt32BE(0) === 0x1a45dfa3 && video.length > 5000);
  await viewer.click("#play-stop");
  await reset();
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
