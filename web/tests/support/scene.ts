// SPDX-License-Identifier: Apache-2.0
import { execFile } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
import { promisify } from "node:util";
import { closeBrowser, type OpenOptions, Server, Viewer } from "./page.ts";
import { program } from "./tree.ts";

export const kSlide = "specimen slide";

/// Of the tests of the file that called `useViewer`.
export let server: Server;
export let viewer: Viewer;

interface SceneOptions extends OpenOptions {
  /// What is done with the page before the first test. (Of several `before` of a file none waits for another.)
  prepare?: () => Promise<void>;
}

/// Starts a server with these arguments and opens a page at it for all tests of a file. At their end what they recorded
/// must pass the audit.
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

/// Ends the server, as a user does or as a crash does, and starts one with these arguments in its place; with a new page at it.
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

/// Audits go on beside the tests, one after another; audited() waits for them.
let audits: Promise<unknown> = Promise.resolve();
let auditCount = 0;
const violations: Error[] = [];

/// What is recorded in a page's session must pass the audit.
export async function audit(page = viewer, at = server): Promise<void> {
  auditPath(await page.recording(), at);
}

/// A path of the assembly that a server has open must pass the audit.
export function auditPath(text: string, at = server): void {
  const { assembly, moves } = JSON.parse(text) as { assembly: { file: string }; moves: object[] };
  if (moves.length === 0) return;
  const path = join(at.home, `audited-${++auditCount}.path.json`);
  writeFileSync(path, text);
  audits = audits
    .then(() => promisify(execFile)(program(), ["audit", at.fileOf(assembly.file), path]))
    .catch((error: Error) => violations.push(error));
}

/// Once all audits are done; throws where one failed.
export async function audited(): Promise<void> {
  await audits;
  if (violations.length > 0) throw new Error(violations.map(({ message }) => message).join("\n"));
}

/// Cuts the page's socket, as a lost network does, and waits until it is back.
export async function loseConnection(): Promise<void> {
  await viewer.page.evaluate(() => window.dismantle!.app.session.connection.reconnect());
  await viewer.page.waitForFunction(() => window.dismantle!.app.session.store.link === "open");
  await viewer.idle();
}

/// Everything as it was at first; what was recorded by then must pass the audit.
export async function reset(): Promise<void> {
  await audit();
  await viewer.click("#reset");
}

export const useMicroscope = (options: SceneOptions = {}): void => useViewer(["--sample", "microscope"], options);
