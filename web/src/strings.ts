// SPDX-License-Identifier: Apache-2.0
// All English text of the page. Placeholders in braces are filled in by `text`.
import { kAxisNames } from "./axes.ts";
import type { Triple } from "./wire/messages.ts";

const kEnglish = {
  title: "dismantle",
  close: "Close",
  contact: "contact",
  "toolbar.label": "Tools",
  open: "Open",
  "open.title": "Open an assembly",
  "open.samples": "Samples",
  "open.recent": "Recent",
  "open.recent.none": "No recent files.",
  "open.roots": "Files on this machine",
  "open.roots.none": "No folders to show. Start the program with --root FOLDER.",
  "open.choose": "Choose a file…",
  "open.drop": "Drop a CAD or mesh file anywhere on this page, or",
  "open.up": "Up",
  "open.lead": "Take a mechanism apart by hand. Parts stop at contact and slide along it, as real ones do.",
  undo: "Undo",
  "undo.of": "Undo: {move}",
  redo: "Redo",
  "redo.of": "Redo: {move}",
  fit: "Fit",
  projection: "Parallel projection",
  gizmo: "Gizmo",
  section: "Section",
  measure: "Measure",
  explode: "Explode",
  "explode.slider": "Steps completed",
  "explode.before": "Previous step",
  "explode.after": "Next step",
  "explode.step": "Step {step} of {count}: {label}",
  "explode.assembled": "Assembled",
  "explode.none": "Nothing to explode yet. Plan the disassembly (L), or take components out.",
  "explode.exit": "Exit exploded view",
  screenshot: "Screenshot",
  theme: "Dark or light theme",
  help: "Keys and gestures",
  stereo: "Stereo",
  "stereo.off": "Stereo (V): off",
  "stereo.sideBySide": "Stereo (V): side by side, for a 3D projector",
  "stereo.anaglyph": "Stereo (V): red/cyan glasses",
  device: "Connect a 3D mouse",
  headset: "Headset",
  "headset.refused": "Cannot start the headset session: {reason}",
  "headset.empty": "Point at a component",
  "headset.hint": "Trigger: grab. Grip: move the scene.",
  "headset.place": "Recenter",
  "headset.leave": "Exit",
  guide: "Guide",
  "guide.follow": "Use this recording as a guide",
  "guide.step": "Step {step} of {count}: remove {names}",
  "guide.practice.step": "Step {step} of {count}: what comes next?",
  "guide.done": "Done. All steps completed.",
  "guide.show": "Show the path",
  "guide.hint": "Hint",
  "guide.skip": "Skip",
  "guide.play": "Play all",
  "guide.practice": "Practice",
  "guide.score": "{points}: {wrong} out of order, {contacts}, {hints}",
  "guide.close": "Close the guide",
  export: "Export",
  "export.reverse": "Reverse: assembly instead of disassembly",
  "export.html": "Offline page (HTML)",
  "export.glb": "Animation (GLB)",
  "export.path": "Path file (JSON)",
  "export.moves": "Table of moves (CSV)",
  "export.bomCsv": "Bill of materials (CSV)",
  "export.bomJson": "Bill of materials (JSON)",
  "export.png": "Image (PNG)",
  "export.video": "Video of the playback",
  "export.making": "Creating the file…",
  "export.saved": "Saved {name}",
  steps: "Steps",
  "offline.view": "3D view. The left or right button orbits, the middle button pans.",
  "offline.cannot": "Not available here (an exported page has no engine); open the assembly in dismantle.",
  "offline.hidden": "Some components are hidden.",
  save: "Save recording",
  reset: "Assemble everything",
  response: "At contact",
  "response.slide": "Slide",
  "response.touch": "Touch",
  "response.stop": "Stop",
  "response.slide.long": "Slides along the contact",
  "response.touch.long": "Moves up to the first contact",
  "response.stop.long": "Stops at the last collision-free position",
  "view.label": "3D view. Drag a component with the left button; the right button orbits, the middle button pans.",
  "component.removed": "taken out",
  "component.moved": "moved",
  tree: "Components",
  "tree.search": "Search",
  "tree.hide": "Hide {name}",
  "tree.show": "Show {name}",
  "tree.xray": "X-ray {name}",
  "tree.empty": "{name}: without solids",
  "tree.none": "No matching component.",
  "tree.count": "{shown} of {all}",
  selection: "Selection",
  "selection.none": "Click a component, or select one in the list.",
  "selection.many": "{count} components",
  "selection.triangles": "Triangles",
  "selection.size": "Size [mm]",
  "selection.position": "Position",
  "position.assembled": "assembled",
  "position.moved": "moved {distance}",
  removal: "Removal",
  findPath: "Find a path",
  why: "What blocks it?",
  "reason.by": "Blocked along {direction} by",
  "reason.free": "It can be removed along {direction}.",
  "reason.after": "after {distance}",
  "reason.locked": "Interlocked with {names}",
  "reason.locked.many": "Interlocked with {count} other components",
  "reason.line": "{name}: blocked along {direction} by {names}",
  "names.more": "{names} and {count} more",
  plan: "Plan",
  "plan.all": "Disassemble everything",
  "plan.selection": "Only the selection",
  "plan.fixed": "Fixed: {names}",
  "plan.fixed.largest": "Fixed: the largest component",
  "plan.fix": "Fix the selection",
  "plan.unfix": "Fix the largest",
  "plan.prefer": "Preferences, in the order you tick them",
  "plan.prefer.direction": "Few changes of direction",
  "plan.prefer.upright": "No turning over (z is up)",
  "plan.prefer.groups": "Equal fasteners together",
  "plan.prefer.support": "Nothing left unsupported",
  "plan.find": "Find the sequence",
  "plan.complete": "{steps} found in {seconds} s. See the guide below.",
  "plan.partly": "{steps} found in {seconds} s. These components remain:",
  "plan.ended": "{steps} found in {seconds} s. The search stopped at its time limit.",
  takeOut: "Take out",
  putBack: "Put back",
  isolate: "Isolate",
  restore: "Show all",
  hide: "Hide",
  xray: "X-ray",
  halt: "Stop motion",
  clearance: "Clearance",
  "clearance.now": "Now",
  "clearance.min": "Minimum in this drag",
  "clearance.unknown": "–",
  contacts: "In contact with",
  "contacts.none": "No contact.",
  "contacts.idle": "Shown while a component moves.",
  "contacts.overlap": "overlap {distance}",
  pairs: "Neighbours when assembled",
  "pairs.none": "None.",
  "pairs.wait": "Checking…",
  "pair.overlapping": "{depth} deep",
  "pair.inside": "inside it",
  "pair.contains": "contains it",
  "pair.near": "{distance} apart",
  directions: "Free directions",
  "directions.find": "Find",
  "directions.free": "free",
  "directions.blocked": "{distance}, then {name}",
  "directions.none": "No free direction.",
  numeric: "Move by",
  "numeric.apply": "Move",
  "numeric.axis": "{axis} [mm]",
  "numeric.turn": "Rotate {axis} [°]",
  timeline: "Recording",
  "timeline.scrub": "Time in the recording",
  "timeline.empty": "Your moves are recorded here.",
  "timeline.start": "To the start",
  "timeline.end": "To the end",
  "timeline.before": "Previous move",
  "timeline.next": "Next move",
  "timeline.play": "Play",
  "timeline.reverse": "Play backwards",
  "timeline.pause": "Pause",
  "timeline.stop": "Exit playback",
  "timeline.speed": "Speed",
  "timeline.move": "{label}, {duration} s",
  "timeline.blocked": "Playback stopped at {name}",
  "status.label": "Status",
  "status.step": "step {time}",
  "status.rate": "{rate} steps/s",
  "status.render": "render {time} ms, {calls} draw calls",
  "status.tolerance": "tolerance {value}",
  "status.triangles": "{count} triangles",
  "status.connecting": "Connecting…",
  "status.lost": "Connection lost; reconnecting…",
  "status.open": "Connected",
  "status.clients": "{count} pages in this session",
  "banner.isolated": "Isolated: the other components are hidden but still collide.",
  "banner.hidden": "Hidden components still collide.",
  "banner.exploded": "Exploded view. Your own positions are kept.",
  "banner.playback": "Playback. Your own positions are kept.",
  "banner.watching": "View only: another page has control.",
  "banner.take": "Take control",
  "banner.lost": "Connection lost: the view may be out of date.",
  "banner.section": "Section view: parts of the model are cut away.",
  "banner.size": "The assembly is {size} long, read in {units}. Is the unit right?",
  "banner.size.units": "Unit of the file",
  "banner.size.keep": "Keep",
  "banner.resume": "An earlier session of this assembly can be resumed.",
  "banner.resume.do": "Resume",
  stuck: "Blocked by {name}",
  "stuck.free": "Blocked by {name}; free: {directions}",
  "stuck.path": "N: find a path",
  "stuck.was": "{name} was blocked by {by}.",
  "drag.locked": "along {axis}",
  "drag.depth": "towards or away from you",
  "drag.turn": "rotating",
  "job.running": "{name}: {stage}",
  "job.cancel": "Cancel",
  "job.failed": "{name}: {error}",
  saved: "Recording saved",
  "section.axis": "Section plane normal to {axis}",
  "section.flip": "Flip",
  "section.position": "Position of the section plane normal to {axis}",
  "measure.first": "Click the first point (Enter picks at the centre of the view).",
  "measure.second": "Click the second point (Enter picks at the centre of the view).",
  "measure.result": "{distance}  (x {x}, y {y}, z {z})",
  "standard.front": "Front",
  "standard.back": "Back",
  "standard.left": "Left",
  "standard.right": "Right",
  "standard.top": "Top",
  "standard.bottom": "Bottom",
  noWebGl: "WebGL 2 is not available (see the browser's graphics settings); enable hardware or software rendering.",
} as const;

/// A key or gesture, and its effect.
type KeyHelp = [keys: string, effect: string];

/// The list of keys and gestures, in titled groups.
export type Help = [title: string, rows: KeyHelp[]][];

const kNavigationHelp: KeyHelp[] = [
  ["Left drag on empty space", "Orbit"],
  ["Right drag", "Orbit, even over a component"],
  ["Middle drag", "Pan"],
  ["Wheel", "Zoom to the cursor"],
  ["Double click", "Focus a component, or everything"],
  ["F", "Fit everything, or the selection"],
  ["1 … 6", "Front, right, top, back, left, bottom"],
  ["O", "Parallel or perspective projection"],
];
const kStereoHelp: KeyHelp = ["V", "Stereo: side by side, red/cyan, off"];
const kScreenHelp: KeyHelp[] = [
  ["W", "Full screen on/off"],
  ["Arrow keys", "Orbit (with Shift: pan) while the 3D view has the focus"],
  ["+ −", "Zoom"],
];
const kSelectHelp: KeyHelp = ["Click, or Enter in the list", "Select; with Shift or Ctrl: add"];
const kShowHelp: KeyHelp[] = [
  ["Space", "Hide or show"],
  ["I", "Isolate; again: show all"],
];
const kCutHelp: KeyHelp[] = [
  ["S", "Section"],
  ["M", "Measure between two clicks; Enter picks at the centre of the view"],
];
const kPageHelp: KeyHelp[] = [
  ["T", "Dark or light theme"],
  ["/", "Search the components"],
];
const kListHelp: KeyHelp = ["H", "This list"];

/// Help of the viewer.
export const kHelp: Help = [
  ["View", [...kNavigationHelp, kStereoHelp, ...kScreenHelp]],
  [
    "Components",
    [
      kSelectHelp,
      ["Left drag on a component", "Move it with real contact"],
      ["Shift while dragging", "Towards or away from you"],
      ["Alt while dragging", "Rotate"],
      ["X Y Z", "Lock to an axis; press again to unlock"],
      ["G", "Gizmo with arrows and rings"],
      ["Esc", "Cancel the drag, or clear the selection"],
      ["Ctrl+Z, Ctrl+Y", "Undo, redo; during a drag: back to its start"],
      ["Del", "Take out"],
      ["B", "Put back"],
      ["D", "Show the free directions"],
      ["N", "Find a removal path and follow it (also while dragging)"],
      ["Q", "What blocks it?"],
      ...kShowHelp,
    ],
  ],
  [
    "Other",
    [
      ["P", "Play or pause the recording"],
      [". ,", "Next or previous move"],
      ...kCutHelp,
      ["L", "Plan the disassembly sequence"],
      ["E", "Explode: the steps of the path, with trails"],
      ...kPageHelp,
      kListHelp,
    ],
  ],
];

/// Help of an exported page.
export const kOfflineHelp: Help = [
  ["View", [...kNavigationHelp, ...kScreenHelp]],
  [
    "Other",
    [
      ["P", "Play or pause"],
      [". ,", "Play the next or previous step"],
      kSelectHelp,
      ...kShowHelp,
      ...kCutHelp,
      ...kPageHelp,
      ["Esc", "Clear the selection"],
      kListHelp,
    ],
  ],
];

/// Key of a text.
export type TextKey = keyof typeof kEnglish;

/// A text of the page, with its placeholders filled in.
export function text(key: TextKey, members: Record<string, string | number> = {}): string {
  return kEnglish[key].replace(/\{(\w+)\}/g, (_, name: string) => String(members[name] ?? ""));
}

/// "1 step", "2 steps".
export function countText(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

/// A length as text: about three significant digits, in millimetres or micrometres.
export function lengthText(millimetres: number): string {
  const size = Math.abs(millimetres);
  if (size === 0) return "0 mm";
  const sign = millimetres < 0 ? "−" : "";
  if (size < 0.1) return `${sign}${(size * 1000).toFixed(size < 0.01 ? 1 : 0)} µm`;
  return `${sign}${size.toFixed(size < 10 ? 2 : size < 100 ? 1 : 0)} mm`;
}

/// The size of an assembly as text: three significant digits, in metres above 1 m.
export function sizeText(millimetres: number): string {
  return millimetres < 1000 ? lengthText(millimetres) : `${Number((millimetres / 1000).toPrecision(3))} m`;
}

/// A unit vector as text: +Z for an axis, else its three components.
export function directionText(direction: Triple): string {
  const main = direction.findIndex((value) => Math.abs(value) > 0.9999);
  if (main >= 0) return `${direction[main] > 0 ? "+" : "−"}${kAxisNames[main]}`;
  return `(${direction.map((value) => value.toFixed(2).replace("-", "−")).join(", ")})`;
}
