// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import type { GuideStep } from "../../src/guide.ts";
import { PathPlayer } from "../../src/offline/path_player.ts";
import type { ModelEvent, StateEvent } from "../../src/wire/messages.ts";
import type { WirePose } from "../../src/wire/structs.ts";

const at = (x: number): WirePose => ({ position: [x, 0, 0], rotation: [1, 0, 0, 0] });
const step = (component: number, from: number, to: number, duration: number): GuideStep => ({
  label: `step of ${component}`,
  components: [component],
  frames: [
    { t: 0, pose: at(from) },
    { t: duration, pose: at(to) },
  ],
  duration,
});
const model = { number: 1, name: "vice.step", components: [{}, {}, {}] } as unknown as ModelEvent;

function started(...steps: GuideStep[]): { player: PathPlayer; state: () => StateEvent } {
  const player = new PathPlayer({ model, glb: new ArrayBuffer(4), steps });
  let state: StateEvent | null = null;
  player.on("state", (event) => {
    state = event;
  });
  player.connect();
  return { player, state: () => state! };
}

const shifts = (state: StateEvent) => state.components.map(({ pose }) => pose?.[0] ?? 0);

test("playback starts where the path does", () => {
  const apart = started(step(0, 0, 10, 2), step(1, 0, 20, 4));
  assert.deepEqual(shifts(apart.state()), [0, 0, 0]);
  const together = started(step(1, 20, 0, 4), step(0, 10, 0, 2));
  assert.deepEqual(shifts(together.state()), [10, 20, 0]);
});

test("a seek sets the pose of every component", async () => {
  const { player, state } = started(step(0, 0, 10, 2), step(1, 0, 20, 4));
  await player.command("seek", { time: 1 });
  assert.deepEqual(shifts(state()), [5, 0, 0]);
  await player.command("seek", { time: 3 });
  assert.deepEqual(shifts(state()), [10, 5, 0]);
  assert.deepEqual(state().moving, [1]);
  assert.equal(state().playback?.move, 1);
  await player.command("seek", { time: 99 });
  assert.equal(state().playback?.time, 6);
});

test("components at their assembled position have no pose", async () => {
  const { player, state } = started(step(1, 20, 0, 4));
  await player.command("seek", { time: 4 });
  assert.equal(state().components[1].pose, undefined);
});

test("hide and isolate can be undone", async () => {
  const { player, state } = started(step(0, 0, 10, 2));
  const hidden = () => state().components.map((c) => c.hidden === true);
  await player.command("hide", { components: [2] });
  await player.command("isolate", { components: [1] });
  assert.deepEqual([hidden(), state().isolated], [[true, false, true], true]);
  await player.command("restore", {});
  assert.deepEqual([hidden(), state().isolated], [[false, false, true], false]);
  await player.command("show", { components: [2] });
  assert.deepEqual(hidden(), [false, false, false]);
});

test("commands that need an engine are refused with a message", async () => {
  const { player } = started(step(0, 0, 10, 2));
  await assert.rejects(player.command("hold", { components: [0] }), /no engine/);
  await assert.rejects(player.request("/api/path.json"), /no engine/);
});

test("the model is served as by the server", async () => {
  const { player } = started();
  assert.equal((await (await player.request("/api/model.glb?model=1")).arrayBuffer()).byteLength, 4);
});

test("a page without a path has no steps", () => {
  const { state } = started();
  assert.deepEqual([state().moves, state().moving, state().playback?.duration], [[], [], 0]);
});
