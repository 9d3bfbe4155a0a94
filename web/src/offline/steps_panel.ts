// SPDX-License-Identifier: Apache-2.0
import { button, element, setText } from "../dom.ts";
import { kSameTime } from "../moves.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { PathPlayer } from "./path_player.ts";

/// The list of the path's steps. Clicking one plays it.
export class StepsPanel {
  readonly node: HTMLElement;
  private readonly list = element("ol", { class: "steps" });
  private readonly count = element("span", { class: "muted" });
  private shown = 0;

  constructor(
    private readonly session: Session,
    private readonly player: PathPlayer,
  ) {
    this.node = element(
      "section",
      { class: "panel", id: "steps-panel", "aria-label": text("steps") },
      element("header", {}, element("h2", {}, text("steps")), this.count),
      this.list,
    );
    session.notifier.subscribe(() => this.update());
  }

  /// Plays the next or the previous step.
  go(by: 1 | -1): void {
    const { playback, moves } = this.session.store.state!;
    const { step } = this.player;
    const notBegun = by > 0 && playback!.time <= moves[step].start + kSameTime;
    const next = Math.max(0, Math.min(moves.length - 1, notBegun ? step : step + by));
    this.player.playStep(next);
  }

  private update(): void {
    const moves = this.session.store.state?.moves ?? [];
    if (moves.length !== this.shown) {
      this.shown = moves.length;
      this.list.replaceChildren(
        ...moves.map(({ label }, i) =>
          element("li", {}, button({ label: `${i + 1}. ${label}`, wide: false, press: () => this.player.playStep(i) })),
        ),
      );
      setText(this.count, String(moves.length));
    }
    const now = this.player.step;
    for (const [i, item] of [...this.list.children].entries()) {
      const row = item.firstElementChild!;
      if (i === now) row.setAttribute("aria-current", "step");
      else row.removeAttribute("aria-current");
    }
  }
}
