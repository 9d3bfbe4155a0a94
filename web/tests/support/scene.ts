// SPDX-License-Identifier: Apache-2.0
import { execFile } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { promisify } from "node:util";
import { program } from "./environment.ts";
import { closeBrowser, type OpenOptions, Server, Viewer } from "./page.ts";

export const kSlide = "specimen slide";

/// The server and the page of the test file that called `useViewer`.
export let server: Server;
export let viewer: Viewer;

interface SceneOptions extends OpenOptions {
  /// Prepares the page before the first test. (Several `before` hooks of a file do not wait for each other.)
  prepare?: () => Promise<void>;
}

/// Starts a server and opens a page for all tests of a file. At the end, their recording must pass the audit.
export function useViewer(arguments_: string[], { prepare, ...options }: SceneOptions = {}): void {
  before(async () => {
    server = await Server.start(...arguments_);
    viewer = await Viewer.open(server, options);
    await prepare?.();
  });
  after(async () => {
    try {
      await audit();
      await audited();
    } finally {
      await closeBrowser();
      await server.stop();
    }
  });
}

/// Ends the server, normally or by a crash, and starts another one with a new page.
export async function restart(
  signal: "SIGTERM" | "SIGKILL",
  arguments_: string[],
  options: OpenOptions = {},
): Promise<void> {
  await server.end(signal);
  if (signal === "SIGKILL") await viewer.page.locator("[data-banner=lost]").waitFor();
  await viewer.close();
  server = await Server.startIn(server.home, ...arguments_);
  viewer = await Viewer.open(server, options);
}

/// Audits run beside the tests, one after another; `audited` waits for them.
let audits: Promise<unknown> = Promise.resolve();
let auditCount = 0;
const violations: Error[] = [];

/// Audits the recording of a page's session.
export async function audit(page = viewer, at = server): Promise<void> {
  auditPath(await page.recording(), at);
}

/// Audits a path of the server's assembly.
export function auditPath(text: string, at = server): void {
  const { assembly, moves } = JSON.parse(text) as { assembly: { file: string }; moves: object[] };
  if (moves.length === 0) return;
  const path = join(at.home, `audited-${++auditCount}.path.json`);
  writeFileSync(path, text);
  audits = audits
    .then(() => promisify(execFile)(program(), ["audit", at.fileOf(assembly.file), path]))
    .catch((error: Error) => violations.push(error));
}

/// Waits for all audits; throws if one failed.
export async function audited(): Promise<void> {
  await audits;
  if (violations.length > 0) throw new Error(violations.map(({ message }) => message).join("\n"));
}

/// Drops the page's connection and waits until it is restored.
export async function loseConnection(): Promise<void> {
  await viewer.page.evaluate(() => window.dismantle!.app.session.connection.reconnect());
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.link === "open");
  await viewer.idle();
}

/// Audits the recording, then assembles everything.
export async function reset(): Promise<void> {
  await audit();
  await viewer.click("#reset");
}

/// Waits for a result of the planner.
export const waitForSearch = (kind: string) =>
  viewer.page.waitForFunction((k) => window.dismantle!.app.session.store.state!.search?.kind === k, kind);

/// Waits until no automatic motion is left and a component is removed, or not.
export const waitForRemoved = async (name: string, removed = true) => {
  await viewer.page.waitForFunction(
    ([component, wanted]) => {
      const { components, automatic } = window.dismantle!.app.session.store.state!;
      return automatic === null && Boolean(components[component as number].removed) === wanted;
    },
    [await viewer.index(name), removed] as const,
  );
};

/// Waits until the recording has so many moves.
export const waitForMoves = (count: number) =>
  viewer.page.waitForFunction((n) => window.dismantle!.app.session.store.state!.moves.length === n, count);

/// Waits until nothing is held.
export const waitForEmptyHand = () =>
  viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.hand === null);

/// Waits until the playback stands still.
export const waitForPlaybackEnd = () =>
  viewer.page.waitForFunction(() => window.dismantle!.app.session.store.state!.playback?.playing === false);

/// The components that the guide highlights as the next ones.
export const highlighted = () =>
  viewer.page.evaluate(() =>
    window
      .dismantle!.app.viewport.model!.components.filter(({ appearance }) => appearance.next)
      .map(({ raw }) => raw.name),
  );

/// The guide as a path file.
export const guidePath = () =>
  viewer.page.evaluate(async () => (await window.dismantle!.app.session.connection.request("/api/guide.json")).text());

/// The camera's view.
export const camera = () =>
  viewer.page.evaluate(() => {
    const { focus, orientation, distance } = window.dismantle!.app.viewport.rig.current;
    return { focus: focus.toArray(), orientation: orientation.toArray(), distance };
  });

/// Drags with a mouse button in the view.
export async function dragView(
  button: "left" | "middle" | "right",
  { x, y }: { x: number; y: number },
  dx: number,
  dy: number,
): Promise<void> {
  await viewer.page.mouse.move(x, y);
  await viewer.page.mouse.down({ button });
  await viewer.page.mouse.move(x + dx, y + dy, { steps: 4 });
  await viewer.page.mouse.up({ button });
  await viewer.idle();
}

export const useMicroscope = (options: SceneOptions = {}): void => useViewer(["--sample", "microscope"], options);
