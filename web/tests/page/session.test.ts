// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Viewer } from "../support/page.ts";
import { kSlide, loseConnection, server, useMicroscope, viewer } from "../support/scene.ts";
import { slowLine } from "../support/slow_line.ts";

useMicroscope({ view: "1" });

test("a lost connection comes back with the state and the control", async () => {
  await viewer.grab(kSlide, 40, 0);
  await viewer.letGo();
  const there = await viewer.shift(kSlide);
  await loseConnection();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.control), true);
  await viewer.grab(kSlide, 20, 0);
  await viewer.letGo();
  assert.ok((await viewer.shift(kSlide))[0] > there[0]);
});

test("a connection that is lost in mid-drag: what the drag reached is one entry, and the hand is empty", async () => {
  const before = (await viewer.state()).moves.length;
  await viewer.grab(kSlide, 20, 0);
  const reached = await viewer.drawnShift(kSlide);
  await loseConnection();
  const state = await viewer.state();
  assert.equal(state.hand, null);
  assert.equal(state.moves.length, before + 1);
  assert.deepEqual(await viewer.drawnShift(kSlide), reached);
  await viewer.letGo();
  assert.deepEqual(await viewer.shift(kSlide), reached);
  await viewer.press("Control+z");
});

test("what is asked while the connection is lost is done once when it is back", async () => {
  await viewer.page.evaluate(() => {
    const { session } = window.dismantle!.app;
    session.connection.reconnect();
    void session.ask("undo", {});
  });
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.link === "open");
  await viewer.idle();
  assert.equal((await viewer.state()).moves.length, 1);
});

test("a page that is loaded again shows the same session", async () => {
  const there = await viewer.shift(kSlide);
  await viewer.page.reload();
  await viewer.model();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.control), true);
  await viewer.press("1");
});

test("a second page watches: it sees what the first moves, may move nothing, and can take control", async () => {
  const watcher = await Viewer.open(server);
  assert.equal(await watcher.page.locator("[data-banner=watching]").count(), 1);
  await viewer.page.locator("#status", { hasText: "2 in this session" }).waitFor();
  await viewer.grab(kSlide, 25, 0);
  await viewer.letGo();
  await watcher.catchUpWith(viewer);
  assert.deepEqual(await watcher.drawnShift(kSlide), await viewer.shift(kSlide));

  const before = (await viewer.state()).moves.length;
  await watcher.press("1");
  await watcher.grab(kSlide, 30, 0);
  await watcher.letGo();
  await viewer.catchUpWith(watcher);
  assert.equal((await viewer.state()).moves.length, before);

  await watcher.click("[data-banner=watching] button");
  await viewer.page.locator("[data-banner=watching]").waitFor();
  await watcher.press("1");
  await watcher.grab(kSlide, -20, 0);
  await watcher.letGo();
  assert.equal((await watcher.state()).moves.length, before + 1);
  await watcher.close();
});

test("where the model comes late the start page shows itself, and goes when it is there", async () => {
  const far = await Viewer.open(server, { waits: false, before: (page) => slowLine(page, /"event":"model"/, 1000) });
  await far.page.locator("#open-dialog").waitFor();
  await far.model();
  assert.equal(await far.page.isVisible("#open-dialog"), false);
  await far.close();
});

test("where answers come late it is still said what kept a component that was let go of", async () => {
  const far = await Viewer.open(server, { before: (page) => slowLine(page, /"reply":/, 300) });
  await far.page.locator("[data-banner=watching] button").click();
  await far.page.locator("[data-banner=watching]").waitFor({ state: "detached" });
  await far.press("1");
  await far.grab(kSlide, 0, 60);
  await far.page.locator("[data-banner=stuck]", { hasText: /free:/ }).waitFor();
  await far.letGo();
  await far.page.locator("[data-banner=was-stuck]", { hasText: /blocked by stage plate/ }).waitFor();
  assert.deepEqual(far.problems, []);
  await far.close();
});

test("without the token nothing is shown, and the page says that it has no connection", async () => {
  const stranger = await Viewer.visit(server.url.replace(/#token=.*/, "?test"));
  await stranger.page.locator("#status-link[data-link=lost]").waitFor();
  assert.equal(await stranger.page.evaluate(() => window.dismantle!.app.viewport.model), null);
  await stranger.close();
});
