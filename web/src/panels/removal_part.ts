// SPDX-License-Identifier: Apache-2.0
import { button, element } from "../dom.ts";
import { kMaxNames, type Session } from "../session.ts";
import { directionText, lengthText, text } from "../strings.ts";
import type { Reason } from "../wire/messages.ts";
import { componentRow } from "./component_row.ts";

/// The inspector's part about removal: finds a path for the selection, or what blocks it.
export class RemovalPart {
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
      press: () => void session.requestReason(),
    });
    this.node = element(
      "section",
      { class: "part" },
      element("h3", {}, text("removal")),
      element("div", { class: "actions single" }, this.find, this.why),
      this.reason,
    );
  }

  /// @param busy something is moving, or another page has control
  update(busy: boolean): void {
    const { state, selection, jobs } = this.session.store;
    const out = selection.every((c) => state?.components[c]?.removed);
    this.find.disabled = busy || jobs.size > 0 || out;
    this.why.disabled = busy || jobs.size > 0 || out || selection.length !== 1;
    const { reason } = this.session;
    if (reason === this.shown) return;
    this.shown = reason;
    this.reason.replaceChildren(...(reason ? this.content(reason) : []));
  }

  private content({ component: self, direction, blockers, locked }: Reason): HTMLElement[] {
    const rows = blockers.map(({ component, distance }) => {
      const after = distance === null ? "" : text("reason.after", { distance: lengthText(distance) });
      return componentRow(this.session, component, after, "blocks");
    });
    const message = text(rows.length > 0 ? "reason.by" : "reason.free", { direction: directionText(direction) });
    const others = locked.filter((c) => c !== self);
    return [
      element("p", {}, message),
      element("ul", { class: "rows" }, ...rows),
      ...(others.length > 0 ? [element("p", { class: "muted" }, this.lockedText(others))] : []),
    ];
  }

  private lockedText(others: number[]): string {
    if (others.length > kMaxNames) return text("reason.locked.many", { count: others.length });
    return text("reason.locked", { names: this.session.namesOf(others) });
  }
}
