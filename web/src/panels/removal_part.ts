// SPDX-License-Identifier: Apache-2.0
import { button, element } from "../dom.ts";
import { kMaxNames } from "../names.ts";
import type { Session } from "../session.ts";
import { alongText, text } from "../strings.ts";
import { lengthText, shownUnit } from "../units.ts";
import type { Reason, Search } from "../wire/messages.ts";
import { componentRow } from "./component_row.ts";

/// The inspector's part about removal: finds a path for the selection, or what blocks it.
export class RemovalPart {
  readonly node: HTMLElement;
  private readonly find: HTMLButtonElement;
  private readonly why: HTMLButtonElement;
  private readonly reason = element("div", { id: "reason", role: "status" });
  private shown: unknown[] = [];

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
    const now = [reason, shownUnit()];
    if (now.every((value, i) => value === this.shown[i])) return;
    this.shown = now;
    this.reason.replaceChildren(...(reason ? this.content(reason, state?.search?.chain ?? null) : []));
  }

  /// The answer in one sentence, and below it all that blocks.
  private content({ component: self, direction, blockers, locked }: Reason, chain: Search["chain"]): HTMLElement[] {
    const names = this.session.groupedNamesOf(blockers.map(({ component }) => component));
    const message =
      blockers.length === 0
        ? text("reason.free", { along: alongText(direction) })
        : chain
          ? this.chainText(chain)
          : text("reason.by", { along: alongText(direction), names });
    const rows = blockers.map(({ component, distance }) => {
      const after = distance === null ? "" : text("reason.after", { distance: lengthText(distance) });
      return componentRow(this.session, component, after, "blocks");
    });
    const others = locked.filter((c) => c !== self);
    const sentence = element("p", { id: "reason-sentence" }, message);
    if (rows.length === 0) return [sentence];
    const along = element("p", { class: "muted" }, text("reason.by", { along: alongText(direction), names }));
    const more = others.length > 0 ? element("p", { class: "muted" }, this.lockedText(others)) : null;
    const summary = element("summary", {}, text("reason.details"));
    const list = element("ul", { class: "rows" }, ...rows);
    return [sentence, element("details", {}, summary, chain ? along : null, list, more)];
  }

  private chainText({ before, direction }: NonNullable<Search["chain"]>): string {
    if (before.length === 0) return text("reason.path");
    return text("reason.chain", {
      names: this.session.groupedNamesOf(before.flat()),
      along: alongText(direction),
    });
  }

  private lockedText(others: number[]): string {
    if (others.length > kMaxNames) return text("reason.locked.many", { count: others.length });
    return text("reason.locked", { names: this.session.namesOf(others) });
  }
}
