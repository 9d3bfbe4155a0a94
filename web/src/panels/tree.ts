// SPDX-License-Identifier: Apache-2.0
import { button, element, icon, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { ModelEvent } from "../wire/messages.ts";

interface Row {
  item: HTMLElement;
  name: string;
  /// The groups that contain it, innermost first.
  parents: Row[];
  components: number[];
  component: number | null;
  eye: HTMLButtonElement;
  xray: HTMLButtonElement;
  badge: HTMLElement;
  open: boolean;
}

/// The component tree: search, select, hide and X-ray. Badges mark components that are in contact, moved or removed.
export class TreePanel {
  readonly node: HTMLElement;
  private readonly list = element("div", {
    class: "tree",
    role: "tree",
    "aria-label": text("tree"),
    "aria-multiselectable": "true",
  });
  private readonly search = element("input", {
    type: "search",
    placeholder: text("tree.search"),
    "aria-label": text("tree.search"),
    id: "tree-search",
  });
  private readonly count = element("span", { class: "muted" });
  private readonly none = element("p", { class: "muted pad" }, text("tree.none"));
  private rows: Row[] = [];
  private anchor: Row | null = null; // where a range starts
  private shownModel: ModelEvent | null = null;
  private shownSelection: number[] = [];
  private shown: unknown[] = [];

  /// Opens a menu for components at a point of the page.
  onMenu: (components: number[], x: number, y: number) => void = () => {};

  constructor(private readonly session: Session) {
    this.search.oninput = () => this.filter();
    this.search.onkeydown = (event) => this.focusFirstFound(event);
    this.list.onkeydown = (event) => this.onKey(event);
    this.node = element(
      "section",
      { class: "panel", id: "tree-panel", "aria-label": text("tree") },
      element("header", {}, element("h2", {}, text("tree")), this.count),
      element("div", { class: "pad-x" }, this.search),
      this.list,
      this.none,
    );
    this.none.hidden = true;
    session.notifier.subscribe(() => this.update());
  }

  focusSearch(): void {
    this.search.focus();
    this.search.select();
  }

  private update(): void {
    const { model, state, selection, hovered, xray, blocking, frame } = this.session.store;
    if (model !== this.shownModel) this.rebuild(model);
    const touched = new Set(frame?.contacts.map(({ fixed }) => fixed));
    const now = [model, state, selection, hovered, blocking, [...xray].join(), [...touched].sort().join()];
    if (now.every((value, i) => value === this.shown[i])) return;
    this.shown = now;
    for (const row of this.rows) {
      // A group without components, such as one of sketches, is neither gone nor selected.
      const all = (holds: (component: number) => boolean | undefined) =>
        row.components.length > 0 && row.components.every(holds);
      const gone = all((c) => state?.components[c]?.hidden || state?.components[c]?.removed);
      const seeThrough = all((c) => xray.has(c));
      row.item.setAttribute("aria-selected", String(all((c) => selection.includes(c))));
      row.item.classList.toggle("hovered", row.component !== null && row.component === hovered);
      row.item.classList.toggle("gone", gone);
      row.xray.setAttribute("aria-pressed", String(seeThrough));
      const eye = gone ? "eyeOff" : "eye";
      if (row.eye.dataset.icon !== eye) {
        row.eye.replaceChildren(icon(eye));
        row.eye.dataset.icon = eye;
        row.eye.setAttribute("aria-label", text(gone ? "tree.show" : "tree.hide", { name: row.name }));
      }
      if (row.component !== null)
        this.updateBadge(row, row.component, touched.has(row.component), blocking.has(row.component));
    }
    if (selection !== this.shownSelection) this.reveal(selection);
  }

  private updateBadge(row: Row, component: number, touched: boolean, blocks: boolean): void {
    const state = this.session.store.state?.components[component];
    const label =
      blocks || touched
        ? text("contact")
        : state?.removed
          ? text("component.removed")
          : state?.pose
            ? text("component.moved")
            : "";
    setText(row.badge, label);
    row.badge.className = `badge ${blocks ? "blocks" : touched ? "touches" : ""}`;
    row.badge.hidden = label === "";
  }

  private rebuild(model: ModelEvent | null): void {
    this.shownModel = model;
    this.rows = [];
    this.anchor = null;
    this.list.replaceChildren();
    if (!model) return;
    const children = new Map<number, number[]>();
    model.tree.forEach(({ parent }, i) => {
      if (i > 0) children.set(parent, [...(children.get(parent) ?? []), i]);
    });
    const leaves = new Map<number, number[]>();
    model.components.forEach(({ node }, i) => {
      leaves.set(node, [...(leaves.get(node) ?? []), i]);
    });
    this.addNode(0, [], { model, children, leaves });
    this.filter();
  }

  private addNode(
    node: number,
    parents: Row[],
    tree: { model: ModelEvent; children: Map<number, number[]>; leaves: Map<number, number[]> },
  ): number[] {
    const own = tree.leaves.get(node) ?? [];
    const below = tree.children.get(node) ?? [];
    if (own.length === 1 && below.length === 0 && node > 0) {
      this.addRow(tree.model.components[own[0]].name, parents, own[0]);
      return own;
    }
    const row = this.addRow(tree.model.tree[node]?.name || tree.model.name, parents, null);
    const inside = [row, ...parents];
    for (const component of own) this.addRow(tree.model.components[component].name, inside, component);
    row.components = [...own, ...below.flatMap((child) => this.addNode(child, inside, tree))];
    if (row.components.length === 0) {
      row.item.classList.add("empty");
      row.item.title = text("tree.empty", { name: row.name });
      row.eye.disabled = row.xray.disabled = true;
    }
    return row.components;
  }

  private addRow(name: string, parents: Row[], component: number | null): Row {
    const row = {} as Row;
    const tool = (label: string, press: () => void) => {
      const node = button({ label, press, class: "tiny" });
      node.tabIndex = -1;
      return node;
    };
    const eye = tool(text("tree.hide", { name }), () => this.toggleShown(row));
    const xray = tool(text("tree.xray", { name }), () => this.session.toggleXray(row.components));
    xray.replaceChildren(icon("xray"));
    const badge = element("span", { class: "badge" });
    const expander = element("span", { class: "expander" });
    if (component === null) {
      expander.append(icon("chevron"));
      expander.onclick = (event) => {
        event.stopPropagation();
        this.toggleOpen(row);
      };
    }
    const item = element(
      "div",
      {
        class: `row level-${Math.min(parents.length, 8)} ${component === null ? "group" : ""}`,
        role: "treeitem",
        "aria-level": parents.length + 1,
        tabIndex: -1,
        title: name,
      },
      expander,
      element("span", { class: "name" }, name),
      badge,
      xray,
      eye,
    );
    if (component === null) item.setAttribute("aria-expanded", "true");
    item.onclick = (event) => this.select(row, event, event.target as Node);
    item.oncontextmenu = (event) => {
      event.preventDefault();
      const box = item.getBoundingClientRect();
      const byKey = event.clientX === 0 && event.clientY === 0;
      if (row.components.length > 0)
        this.onMenu(row.components, byKey ? box.left + 24 : event.clientX, byKey ? box.bottom : event.clientY);
    };
    item.onpointerenter = () => this.session.hover(component);
    item.onpointerleave = () => this.session.hover(null);
    Object.assign(row, { item, name, parents, component, eye, xray, badge, open: true });
    row.components = component === null ? [] : [component];
    this.rows.push(row);
    this.list.append(item);
    return row;
  }

  /// Selects a row; with Ctrl, adds or removes it; with Shift, selects all rows from the last one.
  private select(row: Row, { ctrlKey, shiftKey }: { ctrlKey: boolean; shiftKey: boolean }, target: Node): void {
    if (row.eye.contains(target) || row.xray.contains(target)) return;
    const { selection } = this.session.store;
    this.setFocus(row);
    if (shiftKey && this.anchor) return this.selectRange(this.anchor, row, ctrlKey ? selection : []);
    this.anchor = row;
    if (!ctrlKey) return this.session.select(row.components);
    const has = row.components.every((c) => selection.includes(c));
    const rest = selection.filter((c) => !row.components.includes(c));
    this.session.select(has ? rest : [...rest, ...row.components]);
  }

  private selectRange(from: Row, to: Row, before: number[]): void {
    const shown = this.rows.filter((row) => !row.item.hidden);
    const [first, last] = [shown.indexOf(from), shown.indexOf(to)].sort((a, b) => a - b);
    if (first < 0) return this.session.select(to.components);
    const range = shown.slice(first, last + 1).flatMap((row) => (row.component === null ? [] : row.components));
    this.session.select([...new Set([...before, ...range])]);
  }

  private toggleShown(row: Row): void {
    const { state } = this.session.store;
    const removed = row.components.filter((c) => state?.components[c]?.removed);
    const hidden = row.components.filter((c) => state?.components[c]?.hidden);
    if (row.components.length === removed.length && hidden.length === 0) {
      void this.session.send("put_back", { components: row.components });
      return;
    }
    const gone = row.components.length === hidden.length + removed.length;
    if (gone) void this.session.send("show", { components: hidden });
    else void this.session.send("hide", { components: row.components.filter((c) => !removed.includes(c)) });
  }

  private toggleOpen(row: Row, open = !row.open): void {
    row.open = open;
    row.item.setAttribute("aria-expanded", String(open));
    this.filter();
  }

  private filter(): void {
    const query = this.search.value.trim().toLowerCase();
    const found = this.rows.filter((row) => query === "" || row.name.toLowerCase().includes(query));
    const shown = new Set(found.flatMap((row) => [row, ...row.parents]));
    for (const row of this.rows)
      row.item.hidden = !shown.has(row) || (query === "" && row.parents.some((parent) => !parent.open));
    const leaves = this.rows.filter((row) => row.component !== null);
    const seen = leaves.filter((row) => shown.has(row)).length;
    setText(
      this.count,
      query === "" ? String(leaves.length || "") : text("tree.count", { shown: seen, all: leaves.length }),
    );
    this.none.hidden = this.rows.length === 0 || shown.size > 0;
    // Tab needs a visible row to stop at.
    const stop = this.rows.find(({ item }) => item.tabIndex === 0);
    if (stop?.item.hidden !== false) this.setTabStop(this.rows.find(({ item }) => !item.hidden));
  }

  /// Moves the focus from the search field to the first component found.
  private focusFirstFound(event: KeyboardEvent): void {
    if (event.key !== "ArrowDown" && event.key !== "Enter") return;
    event.preventDefault();
    const found = this.rows.find((row) => row.component !== null && !row.item.hidden);
    if (found) this.setFocus(found);
  }

  private reveal(selection: number[]): void {
    this.shownSelection = selection;
    const row = this.rows.find((candidate) => candidate.component !== null && selection.includes(candidate.component));
    if (!row) return;
    for (const parent of row.parents) if (!parent.open) this.toggleOpen(parent, true);
    row.item.scrollIntoView({ block: "nearest" });
  }

  private onKey(event: KeyboardEvent): void {
    const shown = this.rows.filter((row) => !row.item.hidden);
    const at = shown.findIndex((row) => row.item === document.activeElement);
    const row = shown[at];
    if (!row || (event.ctrlKey && event.key !== "Enter")) return;
    const moves: Record<string, () => void> = {
      ArrowDown: () => this.setFocus(shown[Math.min(at + 1, shown.length - 1)]),
      ArrowUp: () => this.setFocus(shown[Math.max(at - 1, 0)]),
      Home: () => this.setFocus(shown[0]),
      End: () => this.setFocus(shown[shown.length - 1]),
      ArrowRight: () => row.component === null && this.toggleOpen(row, true),
      ArrowLeft: () =>
        row.component === null && row.open ? this.toggleOpen(row, false) : this.setFocus(row.parents[0] ?? row),
      Enter: () => this.select(row, event, row.item),
      " ": () => this.toggleShown(row),
    };
    if (!moves[event.key]) return;
    event.preventDefault();
    event.stopPropagation();
    moves[event.key]();
  }

  private setFocus(row: Row): void {
    this.setTabStop(row);
    row.item.focus();
  }

  private setTabStop(row: Row | undefined): void {
    for (const other of this.rows) other.item.tabIndex = other === row ? 0 : -1;
  }
}
