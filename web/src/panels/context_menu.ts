// SPDX-License-Identifier: Apache-2.0
import { element } from "../dom.ts";
import type { Session } from "../session.ts";
import { type TextKey, text } from "../strings.ts";

/// What the entries do, on the selection.
type Actions = Record<
  | "takeOut"
  | "putBack"
  | "toggleHidden"
  | "showAll"
  | "isolate"
  | "xray"
  | "selectSimilar"
  | "findPath"
  | "why"
  | "directions"
  | "fit",
  () => void
>;

interface Entry {
  action: keyof Actions;
  label: TextKey;
  key?: string;
}

const kOfSelection: Entry[] = [
  { action: "takeOut", label: "takeOut", key: "Del" },
  { action: "putBack", label: "putBack", key: "B" },
  { action: "findPath", label: "findPath", key: "N" },
  { action: "why", label: "why", key: "Q" },
  { action: "directions", label: "directions", key: "D" },
  { action: "selectSimilar", label: "selectSimilar" },
  { action: "toggleHidden", label: "hide", key: "Space" },
  { action: "isolate", label: "isolate", key: "I" },
  { action: "xray", label: "xray" },
  { action: "fit", label: "fit", key: "F" },
];
const kOfView: Entry[] = [
  { action: "showAll", label: "restore" },
  { action: "fit", label: "fit", key: "F" },
];
const kMargin = 8;

/// The menu of the right mouse button: what can be done with the component under the cursor and the rest of the
/// selection.
export class ContextMenu {
  readonly node = element("div", { id: "context-menu", class: "floating", role: "menu", hidden: true });
  private opener: HTMLElement | null = null;

  constructor(
    private readonly session: Session,
    private readonly actions: Actions,
  ) {
    this.node.onkeydown = (event) => this.onKey(event);
    this.node.oncontextmenu = (event) => event.preventDefault();
    document.addEventListener(
      "pointerdown",
      ({ target }) => this.node.contains(target as Node) || this.close(false),
      true,
    );
    window.addEventListener("blur", () => this.close(false));
    window.addEventListener("resize", () => this.close(false));
  }

  /// Opens the menu at a point of the page, for a component or for the view. A component that is not selected becomes the
  /// selection.
  open(components: number[], x: number, y: number): void {
    const { selection } = this.session.store;
    if (components.some((c) => !selection.includes(c))) this.session.select(components);
    this.opener = document.activeElement as HTMLElement | null;
    const entries = components.length > 0 ? kOfSelection : kOfView;
    this.node.replaceChildren(...entries.map((entry) => this.item(entry)));
    this.node.setAttribute("aria-label", text(components.length > 0 ? "selection" : "menu.view"));
    this.node.hidden = false;
    const { width, height } = this.node.getBoundingClientRect();
    this.node.style.left = `${Math.max(kMargin, Math.min(x, innerWidth - width - kMargin))}px`;
    this.node.style.top = `${Math.max(kMargin, Math.min(y, innerHeight - height - kMargin))}px`;
    this.items()
      .find((item) => !item.disabled)
      ?.focus();
  }

  private item({ action, label, key }: Entry): HTMLElement {
    const press = () => {
      this.close(true);
      this.actions[action]();
    };
    const node = element(
      "button",
      { type: "button", role: "menuitem", tabIndex: -1, "data-action": action, onclick: press },
      element("span", {}, text(label)),
      element("kbd", {}, key ?? ""),
    );
    node.disabled = !this.isPossible(action);
    return node;
  }

  private isPossible(action: keyof Actions): boolean {
    const { state, selection, control } = this.session.store;
    const states = selection.map((c) => state?.components[c]);
    const idle = control && this.session.idle;
    if (action === "takeOut" || action === "findPath") return idle && states.some((s) => !s?.removed);
    if (action === "putBack") return idle && states.some((s) => s?.pose || s?.removed);
    if (action === "why") return idle && selection.length === 1 && !states[0]?.removed;
    if (action === "showAll") return control && this.session.hasHidden;
    if (action === "toggleHidden" || action === "isolate") return control;
    return action !== "directions" || this.session.idle;
  }

  private items(): HTMLButtonElement[] {
    return [...this.node.children] as HTMLButtonElement[];
  }

  private close(restoresFocus: boolean): void {
    if (this.node.hidden) return;
    this.node.hidden = true;
    if (restoresFocus) this.opener?.focus({ preventScroll: true });
  }

  private onKey(event: KeyboardEvent): void {
    event.stopPropagation();
    const enabled = this.items().filter((item) => !item.disabled);
    const at = enabled.indexOf(document.activeElement as HTMLButtonElement);
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step !== undefined) enabled[(at + step + enabled.length) % enabled.length]?.focus();
    else if (event.key === "Home" || event.key === "End") enabled.at(event.key === "Home" ? 0 : -1)?.focus();
    else if (event.key === "Escape" || event.key === "Tab") this.close(true);
    else return;
    event.preventDefault();
  }
}
