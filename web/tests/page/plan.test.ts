// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  auditPath,
  guidePath,
  kSlide,
  reset,
  useMicroscope,
  viewer,
  waitForRemoved,
  waitForSearch,
} from "../support/scene.ts";

useMicroscope({ view: "1" });

const search = async () => (await viewer.state()).search;
const banner = (key: string) => viewer.page.locator(`[data-banner=${key}]`);
const arrows = () => viewer.page.evaluate(() => window.dismantle!.app.viewport.blocked.arrows.length);

/// Counts the renders and the events of jobs from now on.
const count = () =>
  viewer.page.evaluate(() => {
    const { session, viewport } = window.dismantle!.app;
    const counted = { renders: 0, events: 0 };
    const apply = session.jobs.apply.bind(session.jobs);
    session.jobs.apply = (event) => {
      ++counted.events;
      apply(event);
    };
    viewport.afterRender.add(() => ++counted.renders);
    Object.assign(window, { counted });
  });
const counted = () =>
  viewer.page.evaluate(() => (window as unknown as { counted: { renders: number; events: number } }).counted);

test("a plan of everything becomes the guide, and moves nothing", async () => {
  await viewer.press("l");
  await viewer.idle();
  await count();
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  // Progress shows in the panels; the scene is as it was.
  const { renders, events } = await counted();
  assert.ok(events >= 10, `${events} events of the job`);
  assert.ok(renders < events / 2, `${renders} renders for ${events} events`);
  await viewer.idle();
  const { guide, components, moves, search: found } = await viewer.state();
  assert.ok(found!.steps > 10, `${found!.steps}`);
  assert.equal(guide!.moves.length, found!.steps);
  assert.equal(moves.length, 0);
  assert.ok(components.every(({ pose }) => !pose));
  assert.match(await viewer.page.locator("#plan-found").innerText(), new RegExp(`^${found!.steps} steps`));
  assert.match(await viewer.page.locator("#guide-step").innerText(), /Step 1 of/);
  auditPath(await guidePath());
});

test("the plan plays without contact", async () => {
  await viewer.page.selectOption("#speed", "4");
  await viewer.page.click("#guide-play");
  await viewer.page.waitForFunction(() => (window.dismantle!.app.session.playbackTime ?? 0) > 3);
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

test("a plan for the selection moves only what blocks it", async () => {
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

/// Presses "Find" for everything. @return what the page sends
async function planSent(): Promise<{ prefer: string[] }> {
  const sent = viewer.page.evaluate(
    () =>
      new Promise((resolve) => {
        const { session } = window.dismantle!.app;
        const send = session.send.bind(session);
        session.send = ((name: "plan", members: object) => {
          if (name === "plan") resolve(members);
          session.send = send;
          return send(name, members);
        }) as typeof session.send;
      }),
  );
  await viewer.page.check("#plan-all");
  await viewer.page.click("#plan-find");
  return (await sent) as { prefer: string[] };
}

test("preferences are sent in the order they were ticked", async () => {
  await viewer.press("l");
  await viewer.page.check("#plan-prefer-support");
  await viewer.page.check("#plan-prefer-upright");
  await viewer.page.check("#plan-prefer-groups");
  await viewer.page.uncheck("#plan-prefer-upright");
  assert.deepEqual((await planSent()).prefer, ["support", "groups"]);
  await waitForSearch("plan");
  await viewer.idle();
  assert.ok((await search())!.steps > 10);
  await viewer.page.uncheck("#plan-prefer-support");
  await viewer.page.uncheck("#plan-prefer-groups");
  await viewer.click("#guide-close");
  await viewer.press("l");
});

test("weights of preferences are sent with them", async () => {
  await viewer.press("l");
  assert.equal(await viewer.page.isVisible("#plan-weight-groups"), false);
  await viewer.page.check("#plan-prefer-tools");
  await viewer.page.check("#plan-prefer-groups");
  await viewer.page.fill("#plan-weight-groups", "2.5");
  await viewer.page.fill("#plan-weight-tools", "-1"); // no weight
  assert.deepEqual((await planSent()).prefer, ["tools", "groups=2.5"]);
  await waitForSearch("plan");
  await viewer.idle();
  await viewer.page.fill("#plan-weight-groups", "");
  await viewer.page.uncheck("#plan-prefer-tools");
  await viewer.page.uncheck("#plan-prefer-groups");
  await viewer.click("#guide-close");
  await viewer.press("l");
});

test("where more effort may find more, the same is planned again with four times the effort", async () => {
  const blocked = await viewer.index("stage plate");
  await viewer.press("l");
  // A plan that ends early for a component that cannot get past the others, all of which are fixed.
  const plans = await viewer.page.evaluateHandle((free) => {
    const { session } = window.dismantle!.app;
    const sent: object[] = [];
    const send = session.send.bind(session);
    session.send = ((name: string, members: { effort?: number }) => {
      if (name !== "plan") return send(name as "plan", members);
      sent.push(members);
      const fixed = session.store.state!.components.map((_, c) => c).filter((c) => c !== free);
      return send(name, { ...members, fixed, effort: members.effort ?? 1e-4 });
    }) as typeof session.send;
    return { sent, restore: () => (session.send = send) };
  }, blocked);
  assert.ok(await viewer.page.isHidden("#plan-longer"));
  await viewer.page.click("#plan-find");
  await viewer.page.waitForSelector("#plan-longer:visible");
  await viewer.page.click("#plan-longer button");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.search?.effort === 4e-4);
  await viewer.idle();
  const [first, second] = await plans.evaluate(({ sent, restore }) => {
    restore();
    return sent;
  });
  assert.deepEqual(second, { ...first, effort: 4e-4 });
  assert.deepEqual(
    (await search())!.reasons.map(({ component }) => component),
    [blocked],
  );
  await viewer.page.click("#plan-find");
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.search?.effort === 1);
  assert.equal(await viewer.page.isVisible("#plan-longer"), (await search())!.effort_spent);
  await viewer.idle();
  await viewer.click("#guide-close");
  await viewer.press("l");
});

test("blockers are named, highlighted, and pointed at by arrows", async () => {
  await viewer.select("stage plate");
  const before = await viewer.picture();
  await viewer.page.click("#why");
  await waitForSearch("why");
  await viewer.idle();
  const [reason] = (await search())!.reasons;
  assert.ok(reason.blockers.length > 0);
  assert.match(await viewer.page.locator("#reason-sentence").innerText(), /^(Take off .* first|Blocked .* by)/);
  assert.equal(await arrows(), Math.min(6, reason.blockers.length));
  await viewer.page.click("#reason summary");
  const marked = await viewer.page.locator("#reason li").allInnerTexts();
  assert.equal(marked.length, reason.blockers.length);
  assert.notEqual(await viewer.picture(), before);
  await viewer.select(kSlide);
  assert.equal(await arrows(), 0);
});

test("what has to come off first is the shortest chain that the planner finds", async () => {
  await viewer.select("pinion bush");
  await viewer.page.click("#why");
  await waitForSearch("why");
  await viewer.idle();
  const { chain } = (await search())!;
  assert.ok(chain !== null && chain.before.length > 0);
  const sentence = await viewer.page.locator("#reason-sentence").innerText();
  assert.match(sentence, /^Take off .* first; then it comes out (along [+−][XYZ]|near [+−][XYZ]|between )/);
  const { components } = await viewer.page.evaluate(() => window.dismantle!.app.session.store.model!);
  assert.ok(sentence.includes(components[chain.before[0][0]].name.replace(/#\d+$/, "")), sentence);
});

test("with recorded moves and a plan, the export is of the one that is chosen", async () => {
  await viewer.takeOut(kSlide);
  await viewer.page.focus("#view");
  await viewer.press("l");
  await viewer.page.click("#plan-find");
  await waitForSearch("plan");
  await viewer.idle();
  const steps = (await viewer.state()).guide!.moves.length;
  assert.ok(steps > 10);
  await viewer.page.click("#export");
  const movesOf = async (source: string) => {
    await viewer.page.selectOption("#export-source", source);
    return JSON.parse((await viewer.saved("#export-path-json")).bytes.toString()).moves.length;
  };
  assert.equal(await viewer.page.locator("#export-source option").nth(1).innerText(), "Planned sequence");
  assert.equal(await movesOf("recording"), 1);
  assert.equal(await movesOf("guide"), steps);
  await viewer.page.keyboard.press("Escape");
  await viewer.click("#guide-close");
  await viewer.page.click("#export");
  assert.equal(await viewer.page.isVisible("#export-source"), false);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.focus("#view");
  await viewer.press("l", "Control+z");
  await viewer.idle();
});

test("the steps found until a plan is cancelled are kept, and it says how many and how long", async () => {
  await viewer.page.focus("#view");
  await viewer.press("l");
  await viewer.page.click("#plan-find");
  await banner("job")
    .filter({ hasText: /planning, [1-9]\d* steps? found/ })
    .waitFor();
  await banner("job").locator("button").click();
  await banner("job").waitFor({ state: "hidden" });
  const found = await search(); // the state came before the end of the job
  assert.equal(found?.kind, "plan");
  if (found!.cancelled) {
    assert.match(await viewer.page.locator("#plan-found").innerText(), /steps? found in [\d.]+ s, until you cancelled/);
    assert.equal((await viewer.state()).guide!.moves.length, found!.steps);
    auditPath(await guidePath());
  }
  await viewer.click("#guide-close");
  await viewer.press("l");
});

test("a search that cannot start says why", async () => {
  await viewer.select("stage plate");
  await viewer.page.keyboard.press("q");
  await viewer.page.keyboard.press("n");
  await viewer.page.locator(".toast.warning", { hasText: "another job is running" }).waitFor();
  await waitForSearch("why");
  await viewer.idle();
});

test("an automatic motion can be stopped", async () => {
  await viewer.select("pinion bush");
  await viewer.page.keyboard.press("n");
  // In the page, with the first picture of a moved component: a slow machine may have taken everything out before a key arrives.
  await viewer.page.evaluate(async () => {
    const { store } = window.dismantle!.app.session;
    while (!store.state?.automatic || !store.state.components.some(({ pose }) => pose))
      await new Promise((done) => requestAnimationFrame(done));
    window.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape", bubbles: true }));
  });
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.automatic === null);
  await viewer.idle();
  const { components } = await viewer.state();
  assert.equal(components[await viewer.index("pinion bush")].removed, undefined);
  assert.ok(components.some(({ pose }) => pose));
});

test("find a path removes the blockers, then the component; one undo entry each", async () => {
  await reset();
  await viewer.select("pinion bush");
  await viewer.press("n");
  await waitForRemoved("pinion bush");
  await viewer.idle();
  const { moves, undo } = await viewer.state();
  assert.ok(moves.length > 1, `${moves.length}`);
  assert.equal(undo, "take out pinion bush");
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.drawn("pinion bush")), false);
  await viewer.press("Control+z");
  assert.equal((await viewer.state()).moves.length, moves.length - 1);
  await reset();
});

test("N finds a path during a blocked drag; after the release, a button does", async () => {
  await viewer.select();
  await viewer.page.focus("#view");
  if (await viewer.page.evaluate(() => window.dismantle!.app.plan.opened)) await viewer.press("l");
  await viewer.press("1", "f"); // the picture may still show what was taken out
  await viewer.grab(kSlide, 0, 60);
  await banner("stuck")
    .filter({ hasText: /N: find a path/ })
    .waitFor();
  await viewer.release();
  await banner("was-stuck")
    .filter({ hasText: /specimen slide was blocked by stage plate/ })
    .waitFor();
  await banner("was-stuck").locator("button").click();
  await waitForRemoved(kSlide);
  await viewer.idle();
  await reset();
  await viewer.select();
  await viewer.page.focus("#view");
  await viewer.press("1", "f");
  await viewer.grab(kSlide, 20, 0);
  await viewer.press("n");
  await waitForRemoved(kSlide);
  await viewer.release();
  assert.equal((await viewer.state()).moves.length, 2);
  await reset();
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
