// SPDX-License-Identifier: Apache-2.0
import type { Axis } from "../axes.ts";
import { kStandardViews } from "../scene/view_cube.ts";
import type { Viewport } from "../scene/viewport.ts";

const kOrbitStep = 40;
const kPanStep = 40;
const kZoomFactor = 1.2;

type Act = () => void;
type Action =
  | "undo"
  | "redo"
  | "fit"
  | "projection"
  | "stereo"
  | "fullScreen"
  | "gizmo"
  | "section"
  | "measure"
  | "theme"
  | "units"
  | "help"
  | "play"
  | "directions"
  | "plan"
  | "findPath"
  | "why"
  | "explode"
  | "isolate"
  | "putBack"
  | "takeOut"
  | "escape"
  | "search"
  | "toggleHidden"
  | "nextStep"
  | "previousStep";

/// A page with keyboard actions. Keys of actions that it lacks have no effect.
export interface KeyTarget {
  readonly viewport: Viewport;
  readonly drag: { readonly active: boolean };
  readonly actions: { readonly [Name in Action]?: Act };
  lockAxis?(axis: Axis): void;
}

/// Connects the keyboard to the page's actions. Keys typed into a field are left to the field.
export function listenForKeys(app: KeyTarget): void {
  window.addEventListener("keydown", (event) => {
    if (isTyping(event) || document.querySelector("dialog[open]")) return;
    const act = event.ctrlKey || event.metaKey ? controlKey(app, event) : plainKey(app, event);
    if (!act) return;
    event.preventDefault();
    act();
  });
  const byKeyboard = (yes: boolean) => document.documentElement.toggleAttribute("data-keyboard", yes);
  window.addEventListener("keydown", ({ key }) => key === "Tab" && byKeyboard(true));
  window.addEventListener("pointerdown", () => byKeyboard(false), true);
  // A button that was clicked does not keep the focus: the space key means Hide again, and not the button.
  window.addEventListener("click", ({ detail, target }) => {
    const focused = document.activeElement;
    const isPointer = detail > 0;
    if (
      isPointer &&
      focused instanceof HTMLButtonElement &&
      focused.contains(target as Node) &&
      !focused.closest("dialog")
    )
      focused.blur();
  });
  // Alt alone would open the browser's menu while a component is rotated.
  window.addEventListener("keyup", (event) => {
    if (event.key === "Alt" && app.drag.active) event.preventDefault();
  });
}

function isTyping(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  if (event.key === "Escape") return false;
  if (target instanceof HTMLInputElement)
    return !["checkbox", "radio", "range"].includes(target.type) || event.key === " ";
  if (target instanceof HTMLButtonElement) return event.key === " " || event.key === "Enter";
  return target instanceof HTMLSelectElement;
}

function controlKey(app: KeyTarget, event: KeyboardEvent): Act | undefined {
  const key = event.key.toLowerCase();
  if (key === "z") return event.shiftKey ? app.actions.redo : app.actions.undo;
  if (key === "y") return app.actions.redo;
  return undefined;
}

function plainKey(app: KeyTarget, event: KeyboardEvent): Act | undefined {
  const { actions } = app;
  const view = kStandardViews.find(({ key }) => key === event.key);
  if (view) return () => app.viewport.rig.lookFrom(view.direction);
  const keys: Record<string, Act | undefined> = {
    f: actions.fit,
    o: actions.projection,
    v: actions.stereo,
    w: actions.fullScreen,
    g: actions.gizmo,
    s: actions.section,
    m: actions.measure,
    e: actions.explode,
    t: actions.theme,
    u: actions.units,
    h: actions.help,
    p: actions.play,
    ".": actions.nextStep,
    ",": actions.previousStep,
    d: actions.directions,
    l: actions.plan,
    n: actions.findPath,
    q: actions.why,
    i: actions.isolate,
    b: actions.putBack,
    delete: actions.takeOut,
    escape: actions.escape,
    "/": actions.search,
    " ": actions.toggleHidden,
    x: () => app.lockAxis?.(0),
    y: () => app.lockAxis?.(1),
    z: () => app.lockAxis?.(2),
  };
  return keys[event.key.toLowerCase()] ?? viewKey(app, event);
}

function viewKey(app: KeyTarget, event: KeyboardEvent): Act | undefined {
  const { rig, canvas } = app.viewport;
  if (event.key === "+" || event.key === "=") return () => rig.zoom(1 / kZoomFactor, rig.current.focus);
  if (event.key === "-") return () => rig.zoom(kZoomFactor, rig.current.focus);
  const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
  if (!step || document.activeElement !== canvas) return undefined;
  const { focus } = rig.current;
  if (event.shiftKey) return () => rig.pan(-step[0] * kPanStep, -step[1] * kPanStep, focus);
  return () => rig.orbit(step[0] * kOrbitStep, step[1] * kOrbitStep, focus);
}
