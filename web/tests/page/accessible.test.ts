// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { useMicroscope, viewer } from "../support/scene.ts";
import { sourceFolder } from "../support/tree.ts";

useMicroscope({
  prepare: () =>
    viewer.page.evaluate(readFileSync(join(sourceFolder(), "web/node_modules/axe-core/axe.min.js"), "utf8")),
});

/// What axe-core finds serious or critical.
async function faults(): Promise<string[]> {
  await viewer.idle();
  return viewer.page.evaluate(async () => {
    const { axe } = window as unknown as {
      axe: { run(): Promise<{ violations: { id: string; impact: string; nodes: { html: string }[] }[] }> };
    };
    const { violations } = await axe.run();
    return violations
      .filter(({ impact }) => impact === "serious" || impact === "critical")
      .flatMap(({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html}`));
  });
}

test("axe-core finds nothing serious: with a selection and its panels", async () => {
  await viewer.press("1");
  const { x, y } = await viewer.placeOf("base");
  await viewer.page.mouse.click(x, y);
  assert.deepEqual(await faults(), []);
});

test("nor with section, gizmo and the dark theme", async () => {
  await viewer.press("s", "g", "t");
  assert.deepEqual(await faults(), []);
  await viewer.press("t");
});

test("nor with the planner's panel and what it says of a component", async () => {
  await viewer.select("foot");
  await viewer.press("l", "q");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.search?.kind === "why");
  assert.deepEqual(await faults(), []);
  await viewer.press("l");
});

test("nor in the dialogs", async () => {
  await viewer.press("h");
  assert.deepEqual(await faults(), []);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.click("#open");
  await viewer.page.locator("#samples .card").first().waitFor();
  assert.deepEqual(await faults(), []);
  await viewer.page.keyboard.press("Escape");
});

test("every button is reached by Tab, and has a name", async () => {
  await viewer.page.evaluate(() => (document.activeElement as HTMLElement).blur());
  const reached = new Set<string>();
  for (let i = 0; i < 80; ++i) {
    await viewer.page.keyboard.press("Tab");
    reached.add(await viewer.page.evaluate(() => document.activeElement?.id ?? ""));
  }
  for (const id of [
    "open",
    "response-slide",
    "gizmo",
    "section",
    "measure",
    "plan",
    "fit",
    "theme",
    "help",
    "tree-search",
    "view",
    "take-out",
    "isolate",
    "find-path",
    "why",
    "numeric-0",
  ])
    assert.ok(reached.has(id), id);
});
