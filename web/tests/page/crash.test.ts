// SPDX-License-Identifier: Apache-2.0
// Sessions after a crash and after a normal end of the server.
import assert from "node:assert/strict";
import { test } from "node:test";
import { audit, kSlide, restart, useMicroscope, viewer } from "../support/scene.ts";

const kOptions = { view: "1" };
useMicroscope(kOptions);
const startAgain = (signal: "SIGTERM" | "SIGKILL") => restart(signal, ["--sample", "microscope"], kOptions);

test("a server killed during a drag resumes with the drag's last pose, and the recording passes the audit", async () => {
  await viewer.grab("foot", 0, 20);
  await viewer.release();
  await viewer.grab(kSlide, 60, 0);
  const [slide, foot] = [await viewer.drawnShift(kSlide), await viewer.drawnShift("foot")];
  assert.ok(slide[0] > 10 && foot[2] < -3, `${slide} ${foot}`);
  await startAgain("SIGKILL");
  const state = await viewer.state();
  assert.equal(state.resumed, true);
  assert.equal(state.hand, null);
  assert.equal(state.moves.length, 2);
  assert.deepEqual(await viewer.drawnShift(kSlide), slide);
  assert.deepEqual(await viewer.shift("foot"), foot);
  await viewer.grab(kSlide, 30, 0);
  await viewer.release();
  assert.ok((await viewer.shift(kSlide))[0] > slide[0]);
  await audit();
  await viewer.press("Control+z", "Control+z", "Control+z");
  assert.deepEqual(await viewer.drawnShift(kSlide), [0, 0, 0]);
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  await viewer.press("Control+y");
});

test("a session that ended normally can be resumed on request", async () => {
  const foot = await viewer.shift("foot");
  await startAgain("SIGTERM");
  assert.deepEqual(await viewer.drawnShift("foot"), [0, 0, 0]);
  await viewer.click("[data-banner=resume] button");
  assert.deepEqual(await viewer.drawnShift("foot"), foot);
  assert.equal((await viewer.state()).moves.length, 1);
  assert.equal(await viewer.page.locator("[data-banner=resume]").count(), 0);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
