// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { button, element, setText } from "../dom.ts";
import type { Drag } from "../input/drag.ts";
import type { Session } from "../session.ts";
import { directionText, lengthText, text } from "../strings.ts";
import { clearanceText } from "./status.ts";
import { WayOutPart } from "./way_out_part.ts";

/// The right side: what is selected, what can be done with it, what it touches and where it can go.
export class Inspector {
  readonly node: HTMLElement;
  private readonly title = element("h2", { id: "selection-name" });
  private readonly none = element("p", { class: "muted pad" }, text("selection.none"));
  private readonly facts = element("dl", { class: "facts" });
  private readonly actions: Record<"takeOut" | "putBack" | "isolate" | "hide" | "xray" | "halt", HTMLButtonElement>;
  private readonly clearance = element("dl", { class: "facts", id: "clearance" });
  private readonly touches = element("ul", { class: "rows", id: "touches" });
  private readonly pairs = element("ul", { class: "rows", id: "pairs" });
  private readonly ways = element("ul", { class: "rows", id: "directions" });
  private readonly findWays: HTMLButtonElement;
  private readonly wayOut: WayOutPart;
  private readonly numbers: HTMLInputElement[];
  private readonly body: HTMLElement;
  private asked = false;
  private signature = "";

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
  ) {
    const act = (name: "take_out" | "put_back" | "isolate" | "hide") => () =>
      void session.ask(name, { components: session.store.selection });
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
      halt: button({
        icon: "close",
        label: text("halt"),
        wide: true,
        id: "halt",
        class: "primary",
        press: () => void session.ask("halt", {}),
      }),
    };
    this.findWays = button({
      icon: "arrow",
      label: text("directions.find"),
      key: "D",
      wide: true,
      id: "find-directions",
      press: () => void this.find(),
    });
    this.wayOut = new WayOutPart(session);
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

  /// Asks the engine how far the selection can go straight.
  async find(): Promise<void> {
    const components = [...this.session.store.selection];
    if (components.length === 0) return;
    const answer = await this.session.ask("free_directions", { components });
    if (answer)
      this.session.change(() => {
        this.session.store.directions = { components, directions: answer.directions };
      });
  }

  private makeBody(): HTMLElement {
    const { takeOut, putBack, isolate, hide, xray, halt } = this.actions;
    const fields = element(
      "form",
      { class: "numbers", id: "numeric" },
      ...this.numbers.map((field, i) => {
        const axis = "XYZ"[i % 3];
        const label = text(i < 3 ? "numeric.axis" : "numeric.turn", { axis });
        return element("label", {}, element("span", {}, label), field);
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
      element("div", { class: "actions" }, takeOut, putBack, isolate, hide, xray, halt),
      this.wayOut.node,
      part(text("clearance"), this.clearance),
      part(text("contacts"), this.touches),
      part(text("directions"), this.ways, this.findWays),
      part(text("numeric"), fields),
      part(text("pairs"), this.pairs),
    );
  }

  private async moveByNumbers(): Promise<void> {
    const values = this.numbers.map((field) => Number(field.value) || 0);
    const { selection } = this.session.store;
    if (selection.length === 0 || values.every((value) => value === 0)) return;
    const center = this.session.viewport.model!.boundsOf(selection).getCenter(new Vector3());
    if (!(await this.drag.begin([...selection], center))) return;
    const turn = new Vector3(values[3], values[4], values[5]).multiplyScalar(Math.PI / 180);
    this.drag.moveBy(new Vector3(values[0], values[1], values[2]), turn);
    await this.drag.end();
  }

  private update(): void {
    const { store } = this.session;
    const { selection } = store;
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
    this.askPairs();
    this.showFacts();
    this.showClearance();
    this.showLists();
  }

  private showActions(): void {
    const { state, selection, control, xray } = this.session.store;
    const states = selection.map((c) => state?.components[c]);
    const busy = !control || state?.hand != null || state?.automatic != null || state?.playback != null;
    this.actions.takeOut.disabled = busy || states.every((s) => s?.removed);
    this.actions.putBack.disabled = busy || states.every((s) => !s?.pose && !s?.removed);
    this.actions.isolate.disabled = !control;
    this.actions.hide.disabled = !control || states.every((s) => s?.hidden || s?.removed);
    this.actions.xray.setAttribute("aria-pressed", String(selection.length > 0 && selection.every((c) => xray.has(c))));
    this.actions.halt.hidden = state?.automatic == null;
    this.wayOut.update(busy);
    this.findWays.disabled = state?.hand != null || state?.automatic != null || state?.playback != null;
  }

  private showFacts(): void {
    const { model, state, selection } = this.session.store;
    const parts = selection.map((c) => model!.components[c]).filter((c) => c !== undefined);
    const triangles = parts.reduce((sum, { triangles: count }) => sum + count, 0);
    const facts: [string, string][] = [[text("selection.triangles"), triangles.toLocaleString("en")]];
    if (parts.length === 1) {
      const [low, high] = parts[0].bounds;
      facts.push([text("selection.size"), low.map((value, k) => (high[k] - value).toFixed(1)).join(" × ")]);
      const now = state?.components[selection[0]];
      const pose = this.session.poseOf(selection[0]);
      const place = now?.removed
        ? text("place.removed")
        : pose
          ? text("place.moved", { distance: lengthText(Math.hypot(...pose.position)) })
          : text("place.assembled");
      facts.push([text("selection.place"), place]);
    }
    fill(this.facts, facts);
  }

  private showClearance(): void {
    const { frame, leastClearance } = this.session.store;
    const shown = (value: number | undefined) =>
      value === undefined || Number.isNaN(value) ? text("clearance.unknown") : clearanceText(value);
    fill(this.clearance, [
      [text("clearance.now"), shown(frame?.clearance)],
      [text("clearance.least"), shown(leastClearance)],
    ]);
  }

  private showLists(): void {
    const { frame, pairs, selection, directions, blocking } = this.session.store;
    const touched = new Map<number, number>();
    for (const { fixed, gap } of frame?.contacts ?? []) touched.set(fixed, Math.min(gap, touched.get(fixed) ?? gap));
    const signature = JSON.stringify([[...touched], [...blocking], selection, directions, pairs === null]);
    if (signature === this.signature) return;
    this.signature = signature;
    const touching = [...touched].map(([component, gap]) =>
      this.row(component, lengthText(gap), blocking.has(component) ? "blocks" : "touches"),
    );
    this.touches.replaceChildren(...orNone(touching, text(frame ? "contacts.none" : "contacts.idle")));
    const mine = pairs?.pairs.filter(({ a, b }) => selection.includes(a) !== selection.includes(b)) ?? [];
    const neighbours = mine.map((pair) =>
      this.row(selection.includes(pair.a) ? pair.b : pair.a, text(`pair.${pair.state}`), pair.state),
    );
    this.pairs.replaceChildren(...orNone(neighbours, text(pairs ? "pairs.none" : "pairs.wait")));
    this.showWays();
  }

  private showWays(): void {
    const { directions, selection } = this.session.store;
    if (!directions || directions.components.join() !== selection.join()) return this.ways.replaceChildren();
    const ordered = [...directions.directions].sort(
      (a, b) => Number(b.free) - Number(a.free) || b.distance - a.distance,
    );
    const rows = ordered
      .filter(({ free, distance }) => free || distance > 0.1)
      .map((way) => {
        const words = way.free
          ? text("directions.free")
          : text("directions.blocked", {
              distance: lengthText(way.distance),
              name: this.session.nameOf(way.blocked_by),
            });
        const take = button({
          icon: "arrow",
          label: `${directionText(way.direction)}: ${words}`,
          wide: true,
          class: way.free ? "way free" : "way",
          press: () => void this.session.ask("take_out", { components: selection, direction: way.direction }),
        });
        take.disabled = !way.free || !this.session.store.control;
        return element("li", {}, take);
      });
    this.ways.replaceChildren(...orNone(rows, text("directions.none")));
  }

  private row(component: number, words: string, kind: string): HTMLElement {
    const press = () => this.session.select([component]);
    const name = element(
      "button",
      { type: "button", class: "link-button", onclick: press },
      this.session.nameOf(component),
    );
    return element("li", {}, name, element("span", { class: `badge ${kind}` }, words));
  }

  /// Once an assembly, when something is selected for the first time.
  private askPairs(): void {
    const { store } = this.session;
    if (store.pairs || this.asked || store.state?.hand) return;
    this.asked = true;
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
        this.asked = false;
      });
  }
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

function orNone(rows: HTMLElement[], words: string): HTMLElement[] {
  return rows.length > 0 ? rows : [element("li", { class: "muted" }, words)];
}
