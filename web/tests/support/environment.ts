// SPDX-License-Identifier: Apache-2.0
import { join } from "node:path";

/// A setting made by web/test.
function setting(name: string): string {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set; run the tests by web/test`);
  return value;
}

export const sourceFolder = (): string => setting("DISMANTLE_SOURCE_DIR");
export const program = (): string => setting("DISMANTLE_PROGRAM");
export const chromium = (): string => setting("DISMANTLE_CHROMIUM");
export const goldenFile = (name: string): string => join(sourceFolder(), "tests/server/golden", name);

/// Options that serve a page from a folder in place of the built-in one.
export const pageFolder = (): string[] => (process.env.DISMANTLE_WEB ? ["--web", process.env.DISMANTLE_WEB] : []);
