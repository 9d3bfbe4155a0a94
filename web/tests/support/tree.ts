// SPDX-License-Identifier: Apache-2.0
import { join } from "node:path";

/// Where things are: web/test says so.
function setting(name: string): string {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set; run the tests by web/test`);
  return value;
}

export const sourceFolder = (): string => setting("DISMANTLE_SOURCE_DIR");
export const program = (): string => setting("DISMANTLE_PROGRAM");
export const chromium = (): string => setting("DISMANTLE_CHROMIUM");
export const goldenFile = (name: string): string => join(sourceFolder(), "tests/server/golden", name);

/// For work on the page: a folder to be served in place of the page that is in the program.
export const pageFolder = (): string[] => (process.env.DISMANTLE_WEB ? ["--web", process.env.DISMANTLE_WEB] : []);
