// SPDX-License-Identifier: Apache-2.0
// Makes the pictures of the user's guide from the running program; run by web/make_pictures.
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { sourceFolder } from "./support/environment.ts";
import { closeBrowser, Server, Viewer } from "./support/page.ts";

const kFolder = join(sourceFolder(), "docs/pictures");
const kSize = { width: 1280, height: 780 };
const kSlide = "specimen slide";

async function open(server: Server): Promise<Viewer> {
  return Viewer.visit(server.url.replace("/#", "/?test=pictures#"), undefined, kSize);
}

async function shoot(viewer: Viewer, name: string): Promise<void> {
  await viewer.idle();
  await viewer.page.screenshot({ path: join(kFolder, `${name}.png`) });
}

/// Looks at a component from the front right, with a margin.
async function lookAt(viewer: Viewer, name: string, room: number): Promise<void> {
  await viewer.press("1");
  await viewer.page.evaluate(
    ([wanted, margin]) => {
      const { rig, model } = window.dismantle!.app.viewport;
      rig.fit(
        model!.components
          .find(({ raw }) => raw.name === wanted)!
          .bounds()
          .expandByScalar(margin as number),
      );
      rig.orbit(-70, 45, rig.current.focus);
    },
    [name, room],
  );
  await viewer.idle();
}

/// Runs a server while some pictures are made; stops it in any case.
async function withServer(start: Promise<Server>, makePictures: (viewer: Viewer) => Promise<void>): Promise<void> {
  const server = await start;
  try {
    const viewer = await open(server);
    await makePictures(viewer);
    await viewer.close();
  } finally {
    await server.stop();
  }
}

async function startPage(viewer: Viewer): Promise<void> {
  await viewer.page.locator("#samples .card").first().waitFor();
  await shoot(viewer, "start");
}

async function contact(viewer: Viewer): Promise<void> {
  await lookAt(viewer, kSlide, 55);
  await viewer.grab(kSlide, 120, 70, 20);
  await viewer.page.locator("[data-banner=stuck]").waitFor();
  await viewer.page.locator("#pairs .badge").first().waitFor();
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.directions !== null);
  await shoot(viewer, "contact");
  await viewer.release();
}

async function tools(viewer: Viewer): Promise<void> {
  await viewer.press("d");
  await shoot(viewer, "directions");
  await viewer.press("Escape", "Escape", "f", "s");
  await viewer.page.evaluate(() =>
    window.dismantle!.app.viewport.rig.orbit(-20, 0, window.dismantle!.app.viewport.rig.current.focus),
  );
  await viewer.page.locator("#section-panel input[type=checkbox]").nth(1).uncheck();
  await viewer.page.locator("#section-panel input[type=checkbox]").nth(0).check();
  await viewer.page.locator("#section-panel .section-row .button").first().click();
  await viewer.press("t");
  await shoot(viewer, "section");
  await viewer.page.focus("#view");
  await viewer.press("s", "t");
}

/// The plan of the whole, and what blocks one component.
async function plan(viewer: Viewer): Promise<void> {
  const waitForSearch = (kind: string) =>
    viewer.page.waitForFunction((k) => window.dismantle!.app.session.store.state!.search?.kind === k, kind);
  await lookAt(viewer, "stage plate", 60);
  await viewer.press("l");
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  await viewer.select("stage plate");
  await viewer.press("q");
  await waitForSearch("why");
  await shoot(viewer, "plan");
  await viewer.press("l", "Escape");
  await viewer.click("#guide-close");
}

async function guide(viewer: Viewer): Promise<void> {
  await viewer.click("#follow");
  await viewer.page.locator("#guide-panel").waitFor();
  await lookAt(viewer, kSlide, 70);
  await viewer.page.click("#guide-show");
  await viewer.page.waitForTimeout(900);
  await viewer.page.screenshot({ path: join(kFolder, "guide.png") });
}

/// Exports the page. Returns its file.
async function exportPage(viewer: Viewer): Promise<string> {
  await viewer.click("#export");
  await shoot(viewer, "first-export");
  const coming = viewer.page.waitForEvent("download");
  await viewer.page.click("#export-page-html");
  const file = join(mkdtempSync(join(tmpdir(), "dismantle-pictures-")), "microscope.html");
  await (await coming).saveAs(file);
  return file;
}

/// The exported page in the middle of its second step.
async function offlinePage(file: string): Promise<void> {
  const viewer = await Viewer.visit(`${pathToFileURL(file)}?test=pictures`, undefined, kSize);
  await viewer.page.waitForFunction(() => window.dismantleOffline?.app.viewport.model != null);
  await viewer.page.evaluate(async () => {
    const { app, idle } = window.dismantleOffline!;
    const [, second] = app.session.movesOf("recording");
    await app.session.send("seek", { time: second.start + 0.6 * second.duration, source: "recording" });
    await idle();
  });
  await viewer.page.screenshot({ path: join(kFolder, "offline.png") });
  await viewer.close();
  rmSync(join(file, ".."), { recursive: true });
}

/// The first steps of a new user with ./run: takes out three components and exports the page, by clicks alone.
async function firstMinutes(viewer: Viewer): Promise<void> {
  const begin = performance.now();
  await viewer.model();
  for (const [i, name] of [kSlide, "foot", "foot#2"].entries()) {
    await viewer.click(`#tree-panel .row .name:text-is("${name}")`);
    await viewer.page.click("#take-out");
    await viewer.page.waitForFunction(
      (c) => window.dismantle!.app.session.store.state!.components[c].removed,
      await viewer.index(name),
    );
    if (i !== 1) await shoot(viewer, `first-${i + 1}`);
  }
  await viewer.click("#explode");
  await shoot(viewer, "explode");
  await viewer.click("#explode");
  const page = await exportPage(viewer);
  const seconds = (performance.now() - begin) / 1000;
  console.log(`three components taken out, and the page exported, in ${seconds.toFixed(1)} s`);
  if (seconds > 120) throw new Error("a newcomer's first steps take more than two minutes");
  await firstInstructions(viewer);
  const all = (performance.now() - begin) / 1000;
  console.log(`everything planned, and its instructions printed, in ${all.toFixed(1)} s`);
  if (all > 300) throw new Error("a newcomer's way to printed instructions takes more than five minutes");
  await offlinePage(page);
}

/// Plans the disassembly of everything and prints its work instructions, by clicks alone.
async function firstInstructions(viewer: Viewer): Promise<void> {
  await viewer.page.keyboard.press("Escape"); // closes the export dialog
  await viewer.page.click("#plan");
  await viewer.page.click("#plan-find");
  await viewer.page.waitForFunction(
    () => window.dismantle!.app.session.store.state!.search?.kind === "plan",
    undefined,
    { timeout: 120_000 },
  );
  await shoot(viewer, "first-plan");
  await viewer.page.click("#plan");
  await viewer.click("#export");
  await viewer.page.selectOption("#export-source", "guide");
  await viewer.page.click("#instructions-preview");
  const preview = viewer.page.frameLocator("#instructions-preview-dialog iframe");
  await preview.locator(".step img").first().waitFor({ timeout: 120_000 });
  await viewer.page.evaluate(() => {
    const frame = document.querySelector<HTMLIFrameElement>("#instructions-preview-dialog iframe")!;
    frame.contentWindow!.print = () => document.body.setAttribute("data-printed", "yes");
  });
  await shoot(viewer, "first-instructions");
  await viewer.page.click("#preview-print");
  await viewer.page.locator("body[data-printed]").waitFor();
  await viewer.page.keyboard.press("Escape");
  await viewer.page.keyboard.press("Escape");
}

async function workshop(viewer: Viewer): Promise<void> {
  await viewer.model();
  await viewer.page.mouse.move(300, 600);
  await shoot(viewer, "model");
  await contact(viewer);
  await tools(viewer);
  await plan(viewer);
  await guide(viewer);
}

mkdirSync(kFolder, { recursive: true });
try {
  await withServer(Server.startRun(), firstMinutes);
  await withServer(Server.start(), startPage);
  await withServer(Server.start("--sample", "microscope"), workshop);
} finally {
  await closeBrowser();
}
