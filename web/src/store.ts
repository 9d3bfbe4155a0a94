// SPDX-License-Identifier: Apache-2.0

import type { Link } from "./wire/connection.ts";
import type { CheckedPair, FreeDirection, JobEvent, Metrics, ModelEvent, StateEvent } from "./wire/messages.ts";
import type { PoseFrame } from "./wire/structs.ts";

export interface SectionPlane {
  axis: 0 | 1 | 2;
  /// Keeps what is beyond the plane, not what is before it.
  flipped: boolean;
  /// Where it is between the model's bounds, from 0 to 1.
  part: number;
}

/// All that the panels show. What only this page knows is here; everything else is the server's.
export interface Store {
  link: Link;
  roots: string[];
  control: boolean;
  clients: number;
  jobs: Map<number, JobEvent>;
  model: ModelEvent | null;
  state: StateEvent | null;
  /// The last pose of what moves now.
  frame: PoseFrame | null;
  leastClearance: number;
  metrics: Metrics | null;
  pairs: { tolerance: number; pairs: CheckedPair[] } | null;
  selection: number[];
  hovered: number | null;
  xray: Set<number>;
  blocking: Set<number>;
  directions: { components: number[]; directions: FreeDirection[] } | null;
  /// What was let go of while it was blocked, and by what.
  stuck: { components: number[]; blocking: number[] } | null;
  planes: SectionPlane[];
  exploding: boolean;
  gizmo: boolean;
  measuring: boolean;
  dragHint: string;
}

export function emptyStore(): Store {
  return {
    link: "connecting",
    roots: [],
    control: true,
    clients: 1,
    jobs: new Map(),
    model: null,
    state: null,
    frame: null,
    leastClearance: Number.NaN,
    metrics: null,
    pairs: null,
    selection: [],
    hovered: null,
    xray: new Set(),
    blocking: new Set(),
    directions: null,
    stuck: null,
    planes: [],
    exploding: false,
    gizmo: false,
    measuring: false,
    dragHint: "",
  };
}

/// Calls panels once after any number of changes, before the next picture: poses come faster than pictures.
export class Notifier {
  private readonly listeners: (() => void)[] = [];
  private changed = false;

  /// @param ask asks for a picture, before which `tell` is to be called
  constructor(private readonly ask: () => void) {}

  subscribe(listener: () => void): void {
    this.listeners.push(listener);
  }

  notify(): void {
    this.changed = true;
    this.ask();
  }

  tell(): void {
    if (!this.changed) return;
    this.changed = false;
    for (const listener of this.listeners) listener();
  }
}
