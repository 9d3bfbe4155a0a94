// SPDX-License-Identifier: Apache-2.0
import { type PathFile, stepsOfPath } from "../guide.ts";
import type { ModelEvent } from "../wire/messages.ts";
import type { OfflineContent } from "./path_player.ts";

/// True if this is an exported page, which contains its model.
export function isOffline(): boolean {
  return document.getElementById("offline-model") !== null;
}

/// Reads the content that src/dismantle/export/offline_page.cpp wrote into the page.
export async function readOfflineContent(): Promise<OfflineContent> {
  const model: ModelEvent = { ...JSON.parse(held("offline-assembly")), number: 1 };
  const path = JSON.parse(held("offline-path")) as PathFile;
  const names = model.components.map(({ name }) => name);
  return { model, glb: await inflated(held("offline-model")), steps: stepsOfPath(path, names) };
}

function held(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

/// Decodes base64 and inflates zlib data.
async function inflated(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}
