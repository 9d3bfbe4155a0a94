// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Viewer } from "../support/page.ts";
import { kSlide, loseConnection, server, useMicroscope, viewer } from "../support/scene.ts";
import { slowConnection } from "../support/slow_connection.ts";

useMicroscope({ view: "1" });

test("after a lost connection the page has the state and control again", async () => {
  await viewer.grab(kSlide, 40, 0);
  await viewer.release();
  const there = await viewer.shift(kSlide);
  await loseConnection();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.control), true);
  await viewer.grab(kSlide, 20, 0);
  await viewer.release();
  assert.ok((await viewer.shift(kSlide))[0] > there[0]);
});

test("a connection lost during a drag ends it at the pose reached, with one undo entry", async () => {
  const before = (await viewer.state()).moves.length;
  await viewer.grab(kSlide, 20, 0);
  const reached = await viewer.drawnShift(kSlide);
  await loseConnection();
  const state = await viewer.state();
  assert.equal(state.hand, null);
  assert.equal(state.moves.length, before + 1);
  assert.deepEqual(await viewer.drawnShift(kSlide), reached);
  await viewer.release();
  assert.deepEqual(await viewer.shift(kSlide), reached);
  await viewer.press("Control+z");
});

test("a command sent while the connection is lost is executed once", async () => {
  await viewer.page.evaluate(() => {
    const { session } = window.dismantle!.app;
    session.connection.reconnect();
    void session.send("undo", {});
  });
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.link === "open");
  await viewer.idle();
  assert.equal((await viewer.state()).moves.length, 1);
});

test("a reloaded page shows the same session", async () => {
  const there = await viewer.shift(kSlide);
  await viewer.page.reload();
  await viewer.model();
  assert.deepEqual(await viewer.drawnShift(kSlide), there);
  assert.equal(await viewer.page.evaluate(() => window.dismantle!.app.session.store.control), true);
  await viewer.press("1");
});

test("a second page watches: it follows the first, cannot move anything, and can take control", async () => {
  const watcher = await Viewer.open(server);
  assert.equal(await watcher.page.locator("[data-banner=watching]").count(), 1);
  await viewer.page.locator("#status", { hasText: "2 pages in this session" }).waitFor();
  await viewer.grab(kSlide, 25, 0);
  await viewer.release();
  await watcher.catchUpWith(viewer);
  assert.deepEqual(await watcher.drawnShift(kSlide), await viewer.shift(kSlide));

  const before = (await viewer.state()).moves.length;
  await watcher.press("1");
  await watcher.grab(kSlide, 30, 0);
  await watcher.release();
  await viewer.catchUpWith(watcher);
  assert.equal((await viewer.state()).moves.length, before);

  await watcher.click("[data-banner=watching] button");
  await viewer.page.locator("[data-banner=watching]").waitFor();
  await watcher.press("1");
  await watcher.grab(kSlide, -20, 0);
  await watcher.release();
  assert.equal((await watcher.state()).moves.length, before + 1);
  await watcher.close();
});

test("the start page opens if the model is late, and closes when it arrives", async () => {
  const far = await Viewer.open(server, {
    waits: false,
    before: (page) => slowConnection(page, /"event":"model"/, 1000),
  });
  await far.page.locator("#open-dialog").waitFor();
  await far.model();
  assert.equal(await far.page.isVisible("#open-dialog"), false);
  await far.close();
});

test("with slow replies, the blocker of a released component is still shown", async () => {
  const far = await Viewer.open(server, { before: (page) => slowConnection(page, /"reply":/, 300) });
  await far.page.locator("[data-banner=watching] button").click();
  await far.page.locator("[data-banner=watching]").waitFor({ state: "detached" });
  await far.press("1");
  await far.grab(kSlide, 0, 60);
  await far.page.locator("[data-banner=stuck]", { hasText: /free:/ }).waitFor();
  await far.release();
  await far.page.locator("[data-banner=was-stuck]", { hasText: /blocked by stage plate/ }).waitFor();
  assert.deepEqual(far.problems, []);
  await far.close();
});

test("without the token nothing is shown, and the page reports no connection", async () => {
  const stranger = await Viewer.visit(server.url.replace(/#token=.*/, "?test"));
  await stranger.page.locator("#status-link[data-link=lost]").waitFor();
  assert.equal(await stranger.page.evaluate(() => window.dismantle!.app.viewport.model), null);
  await stranger.close();
});
