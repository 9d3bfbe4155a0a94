// SPDX-License-Identifier: Apache-2.0
// The lists of keys and gestures.

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
const kSelectHelp: KeyHelp[] = [
  ["Click, or Enter in the list", "Select; with Ctrl: add; with Shift in the list: everything in between"],
  ["Shift drag on empty space", "Select by a box; drawn to the left, also what it crosses"],
];
const kShowHelp: KeyHelp[] = [
  ["Space", "Hide or show"],
  ["I", "Isolate; again: show all"],
];
const kCutHelp: KeyHelp[] = [
  ["S", "Section"],
  ["M", "Measure between two clicks; Enter picks at the centre of the view"],
];
const kPageHelp: KeyHelp[] = [
  ["U", "Lengths in millimetres or inches"],
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
      ...kSelectHelp,
      ["Right click", "Menu of the component"],
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
      ...kSelectHelp,
      ...kShowHelp,
      ...kCutHelp,
      ...kPageHelp,
      ["Esc", "Clear the selection"],
      kListHelp,
    ],
  ],
];
