// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { auditPath, kSlide, reset, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const search = async () => (await viewer.state()).search;
const banner = (key: string) => viewer.page.locator(`[data-banner=${key}]`);
const arrows = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.blocked.arrows.length);
const waitForSearch = (kind: string) =>
  viewer.page.waitForFunction((k) => window.dismantle!.app.session.store.state!.search?.kind === k, kind);

test("a plan of everything becomes the guide, and moves nothing", async () => {
  await viewer.press("l");
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  await viewer.idle();
  const { guide, components, moves, search: found } = await viewer.state();
  assert.ok(found!.steps > 10, `${found!.steps}`);
  assert.equal(guide!.moves.length, found!.steps);
  assert.equal(moves.length, 0);
  assert.ok(components.every(({ pose }) => !pose));
  assert.match(await viewer.page.locator("#plan-found").innerText(), new RegExp(`^${found!.steps} steps`));
  assert.match(await viewer.page.locator("#guide-step").innerText(), /Step 1 of/);
  auditPath(
    await viewer.page.evaluate(async () =>
      (await window.dismantle!.app.session.connection.request("/api/guide.json")).text(),
    ),
  );
});

test("the plan plays, and nothing is in its way", async () => {
  await viewer.page.selectOption("#speed", "4");
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => (window.dismantle!.app.session.playedTime ?? 0) > 3);
  await viewer.page.click("#play-pause");
  await viewer.page.click("#play-end");
  await viewer.idle();
  const { playback, components } = await viewer.state();
  assert.equal(playback!.blocked, null);
  assert.ok(components.filter(({ pose }) => pose).length > 10);
  await viewer.click("#play-stop");
  await viewer.click("#guide-close");
  assert.equal(await search(), null);
});

test("a plan for the selection leaves alone what is not in its way, and what is fixed", async () => {
  await viewer.select("objective 10x");
  await viewer.page.check("#plan-selection");
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  await viewer.idle();
  const first = (await viewer.state()).guide!.moves;
  assert.ok(first.length < 8, `${first.length}`);
  const target = await viewer.index("objective 10x");
  assert.ok(first.at(-1)!.components.includes(target));
  await viewer.click("#guide-close");
  await viewer.press("l");
  assert.equal(await viewer.page.isVisible("#plan-panel"), false);
});

test("what is preferred is asked for, the first ticked first", async () => {
  await viewer.press("l");
  const asked = viewer.page.evaluate(
    () =>
      new Promise((resolve) => {
        const { session } = window.dismantle!.app;
        const ask = session.ask.bind(session);
        session.ask = ((name: "plan", members: object) => {
          if (name === "plan") resolve(members);
          session.ask = ask;
          return ask(name, members);
        }) as typeof session.ask;
      }),
  );
  await viewer.page.check("#plan-all");
  await viewer.page.check("#plan-prefer-support");
  await viewer.page.check("#plan-prefer-upright");
  await viewer.page.check("#plan-prefer-groups");
  await viewer.page.uncheck("#plan-prefer-upright");
  await viewer.page.click("#plan-find");
  assert.deepEqual(((await asked) as { prefer: string[] }).prefer, ["support", "groups"]);
  await waitForSearch("plan");
  await viewer.idle();
  assert.ok((await search())!.steps > 10);
  await viewer.page.uncheck("#plan-prefer-support");
  await viewer.page.uncheck("#plan-prefer-groups");
  await viewer.click("#guide-close");
  await viewer.press("l");
});

test("why it stays: the blocker is named, highlighted, and an arrow points at it", async () => {
  await viewer.select("stage plate");
  const before = await viewer.picture();
  await viewer.page.click("#why");
  await waitForSearch("why");
  await viewer.idle();
  const [reason] = (await search())!.reasons;
  assert.ok(reason.blockers.length > 0);
  assert.match(await viewer.page.locator("#reason p").first().innerText(), /^Blocked along .* by/);
  assert.equal(await arrows(), reason.blockers.length);
  const marked = await viewer.page.locator("#reason li").allInnerTexts();
  assert.equal(marked.length, reason.blockers.length);
  assert.notEqual(await viewer.picture(), before);
  await viewer.select(kSlide);
  assert.equal(await arrows(), 0);
});

test("what goes by itself is stopped where it is", async () => {
  await viewer.select("pinion shaft");
  await viewer.page.keyboard.press("n");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic !== null);
  while (!(await viewer.state()).components.some(({ pose }) => pose)) await viewer.page.waitForTimeout(20);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic === null);
  await viewer.idle();
  const { components } = await viewer.state();
  assert.equal(components[await viewer.index("pinion shaft")].removed, undefined);
  assert.ok(components.some(({ pose }) => pose));
});

test("find a path takes it out, and first what is in its way; each is one entry of undo", async () => {
  await reset();
  await viewer.select("pinion shaft");
  await viewer.press("n");
  const shaft = await viewer.index("pinion shaft");
  await viewer.page.waitForFunction((c) => window.dismantle!.app.session.store.state!.components[c].removed, shaft);
  await viewer.idle();
  const { moves, undo } = await viewer.state();
  assert.ok(moves.length > 1, `${moves.length}`);
  assert.equal(undo, "take out pinion shaft");
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.drawn("pinion shaft")), false);
  await viewer.press("Control+z");
  assert.equal((await viewer.state()).moves.length, moves.length - 1);
  await reset();
});

test("stuck in a drag, N finds the way; let go of, a button does", async () => {
  await viewer.press("1");
  await viewer.grab(kSlide, 0, 60);
  await banner("stuck")
    .filter({ hasText: /N: find a path/ })
    .waitFor();
  await viewer.letGo();
  await banner("was-stuck")
    .filter({ hasText: /specimen slide was blocked by stage plate/ })
    .waitFor();
  await banner("was-stuck").locator("button").click();
  const slide = await viewer.index(kSlide);
  const out = () =>
    viewer.page.waitForFunction((c) => window.dismantle!.app.session.store.state!.components[c].removed, slide);
  await out();
  await viewer.idle();
  await reset();
  await viewer.press("1");
  await viewer.grab(kSlide, 20, 0);
  await viewer.press("n");
  await out();
  await viewer.letGo();
  assert.equal((await viewer.state()).moves.length, 2);
  await reset();
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
