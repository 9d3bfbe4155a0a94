// SPDX-License-Identifier: Apache-2.0
// The JSON messages of docs/wire.md as types. Lengths in mm, angles in rad, times in s.

/// x, y, z
export type Triple = [number, number, number];
/// Response of the moving set to contact.
export type Response = "slide" | "touch" | "stop";
/// The moves that are played back.
export type Source = "recording" | "guide";

/// A component: its node in the tree, and its bounds when assembled.
export interface ModelComponent {
  name: string;
  node: number;
  /// The first component of the same shape.
  shape: number;
  triangles: number;
  bounds: [Triple, Triple];
}

/// The open assembly. Node 0 is the root of the tree.
export interface ModelEvent {
  number: number;
  name: string;
  /// For titles; absent in an exported page.
  product?: string;
  sha256: string;
  units: string;
  deflection: number;
  tolerance: number;
  triangles: number;
  bounds: [Triple, Triple];
  tree: { name: string; parent: number }[];
  components: ModelComponent[];
}

/// Pose and visibility of a component.
export interface ComponentState {
  /// Position and quaternion w, x, y, z; absent if the component is assembled.
  pose?: [number, number, number, number, number, number, number];
  hidden?: boolean;
  removed?: boolean;
}

/// A recorded move: its components, and its start and duration on the timeline.
export interface Move {
  label: string;
  components: number[];
  start: number;
  duration: number;
}

/// The open playback. `blocked`: where the engine stopped it, and the component in contact.
export interface Playback {
  source: Source;
  time: number;
  duration: number;
  speed: number;
  playing: boolean;
  move: number;
  blocked: { time: number; by: number | null } | null;
}

/// The blockers of the straight removal of a component.
export interface Reason {
  component: number;
  direction: Triple;
  blockers: { component: number; distance: number | null; point: Triple }[];
  together: number[];
  locked: number[];
}

/// Preferences between possible next steps of a plan.
export const kPreferences = ["direction", "upright", "groups", "support", "tools", "loose"] as const;
/// One of kPreferences.
export type Preference = (typeof kPreferences)[number];

/// Formats of work instructions.
export type InstructionsFormat = "html" | "pdf";

/// The planner's last result.
export interface Search {
  kind: "plan" | "find_path" | "why";
  complete: boolean;
  out_of_time: boolean;
  /// How many times as long as usual it searched for sliding and sampled paths.
  effort: number;
  /// With more effort, components that remain may still come out.
  effort_spent: boolean;
  cancelled: boolean;
  seconds: number;
  steps: number;
  reasons: Reason[];
  /// What has to be removed before the component, in order, and the direction in which it then leaves.
  chain: { before: number[][]; direction: Triple } | null;
}

/// The complete state of the session.
export interface StateEvent {
  number: number;
  model: number;
  components: ComponentState[];
  isolated: boolean;
  hand: { grip: number; components: number[] } | null;
  moving: number[];
  automatic: "take_out" | "put_back" | null;
  response: Response;
  /// The responses that `method` has.
  responses: Response[];
  /// What computes drags.
  method: "certificates" | "streams";
  undo: string | null;
  redo: string | null;
  moves: Move[];
  playback: Playback | null;
  guide: { name: string; moves: Move[] } | null;
  search: Search | null;
  resumed: boolean;
  resumable: boolean;
}

/// Progress of an import or a search; `fraction` is negative if unknown.
export interface JobEvent {
  job: number;
  name: string;
  stage: string;
  fraction: number;
  seconds: number;
  status: "running" | "done" | "failed" | "cancelled";
  error?: string;
}

/// The events of the server, by name.
export interface Events {
  hello: { version: string; roots: string[]; extensions: string[] };
  control: { control: boolean; clients: number };
  model: ModelEvent;
  state: StateEvent;
  job: JobEvent;
  log: { level: "note" | "warning"; text: string };
  error: { error: string };
}

/// Straight travel along a direction until the set is outside (`free`) or blocked.
export interface FreeDirection {
  direction: Triple;
  free: boolean;
  distance: number;
  blocked_by: number | null;
}

/// The state of a pair of components when assembled.
export interface CheckedPair {
  a: number;
  b: number;
  state: "contact" | "overlapping" | "near";
  contained: number | null;
  distance: number;
  depth: number;
  deepest_at: [number, number, number];
  volume: number;
}

/// Exact clearance of the moving set; `distance` is null if there is no other component.
export interface Clearance {
  distance: number | null;
  moving: number;
  fixed: number;
  point_moving: Triple;
  point_fixed: Triple;
}

/// Performance of the server.
export interface Metrics {
  steps_per_second: number;
  step_us: { median: number; p99: number; max: number };
  hand_to_pose_us: { median: number; p99: number };
  pose_frames: number;
  dropped_frames: number;
  device: string;
  clients: number;
  uptime: number;
}

type Components = { components: number[] };

/// Members and reply of each command.
export interface Commands {
  hold: [Components, { grip: number }];
  release: [object, object];
  cancel_drag: [object, object];
  set_response: [{ response: Response }, object];
  undo: [object, object];
  redo: [object, object];
  take_out: [Components & { direction?: Triple }, object];
  put_back: [Components, object];
  halt: [object, object];
  hide: [Components, object];
  show: [Components, object];
  isolate: [Components, object];
  restore: [object, object];
  reset: [object, object];
  plan: [{ targets?: number[]; fixed?: number[]; prefer?: string[]; effort?: number }, { job: number }];
  find_path: [Components, { job: number }];
  why: [Components, { job: number }];
  instructions: [
    {
      format: InstructionsFormat;
      paper?: "a4" | "letter";
      source?: Source;
      reverse?: boolean;
      product?: string;
      number?: string;
      revision?: string;
      author?: string;
      date?: string;
    },
    { job: number },
  ];
  play: [{ speed: number; source?: Source }, object];
  pause: [object, object];
  seek: [{ time: number; source?: Source }, object];
  stop: [object, object];
  save: [{ root: number; file: string }, { bytes: number }];
  open_path: [{ root: number; file: string }, object];
  close_guide: [object, object];
  open_again: [{ units: string }, { job: number }];
  open: [{ sample: string } | { root: number; file: string } | { recent: number }, { job: number }];
  cancel: [{ job: number }, object];
  resume: [object, object];
  samples: [object, { samples: { name: string; description: string }[] }];
  files: [
    { root: number; folder: string },
    { entries: { name: string; kind: "folder" | "assembly" | "path"; bytes: number }[] },
  ];
  recent: [object, { recent: { name: string; folder: string }[] }];
  free_directions: [Components, { directions: FreeDirection[] }];
  clearance: [object, Clearance];
  check: [object, { tolerance: number; pairs: CheckedPair[] }];
  metrics: [object, Metrics];
  take_control: [object, object];
}
