// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { kAxisNames } from "../axes.ts";
import { button, element, setText } from "../dom.ts";
import type { Drag } from "../input/drag.ts";
import type { Session } from "../session.ts";
import { directionText, text } from "../strings.ts";
import { boxText, fromShown, type LengthUnit, lengthText, shownUnit, toShown } from "../units.ts";
import type { CheckedPair } from "../wire/messages.ts";
import { componentRow } from "./component_row.ts";
import { RemovalPart } from "./removal_part.ts";
import { clearanceText } from "./status.ts";

/// Blocked directions with less free travel are not listed [mm].
const kMinDistance = 0.1;

/// The panel on the right: facts, actions, contacts and free directions of the selection.
export class Inspector {
  readonly node: HTMLElement;
  private readonly title = element("h2", { id: "selection-name" });
  private readonly none = element("p", { class: "muted pad" }, text("selection.none"));
  private readonly facts = element("dl", { class: "facts" });
  private readonly actions: Record<
    "takeOut" | "putBack" | "isolate" | "hide" | "xray" | "similar" | "halt",
    HTMLButtonElement
  >;
  private readonly clearance = element("dl", { class: "facts", id: "clearance" });
  private readonly touches = element("ul", { class: "rows", id: "touches" });
  private readonly pairs = element("ul", { class: "rows", id: "pairs" });
  private readonly directions = element("ul", { class: "rows", id: "directions" });
  private readonly findDirections: HTMLButtonElement;
  private readonly removalPart: RemovalPart;
  private readonly numbers: HTMLInputElement[];
  private readonly numberLabels = [0, 1, 2].map((axis) => element("span", {}, numberLabel(axis)));
  private numberUnit: LengthUnit = shownUnit();
  private readonly body: HTMLElement;
  private pairsRequested = false;
  private signature = "";

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
  ) {
    const act = (name: "take_out" | "put_back" | "isolate" | "hide") => () =>
      void session.send(name, { components: session.store.selection });
    this.actions = {
      takeOut: button({
        icon: "out",
        label: text("takeOut"),
        key: "Del",
        wide: true,
        id: "take-out",
        class: "primary",
        press: act("take_out"),
      }),
      putBack: button({
        icon: "back",
        label: text("putBack"),
        key: "B",
        wide: true,
        id: "put-back",
        press: act("put_back"),
      }),
      isolate: button({
        icon: "isolate",
        label: text("isolate"),
        key: "I",
        wide: true,
        id: "isolate",
        press: act("isolate"),
      }),
      hide: button({ icon: "eyeOff", label: text("hide"), key: "Space", wide: true, id: "hide", press: act("hide") }),
      xray: button({
        icon: "xray",
        label: text("xray"),
        wide: true,
        id: "xray",
        press: () => session.toggleXray(session.store.selection),
      }),
      similar: button({
        icon: "similar",
        label: text("selectSimilar"),
        wide: true,
        id: "select-similar",
        press: () => session.selectSimilar(),
      }),
      halt: button({
        icon: "close",
        label: text("halt"),
        wide: true,
        id: "halt",
        class: "primary",
        press: () => void session.send("halt", {}),
      }),
    };
    this.findDirections = button({
      icon: "arrow",
      label: text("directions.find"),
      key: "D",
      wide: true,
      id: "find-directions",
      press: () => void this.find(),
    });
    this.removalPart = new RemovalPart(session);
    this.numbers = [0, 1, 2, 3, 4, 5].map((i) => numberField(i));
    this.body = this.makeBody();
    this.node = element(
      "section",
      { class: "panel", id: "inspector", "aria-label": text("selection") },
      element("header", {}, this.title),
      this.none,
      this.body,
    );
    session.notifier.subscribe(() => this.update());
  }

  /// Queries how far the selection can move straight.
  async find(): Promise<void> {
    const components = [...this.session.store.selection];
    if (components.length === 0) return;
    const found = await this.session.send("free_directions", { components });
    if (found)
      this.session.change(() => {
        this.session.store.directions = { components, directions: found.directions };
      });
  }

  private makeBody(): HTMLElement {
    const { takeOut, putBack, isolate, hide, xray, similar, halt } = this.actions;
    const fields = element(
      "form",
      { class: "numbers", id: "numeric" },
      ...this.numbers.map((field, i) => {
        const turn = () => element("span", {}, text("numeric.turn", { axis: kAxisNames[i % 3] }));
        return element("label", {}, this.numberLabels[i] ?? turn(), field);
      }),
      element("button", { type: "submit", class: "button wide", id: "numeric-apply" }, text("numeric.apply")),
    );
    fields.onsubmit = (event) => {
      event.preventDefault();
      void this.moveByNumbers();
    };
    return element(
      "div",
      { class: "body" },
      this.facts,
      element("div", { class: "actions" }, takeOut, putBack, isolate, hide, xray, similar, halt),
      this.removalPart.node,
      part(text("clearance"), this.clearance),
      part(text("contacts"), this.touches),
      part(text("directions"), this.directions, this.findDirections),
      part(text("numeric"), fields),
      part(text("pairs"), this.pairs),
    );
  }

  private async moveByNumbers(): Promise<void> {
    const values = this.numbers.map((field, i) => {
      const value = Number(field.value) || 0;
      return i < 3 ? fromShown(value) : value;
    });
    const { selection } = this.session.store;
    if (selection.length === 0 || values.every((value) => value === 0)) return;
    const center = this.session.viewport.model!.boundsOf(selection).getCenter(new Vector3());
    if (!(await this.drag.begin([...selection], center))) return;
    const turn = new Vector3(values[3], values[4], values[5]).multiplyScalar(Math.PI / 180);
    this.drag.moveBy(new Vector3(values[0], values[1], values[2]), turn);
    await this.drag.end();
  }

  /// Relabels and converts the fields of lengths when another unit is shown.
  private showNumberUnit(): void {
    const before = this.numberUnit;
    if (before === shownUnit()) return;
    this.numberUnit = shownUnit();
    for (const [axis, label] of this.numberLabels.entries()) {
      setText(label, numberLabel(axis));
      const length = Number(this.numbers[axis].value) || 0;
      this.numbers[axis].value = String(Number(toShown(fromShown(length, before)).toFixed(5)));
    }
  }

  private update(): void {
    const { store } = this.session;
    const { selection } = store;
    this.showNumberUnit();
    this.none.hidden = selection.length > 0;
    this.body.hidden = selection.length === 0;
    setText(
      this.title,
      selection.length === 0
        ? text("selection")
        : selection.length === 1
          ? this.session.nameOf(selection[0])
          : text("selection.many", { count: selection.length }),
    );
    this.showActions();
    if (selection.length === 0) return;
    this.requestPairs();
    this.showFacts();
    this.showClearance();
    this.showLists();
  }

  private showActions(): void {
    const { state, selection, control, xray } = this.session.store;
    const states = selection.map((c) => state?.components[c]);
    const busy = !control || !this.session.idle;
    this.actions.takeOut.disabled = busy || states.every((s) => s?.removed);
    this.actions.putBack.disabled = busy || states.every((s) => !s?.pose && !s?.removed);
    this.actions.isolate.disabled = !control;
    this.actions.hide.disabled = !control || states.every((s) => s?.hidden || s?.removed);
    this.actions.xray.setAttribute("aria-pressed", String(selection.length > 0 && selection.every((c) => xray.has(c))));
    this.actions.halt.hidden = state?.automatic == null;
    this.removalPart.update(busy);
    this.findDirections.disabled = !this.session.idle;
  }

  private showFacts(): void {
    const { model, state, selection } = this.session.store;
    const parts = selection.map((c) => model!.components[c]).filter((c) => c !== undefined);
    const triangles = parts.reduce((sum, { triangles: count }) => sum + count, 0);
    const facts: [string, string][] = [[text("selection.triangles"), triangles.toLocaleString("en")]];
    if (parts.length === 1) {
      const [low, high] = parts[0].bounds;
      facts.push([text("selection.size"), boxText(low.map((value, k) => high[k] - value))]);
      const now = state?.components[selection[0]];
      const pose = this.session.poseOf(selection[0]);
      const position = now?.removed
        ? text("component.removed")
        : pose
          ? text("position.moved", { distance: lengthText(Math.hypot(...pose.position)) })
          : text("position.assembled");
      facts.push([text("selection.position"), position]);
    }
    fill(this.facts, facts);
  }

  private showClearance(): void {
    const { frame, minClearance } = this.session.store;
    const shown = (value: number | undefined) =>
      value === undefined || Number.isNaN(value) ? text("clearance.unknown") : clearanceText(value);
    fill(this.clearance, [
      [text("clearance.now"), shown(frame?.clearance)],
      [text("clearance.min"), shown(minClearance)],
    ]);
  }

  private showLists(): void {
    const { frame, pairs, selection, directions, blocking } = this.session.store;
    const touched = new Map<number, number>();
    for (const { fixed, gap } of frame?.contacts ?? []) touched.set(fixed, Math.min(gap, touched.get(fixed) ?? gap));
    const signature = JSON.stringify([[...touched], [...blocking], selection, directions, pairs === null, shownUnit()]);
    if (signature === this.signature) return;
    this.signature = signature;
    const touching = [...touched].map(([component, gap]) =>
      componentRow(this.session, component, gapText(gap), blocking.has(component) ? "blocks" : "touches"),
    );
    this.touches.replaceChildren(...orNone(touching, text(frame ? "contacts.none" : "contacts.idle")));
    const mine = pairs?.pairs.filter(({ a, b }) => selection.includes(a) !== selection.includes(b)) ?? [];
    const neighbours = [...mine]
      .sort((p, q) => q.depth - p.depth || p.distance - q.distance)
      .map((pair) => {
        const other = selection.includes(pair.a) ? pair.b : pair.a;
        return componentRow(this.session, other, pairText(pair, other), pair.state);
      });
    this.pairs.replaceChildren(...orNone(neighbours, text(pairs ? "pairs.none" : "pairs.wait")));
    this.showDirections();
  }

  private showDirections(): void {
    const { selection } = this.session.store;
    const directions = this.session.directionsOf(selection);
    if (!directions) return this.directions.replaceChildren();
    const ordered = [...directions].sort((a, b) => Number(b.free) - Number(a.free) || b.distance - a.distance);
    const rows = ordered
      .filter(({ free, distance }) => free || distance > kMinDistance)
      .map(({ direction, free, distance, blocked_by }) => {
        const result = free
          ? text("directions.free")
          : text("directions.blocked", { distance: lengthText(distance), name: this.session.nameOf(blocked_by) });
        const remove = button({
          icon: "arrow",
          label: `${directionText(direction)}: ${result}`,
          wide: true,
          class: free ? "direction free" : "direction",
          press: () => void this.session.send("take_out", { components: selection, direction }),
        });
        remove.disabled = !free || !this.session.store.control;
        return element("li", {}, remove);
      });
    this.directions.replaceChildren(...orNone(rows, text("directions.none")));
  }

  /// Requests the pair states once an assembly, at the first selection.
  private requestPairs(): void {
    const { store } = this.session;
    if (store.pairs || this.pairsRequested || store.state?.hand) return;
    this.pairsRequested = true;
    const { number } = store.model!;
    this.session.connection
      .command("check", {})
      .then(
        (pairs) =>
          store.model?.number === number &&
          this.session.change(() => {
            store.pairs = pairs;
          }),
        () => {},
      )
      .finally(() => {
        this.pairsRequested = false;
      });
  }
}

function numberLabel(axis: number): string {
  return text("numeric.axis", { axis: kAxisNames[axis], unit: shownUnit() });
}

function numberField(index: number): HTMLInputElement {
  return element("input", { type: "number", step: "any", value: "0", id: `numeric-${index}` });
}

function part(title: string, ...children: Node[]): HTMLElement {
  return element("section", { class: "part" }, element("h3", {}, title), ...children);
}

function fill(list: HTMLElement, facts: [string, string][]): void {
  if (list.childElementCount !== 2 * facts.length)
    list.replaceChildren(...facts.flatMap(() => [element("dt"), element("dd")]));
  facts.forEach(([name, value], i) => {
    setText(list.children[2 * i], name);
    setText(list.children[2 * i + 1], value);
  });
}

function orNone(rows: HTMLElement[], message: string): HTMLElement[] {
  return rows.length > 0 ? rows : [element("li", { class: "muted" }, message)];
}

/// How two components meet in the assembled state. `other`: the one that is not selected.
function pairText(pair: CheckedPair, other: number): string {
  if (pair.contained !== null) return text(pair.contained === other ? "pair.contains" : "pair.inside");
  if (pair.state === "overlapping") return text("pair.overlapping", { depth: lengthText(pair.depth) });
  if (pair.state === "near") return text("pair.near", { distance: lengthText(pair.distance) });
  return text("contact");
}

/// The gap of a contact as text; a negative gap is an overlap.
function gapText(gap: number): string {
  return gap < 0 ? text("contacts.overlap", { distance: lengthText(-gap) }) : lengthText(gap);
}
