// SPDX-License-Identifier: Apache-2.0
import { text } from "./strings.ts";

type Child = Node | string | null;
type Properties = Record<string, unknown>;

/// Makes an element. `class`, `data-*`, `aria-*`, `role` and `for` become attributes; `on*` and all others, properties.
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (value === undefined) continue;
    if (/^(class|role|for|data-|aria-|list)/.test(name)) node.setAttribute(name, String(value));
    else (node as unknown as Properties)[name] = value;
  }
  node.append(...children.filter((child): child is Node | string => child !== null));
  return node;
}

/// 16x16 line icons, one SVG path each.
const kIcons = {
  open: "M2 13V3h4l1.5 2H14v8zM2 7h12",
  undo: "M6 3 2.5 6.5 6 10M2.5 6.5H10a3.5 3.5 0 0 1 0 7H6",
  redo: "M10 3l3.5 3.5L10 10M13.5 6.5H6a3.5 3.5 0 0 0 0 7h4",
  eye: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM8 6a2 2 0 1 0 0 4 2 2 0 0 0 0-4z",
  eyeOff: "M1.5 8S4 3.5 8 3.5 14.5 8 14.5 8 12 12.5 8 12.5 1.5 8 1.5 8zM2.5 13.5l11-11",
  xray: "M8 1.5l5.5 3v7L8 14.5l-5.5-3v-7zM2.5 4.5 8 7.5l5.5-3M8 7.5v7",
  similar: "M2 2h5v5H2zM9 9h5v5H9zM9.5 2h4v4M2.5 10v4h4",
  isolate: "M2 5V2h3M11 2h3v3M14 11v3h-3M5 14H2v-3M6 6h4v4H6z",
  fit: "M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4",
  section: "M3 2h10v12H3zM3 14 13 2M3 9l6-7M8 14l5-6",
  measure: "M1.5 10.5l9-9 4 4-9 9zM4.5 7.5l1.5 1.5M7.5 4.5 9 6M6 6l2.5 2.5",
  parallel: "M2 5h8v8H2zM2 5l4-3h8l-4 3M14 2v8l-4 3",
  explode: "M6 6h4v4H6zM8 4V1M8 15v-3M4 8H1M15 8h-3",
  camera: "M2 5h3l1-2h4l1 2h3v8H2zM8 6.5a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5z",
  theme: "M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12",
  glasses: "M1.5 6h13M2 6v3a2.5 2.5 0 0 0 5 0V6M9 6v3a2.5 2.5 0 0 0 5 0V6",
  headset: "M2 5h12v6h-3.500L9 9.500H7L5.500 11H2zM2 7H.8M14 7h1.200",
  puck: "M3 6.5a5 2.5 0 0 1 10 0v2a5 2.5 0 0 1-10 0zM2 11.5c0 1.5 2.7 2.5 6 2.5s6-1 6-2.5M3 6.5a5 2.5 0 0 0 10 0",
  help: "M5.5 6a2.5 2.5 0 1 1 3.5 2.300c-.7.3-1 .7-1 1.700M8 12.5v.5",
  play: "M4.5 2.5v11l9-5.5z",
  playBack: "M11.5 2.5v11l-9-5.5z",
  pause: "M5 3v10M11 3v10",
  start: "M3 3v10M13 3 6 8l7 5z",
  end: "M13 3v10M3 3l7 5-7 5z",
  stepBack: "M7 4 3 8l4 4M12 4 8 8l4 4",
  stepOn: "M4 4l4 4-4 4M9 4l4 4-4 4",
  close: "M4 4l8 8M12 4l-8 8",
  out: "M8 10V2M5 5l3-3 3 3M3 9v5h10V9",
  back: "M8 2v8M5 7l3 3 3-3M3 9v5h10V9",
  share: "M9 2h5v5M14 2 7.5 8.500M12 9.500V14H2V4h4.500",
  save: "M2.5 2.5h9l2 2v9h-11zM5 2.5v4h5v-4M5 13.5v-4h6v4",
  move: "M8 1.5v13M1.5 8h13M6 3.5l2-2 2 2M6 12.5l2 2 2-2M3.5 6l-2 2 2 2M12.5 6l2 2-2 2",
  chevron: "M6 4l4 4-4 4",
  reset: "M3 3v4h4M3 7a5.5 5.5 0 1 1-.5 3",
  arrow: "M2 8h11M9 4l4 4-4 4",
  route:
    "M3 13.5a1.500 1.500 0 1 0 0-.01zM4.5 13.5H11a3 3 0 0 0 0-6H6a2.500 2.500 0 0 1 0-5h6.500M10.500.8l2 1.700-2 1.700",
  guide: "M3 2.5h10v11H3zM5.5 5.5h5M5.5 8h5M5.5 10.5h3",
} as const;

/// Name of an icon.
export type IconName = keyof typeof kIcons;

/// Makes an icon, hidden from screen readers.
export function icon(name: IconName): SVGSVGElement {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(space, "path");
  path.setAttribute("d", kIcons[name]);
  svg.append(path);
  return svg;
}

/// Options of a button.
export interface ButtonOptions {
  icon?: IconName;
  label: string;
  /// Shows the label beside the icon.
  wide?: boolean;
  /// The key with the same effect, shown in the tooltip.
  key?: string;
  id?: string;
  class?: string;
  press: () => void;
}

/// Makes a button. Its label is its accessible name and, with the key, its tooltip.
export function button(options: ButtonOptions): HTMLButtonElement {
  const { label, wide, key } = options;
  const title = key ? `${label} (${key})` : label;
  return element(
    "button",
    {
      type: "button",
      class: `button ${wide ? "wide" : ""} ${options.class ?? ""}`,
      id: options.id ?? "",
      title,
      "aria-label": label,
      onclick: options.press,
    },
    options.icon ? icon(options.icon) : null,
    wide || !options.icon ? element("span", {}, label) : null,
  );
}

/// A button that looks like a link.
export function linkButton(label: string, press: () => void): HTMLButtonElement {
  return element("button", { type: "button", class: "link-button", onclick: press }, label);
}

/// The header of a dialog: its title and a button that closes it.
export function dialogHeader(title: string, close: () => void): HTMLElement {
  return element("header", {}, element("h1", {}, title), button({ icon: "close", label: text("close"), press: close }));
}

/// Adds the canvas of the 3D view to the page, in the area over which panels float.
export function makeStage(label: string): { stage: HTMLElement; canvas: HTMLCanvasElement } {
  const canvas = element("canvas", { id: "view", tabIndex: 0, role: "application", "aria-label": label });
  const stage = element("main", { id: "stage" }, canvas);
  document.body.append(stage);
  return { stage, canvas };
}

/// The header of a panel beside the view: its title and a button that closes it.
export function panelHeader(title: string, close: () => void): HTMLElement {
  return element(
    "header",
    {},
    element("h2", {}, title),
    button({ icon: "close", label: text("close"), class: "tiny", press: close }),
  );
}

/// Changes the label of a button that shows its label and has no key.
export function relabel(node: HTMLButtonElement, label: string): void {
  setText(node.lastElementChild!, label);
  node.title = label;
  node.setAttribute("aria-label", label);
}

/// Sets a text only if it changed, so that screen readers do not repeat it.
export function setText(node: Node, content: string): void {
  if (node.textContent !== content) node.textContent = content;
}

/// Has the browser save a file.
export function saveAs(content: Blob, file: string): void {
  const address = URL.createObjectURL(content);
  element("a", { href: address, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
