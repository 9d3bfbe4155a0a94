// SPDX-License-Identifier: Apache-2.0
import { button, element } from "../dom.ts";
import type { Session } from "../session.ts";
import { directionText, lengthText, text } from "../strings.ts";
import type { Reason } from "../wire/messages.ts";

/// What the planner knows of the selection: a way out, or why it stays.
export class WayOutPart {
  readonly node: HTMLElement;
  private readonly find: HTMLButtonElement;
  private readonly why: HTMLButtonElement;
  private readonly reason = element("div", { id: "reason", role: "status" });
  private shown: Reason | null = null;

  constructor(private readonly session: Session) {
    this.find = button({
      icon: "route",
      label: text("findPath"),
      key: "N",
      wide: true,
      id: "find-path",
      press: () => void session.findPath(),
    });
    this.why = button({
      icon: "help",
      label: text("why"),
      key: "Q",
      wide: true,
      id: "why",
      press: () => void session.askWhy(),
    });
    this.node = element(
      "section",
      { class: "part" },
      element("h3", {}, text("wayOut")),
      element("div", { class: "actions single" }, this.find, this.why),
      this.reason,
    );
  }

  /// @param busy something moves, or another page is in control
  update(busy: boolean): void {
    const { state, selection, jobs } = this.session.store;
    const out = selection.every((c) => state?.components[c]?.removed);
    this.find.disabled = busy || jobs.size > 0 || out;
    this.why.disabled = busy || jobs.size > 0 || out || selection.length !== 1;
    const { reason } = this.session;
    if (reason === this.shown) return;
    this.shown = reason;
    this.reason.replaceChildren(...(reason ? this.wordsOf(reason) : []));
  }

  private wordsOf({ component: self, direction, blockers, locked }: Reason): HTMLElement[] {
    const rows = blockers.map(({ component, distance }) => {
      const press = () => this.session.select([component]);
      const name = element(
        "button",
        { type: "button", class: "link-button", onclick: press },
        this.session.nameOf(component),
      );
      const after = distance === null ? "" : text("reason.after", { distance: lengthText(distance) });
      return element("li", {}, name, element("span", { class: "badge blocks" }, after));
    });
    const words = text(rows.length > 0 ? "reason.by" : "reason.free", { direction: directionText(direction) });
    const others = locked.filter((c) => c !== self);
    return [
      element("p", {}, words),
      element("ul", { class: "rows" }, ...rows),
      ...(others.length > 0
        ? [element("p", { class: "muted" }, text("reason.locked", { names: this.session.namesOf(others) }))]
        : []),
    ];
  }
}
