// SPDX-License-Identifier: Apache-2.0
import { type PathFile, stepsOfPath } from "../guide.ts";
import type { ModelEvent } from "../wire/messages.ts";
import type { Film } from "./path_player.ts";

/// Whether this page is one that was exported and holds its model in itself.
export function isOffline(): boolean {
  return document.getElementById("offline-model") !== null;
}

/// What src/dismantle/export/offline_page.cpp put into the page.
export async function readFilm(): Promise<Film> {
  const model: ModelEvent = { ...JSON.parse(held("offline-assembly")), number: 1 };
  const path = JSON.parse(held("offline-path")) as PathFile;
  const names = model.components.map(({ name }) => name);
  return { model, glb: await inflated(held("offline-model")), steps: stepsOfPath(path, names) };
}

function held(id: string): string {
  return document.getElementById(id)?.textContent ?? "";
}

/// Of bytes in base64 that zlib compressed.
async function inflated(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}
