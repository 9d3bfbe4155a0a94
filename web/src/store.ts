// SPDX-License-Identifier: Apache-2.0

import type { Axis } from "./axes.ts";
import type { Link } from "./wire/connection.ts";
import type { CheckedPair, FreeDirection, JobEvent, Metrics, ModelEvent, StateEvent, Triple } from "./wire/messages.ts";
import type { PoseFrame } from "./wire/structs.ts";

/// A section plane.
export interface SectionPlane {
  /// The world axis that it is normal to; null: it is parallel to a face.
  axis: Axis | null;
  /// Unit normal.
  normal: Triple;
  /// Position of the face along the normal [mm]; 0 for an axis.
  base: number;
  /// Position along the normal, from `base` [mm].
  offset: number;
  /// True to keep the side against the normal.
  flipped: boolean;
}

/// Everything that the panels show. State that only this page has is listed here; all other state is the server's.
export interface Store {
  link: Link;
  roots: string[];
  /// Extensions of the files that can be opened.
  extensions: string[];
  control: boolean;
  clients: number;
  /// The running jobs; `seconds` counts on.
  jobs: Map<number, JobEvent>;
  model: ModelEvent | null;
  state: StateEvent | null;
  /// Last pose of the moving set.
  frame: PoseFrame | null;
  minClearance: number;
  metrics: Metrics | null;
  pairs: { tolerance: number; pairs: CheckedPair[] } | null;
  selection: number[];
  hovered: number | null;
  xray: Set<number>;
  blocking: Set<number>;
  directions: { components: number[]; directions: FreeDirection[] } | null;
  /// A set that was released while blocked, and the components that blocked it.
  stuck: { components: number[]; blocking: number[] } | null;
  planes: SectionPlane[];
  exploding: boolean;
  /// How far components are drawn from their positions in the quick exploded view; 0: not.
  quickExplode: number;
  gizmo: boolean;
  measuring: boolean;
  dragHint: string;
}

/// A store without model and connection.
export function emptyStore(): Store {
  return {
    link: "connecting",
    roots: [],
    extensions: [],
    control: true,
    clients: 1,
    jobs: new Map(),
    model: null,
    state: null,
    frame: null,
    minClearance: Number.NaN,
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
    quickExplode: 0,
    gizmo: false,
    measuring: false,
    dragHint: "",
  };
}

/// Notifies panels once before the next picture after any number of changes: frames arrive faster than pictures.
export class Notifier {
  private readonly listeners: (() => void)[] = [];
  private changed = false;

  /// @param requestRender schedules a render, before which `flush` must be called
  /// @param requestFrame schedules only a call of `flush`
  constructor(
    private readonly requestRender: () => void,
    private readonly requestFrame: () => void,
  ) {}

  subscribe(listener: () => void): void {
    this.listeners.push(listener);
  }

  /// Reports a change.
  notify(): void {
    this.changed = true;
    this.requestRender();
  }

  /// Reports a change of what panels alone show.
  notifyPanels(): void {
    this.changed = true;
    this.requestFrame();
  }

  /// Calls the listeners if anything changed.
  flush(): void {
    if (!this.changed) return;
    this.changed = false;
    for (const listener of this.listeners) listener();
  }
}
