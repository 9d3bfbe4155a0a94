// SPDX-License-Identifier: Apache-2.0
import type { Move } from "./wire/messages.ts";

/// Times on the timeline that differ by less are the same [s].
export const kSameTime = 1e-6;

/// The time at which a move ends [s].
export function endOf({ start, duration }: Pick<Move, "start" | "duration">): number {
  return start + duration;
}
