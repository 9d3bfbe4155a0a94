// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { reachedByTab, violationsOf } from "../support/accessibility.ts";
import { program } from "../support/environment.ts";
import { closeBrowser, Viewer } from "../support/page.ts";

type Frame = { t: number; position: number[] };

const folder = mkdtempSync(join(tmpdir(), "dismantle-offline-"));
const requests: string[] = [];
let page: Viewer;
let back: Viewer;
let lastFrame: Frame;

const run = (...arguments_: string[]) => execFileSync(program(), arguments_, { cwd: folder });

async function open(file: string): Promise<Viewer> {
  const url = `${pathToFileURL(join(folder, file))}?test`;
  const viewer = await Viewer.visit(url, undefined, { width: 1100, height: 600 });
  viewer.page.on("request", (request) => requests.push(request.url()));
  await viewer.page.waitForFunction(() => window.dismantleOffline?.app.viewport.model != null);
  await idle(viewer);
  return viewer;
}

const idle = (viewer: Viewer) => viewer.page.evaluate(() => window.dismantleOffline!.idle());
const state = () => page.page.evaluate(() => window.dismantleOffline!.app.session.store.state!);
const drawn = (viewer: Viewer, name: string) =>
  viewer.page.evaluate((n) => window.dismantleOffline!.drawnMatrix(n).slice(12, 15), name);
const picture = async () => {
  await idle(page);
  return page.page.evaluate(() => window.dismantleOffline!.app.viewport.canvas.toDataURL());
};
const press = async (key: string) => {
  await page.page.keyboard.press(key);
  await idle(page);
};
const playbackEnd = (viewer: Viewer) =>
  viewer.page.waitForFunction(() => window.dismantleOffline!.app.session.store.state!.playback!.playing === false);

before(async () => {
  run("sample", "microscope", "-o", "scope.step", "--motion", "pull.motion.json");
  run("move", "scope.step", "pull.motion.json", "-o", "pull.path.json");
  run("export", "scope.step", "pull.path.json", "-o", "pull.html");
  run("export", "scope.step", "pull.path.json", "-o", "back.html", "--reverse");
  const path = JSON.parse(readFileSync(join(folder, "pull.path.json"), "utf8"));
  lastFrame = path.moves[0].frames.at(-1);
  page = await open("pull.html");
  back = await open("back.html");
});

after(async () => {
  await closeBrowser();
  rmSync(folder, { recursive: true, force: true });
});

test("the page shows the model, the steps and the components", async () => {
  const { moves } = await state();
  assert.equal(await page.page.locator("#steps-panel li").count(), moves.length);
  assert.ok((await page.page.locator("#tree-panel .row").count()) > 20);
  assert.match(await page.page.title(), /scope\.step/);
});

test("a clicked step plays to its end, exactly to the path's pose", async () => {
  const { moves } = await state();
  await page.page.click("#steps-panel li:first-child button");
  await playbackEnd(page);
  await idle(page);
  const name = await page.page.evaluate((c) => window.dismantleOffline!.app.session.nameOf(c), moves[0].components[0]);
  const at = await drawn(page, name);
  for (let k = 0; k < 3; ++k) assert.ok(Math.abs(at[k] - lastFrame.position[k]) < 1e-9, `${at} ${lastFrame.position}`);
  assert.equal(await page.page.locator("#steps-panel [aria-current]").innerText(), `1. ${moves[0].label}`);
});

test("playback runs forward and backward to the ends", async () => {
  const { playback } = await state();
  await page.page.selectOption("#speed", "4");
  await page.page.click("#play-end");
  await idle(page);
  assert.equal((await state()).playback!.time, playback!.duration);
  await page.page.click("#play-reverse");
  await playbackEnd(page);
  await idle(page);
  const end = await state();
  assert.equal(end.playback!.time, 0);
  assert.ok(end.components.every(({ pose }) => pose === undefined));
});

test("the timeline scrubs", async () => {
  await page.page.focus("#scrub");
  const before = await picture();
  await page.page.locator("#scrub").fill("500");
  await idle(page);
  const { playback } = await state();
  assert.ok(Math.abs(playback!.time / playback!.duration - 0.5) < 0.01, String(playback!.time));
  assert.ok((await picture()) !== before);
});

test("a section cuts the model", async () => {
  const before = await picture();
  await press("s");
  const cut = await picture();
  assert.ok(cut !== before);
  assert.equal(await page.page.locator("[data-banner=section]").count(), 1);
  await page.page.focus("#stage canvas");
  await press("s");
  assert.ok((await picture()) === before);
});

test("the keyboard plays steps, hides, isolates and searches", async () => {
  await page.page.focus("#stage canvas");
  await press("/");
  assert.equal(await page.page.evaluate(() => document.activeElement?.id), "tree-search");
  await page.page.locator("#tree-panel [role=treeitem]").nth(2).focus();
  await press("Enter");
  await page.page.focus("#stage canvas");
  await press("i");
  assert.equal((await state()).isolated, true);
  await press("i");
  assert.equal((await state()).isolated, false);
  await press(" ");
  assert.ok((await state()).components.some(({ hidden }) => hidden));
  await press(" ");
  await press(".");
  await playbackEnd(page);
  await press("h");
  assert.equal(await page.page.locator("#help-dialog").isVisible(), true);
  await press("Escape");
});

test("components cannot be dragged without an engine", async () => {
  const before = await state();
  const position = await page.page.evaluate(() => {
    const { app, visiblePoint } = window.dismantleOffline!;
    return visiblePoint(app.session.nameOf(0));
  });
  assert.ok(position);
  await page.page.mouse.move(position.x, position.y);
  await page.page.mouse.down();
  await page.page.mouse.move(position.x + 60, position.y + 20, { steps: 4 });
  await page.page.mouse.up();
  await idle(page);
  assert.deepEqual((await state()).components, before.components);
});

test("the theme can be switched", async () => {
  const theme = () => page.page.evaluate(() => document.documentElement.dataset.theme);
  const before = await theme();
  await press("t");
  assert.notEqual(await theme(), before);
  await press("t");
});

test("axe-core reports nothing serious with every panel open, in light and dark, and in the help", async () => {
  const faults = async () => {
    await idle(page);
    return violationsOf(page.page);
  };
  await page.page.locator("#tree-panel [role=treeitem]").nth(2).focus();
  await press("Enter");
  await page.page.focus("#stage canvas");
  for (const key of ["s", "m", "i", "p"]) await press(key);
  await playbackEnd(page);
  for (const part of ["section-panel", "measure-label", "banners"])
    assert.equal(await page.page.isVisible(`#${part}`), true, part);
  assert.deepEqual(await faults(), []);
  await press("t");
  assert.deepEqual(await faults(), []);
  await page.page.focus("#stage canvas");
  for (const key of ["t", "i", "m", "s"]) await press(key);
  await press("h");
  assert.deepEqual(await faults(), []);
  await press("Escape");
});

test("every button can be reached by Tab", async () => {
  const reached = await reachedByTab(page.page, 60);
  const ids = ["section", "measure", "fit", "projection", "screenshot", "theme", "help", "tree-search", "view"];
  for (const id of [...ids, "play", "play-reverse", "play-start", "play-end", "scrub", "speed"])
    assert.ok(reached.has(id), `${id}: ${[...reached]}`);
});

test("a reversed page starts disassembled and ends assembled", async () => {
  const poses = () =>
    back.page.evaluate(() => window.dismantleOffline!.app.session.store.state!.components.map(({ pose }) => !pose));
  assert.ok((await poses()).some((home) => !home));
  await back.page.click("#play-end");
  await idle(back);
  assert.ok((await poses()).every((home) => home));
});

test("the page makes no request and has no errors", () => {
  assert.deepEqual(
    requests.filter((url) => !url.startsWith("blob:") && !url.startsWith("data:")),
    [],
  );
  assert.deepEqual([...page.problems, ...back.problems], []);
});
