// SPDX-License-Identifier: Apache-2.0
import { button, element, type IconName, relabel, setText } from "../dom.ts";
import type { Notifier } from "../store.ts";
import { type TextKey, text } from "../strings.ts";
import { shownUnit } from "../units.ts";

interface Tool {
  icon?: IconName;
  label: TextKey;
  key?: string;
  wide?: boolean;
}

/// The toolbar's tools, by the ids of their buttons.
const kTools = {
  open: { icon: "open", label: "open", wide: true },
  save: { icon: "save", label: "save" },
  export: { icon: "share", label: "export" },
  undo: { icon: "undo", label: "undo", key: "Ctrl+Z" },
  redo: { icon: "redo", label: "redo", key: "Ctrl+Y" },
  reset: { icon: "reset", label: "reset" },
  gizmo: { icon: "move", label: "gizmo", key: "G" },
  section: { icon: "section", label: "section", key: "S" },
  measure: { icon: "measure", label: "measure", key: "M" },
  explode: { icon: "explode", label: "explode", key: "E" },
  plan: { icon: "route", label: "plan", key: "L" },
  fit: { icon: "fit", label: "fit", key: "F" },
  projection: { icon: "parallel", label: "projection", key: "O" },
  stereo: { icon: "glasses", label: "stereo", key: "V" },
  headset: { icon: "headset", label: "headset" },
  device: { icon: "puck", label: "device" },
  screenshot: { icon: "camera", label: "screenshot" },
  units: { label: "units", key: "U" },
  theme: { icon: "theme", label: "theme", key: "T" },
  help: { icon: "help", label: "help", key: "H" },
} as const satisfies Record<string, Tool>;

/// Name of a tool: the id of its button.
export type ToolName = keyof typeof kTools;

/// Makes the button of a tool.
export function toolButton(id: ToolName, press: () => void): HTMLButtonElement {
  const { icon, label, key, wide }: Tool = kTools[id];
  return button({ icon, label: text(label), key, wide, id, press });
}

/// The button that changes the unit in which lengths are shown.
export function unitButton(notifier: Notifier, press: () => void): HTMLButtonElement {
  const node = toolButton("units", press);
  let shown = "";
  const update = (): void => {
    if (shown === shownUnit()) return;
    shown = shownUnit();
    relabel(node, text("units", { unit: shown }));
    node.title += " (U)";
    setText(node.lastElementChild!, shown);
  };
  update();
  notifier.subscribe(update);
  return node;
}

/// Groups tools in the toolbar.
export function toolGroup(...children: (Node | null)[]): HTMLElement {
  return element("div", { class: "group" }, ...children);
}

/// Makes the bar at the top of the page: the program's name, then `children`.
export function toolbarNode(...children: Node[]): HTMLElement {
  return element(
    "header",
    { id: "toolbar", role: "toolbar", "aria-label": text("toolbar.label") },
    element("span", { class: "brand" }, text("title")),
    ...children,
  );
}
