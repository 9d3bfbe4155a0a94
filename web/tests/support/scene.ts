// SPDX-License-Identifier: Apache-2.0
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before } from "node:test";
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
    } finally {
      await closeBrowser();
      await server.stop();
    }
  });
}

/// What is recorded in a page's session must pass the audit.
export async function audit(page = viewer, at = server): Promise<void> {
  auditPath(await page.recording(), at);
}

/// A path of the assembly that a server has open must pass the audit.
export function auditPath(text: string, at = server): void {
  const { assembly, moves } = JSON.parse(text) as { assembly: { file: string }; moves: object[] };
  if (moves.length === 0) return;
  const path = join(at.home, "audited.path.json");
  writeFileSync(path, text);
  execFileSync(program(), ["audit", at.fileOf(assembly.file), path]);
}

/// Everything as it was at first; what was recorded by then must pass the audit.
export async function reset(): Promise<void> {
  await audit();
  await viewer.click("#reset");
}

export const useMicroscope = (options: SceneOptions = {}): void => useViewer(["--sample", "microscope"], options);
