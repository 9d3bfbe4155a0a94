// SPDX-License-Identifier: Apache-2.0
import { button, element } from "../dom.ts";
import type { Session } from "../session.ts";
import { directionText, text } from "../strings.ts";

export interface Notice {
  key: string;
  words: string;
  action?: { label: string; press: () => void };
}

/// Says whenever what is shown is not the true state, and what waits for an answer; and how far long imports are.
export class Banner {
  readonly node = element("div", { id: "banners", role: "status" });
  private shown = "";

  constructor(protected readonly session: Session) {
    session.notifier.subscribe(() => this.update());
  }

  private update(): void {
    const notices = this.notices();
    const signature = JSON.stringify(notices.map(({ key, words }) => [key, words]));
    if (signature === this.shown) return;
    this.shown = signature;
    this.node.replaceChildren(
      ...notices.map(({ key, words, action }) =>
        element(
          "div",
          { class: "banner", "data-banner": key },
          element("span", {}, words),
          action ? button({ label: action.label, wide: true, press: action.press }) : null,
        ),
      ),
    );
  }

  protected notices(): Notice[] {
    const { store } = this.session;
    const { state } = store;
    const ask = (command: "restore" | "take_control" | "resume" | "stop") => () => void this.session.ask(command, {});
    const notices: Notice[] = [];
    const jobs = [...store.jobs.values()];
    for (const { job, name, stage, fraction } of jobs) {
      const part = fraction >= 0 ? ` ${Math.round(100 * fraction)} %` : "";
      const words = text("job.running", { name, stage }) + part;
      notices.push({
        key: "job",
        words,
        action: { label: text("job.cancel"), press: () => void this.session.ask("cancel", { job }) },
      });
    }
    if (store.link === "lost") notices.push({ key: "lost", words: text("banner.lost") });
    if (!state) return notices;
    if (!store.control)
      notices.push({
        key: "watching",
        words: text("banner.watching"),
        action: { label: text("banner.take"), press: ask("take_control") },
      });
    if (state.resumable)
      notices.push({
        key: "resume",
        words: text("banner.resume"),
        action: { label: text("banner.resume.do"), press: ask("resume") },
      });
    if (state.playback) {
      const { blocked } = state.playback;
      const words = blocked
        ? text("timeline.blocked", { name: this.session.nameOf(blocked.by) })
        : text(store.exploding ? "banner.exploded" : "banner.playback");
      notices.push({
        key: store.exploding ? "exploded" : "playback",
        words,
        action: store.control ? { label: text("timeline.stop"), press: ask("stop") } : undefined,
      });
    }
    if (state.isolated)
      notices.push({
        key: "isolated",
        words: text("banner.isolated"),
        action: { label: text("restore"), press: ask("restore") },
      });
    else this.addHidden(notices);
    if (store.planes.length > 0) notices.push({ key: "section", words: text("banner.section") });
    this.addStuck(notices);
    this.addWasStuck(notices);
    return notices;
  }

  private addHidden(notices: Notice[]): void {
    const hidden = this.session.store.state!.components.flatMap((c, i) => (c.hidden ? [i] : []));
    if (hidden.length === 0) return;
    const press = () => void this.session.ask("show", { components: hidden });
    notices.push({ key: "hidden", words: text("banner.hidden"), action: { label: text("restore"), press } });
  }

  private addStuck(notices: Notice[]): void {
    const { blocking, directions, state } = this.session.store;
    if (blocking.size === 0 || !state?.hand) return;
    const name = this.session.nameOf([...blocking][0]);
    const free =
      directions?.components.join() === state.hand.components.join()
        ? directions.directions.filter((way) => way.free)
        : [];
    const words =
      free.length > 0
        ? text("stuck.free", {
            name,
            directions: free
              .map(({ direction }) => directionText(direction))
              .slice(0, 3)
              .join(" "),
          })
        : text("stuck", { name });
    const found = directions?.components.join() === state.hand.components.join();
    notices.push({ key: "stuck", words: found ? `${words}. ${text("stuck.path")}` : words });
  }

  /// Let go of while it was blocked: now there is a hand free for a button.
  private addWasStuck(notices: Notice[]): void {
    const { stuck, state, jobs } = this.session.store;
    if (!stuck || !state || state.hand || state.automatic || state.playback || state.search || jobs.size > 0) return;
    const names = { name: this.session.nameOf(stuck.components[0]), by: this.session.nameOf(stuck.blocking[0]) };
    notices.push({
      key: "was-stuck",
      words: text("stuck.was", names),
      action: { label: text("findPath"), press: () => void this.session.findPath() },
    });
  }
}

/// A line of notes that go by themselves, read out by screen readers.
export class Toasts {
  readonly node = element("div", { id: "toasts", role: "log", "aria-live": "polite" });

  show(level: "note" | "warning", sentence: string): void {
    const toast = element("div", { class: `toast ${level}` }, element("span", {}, sentence));
    toast.append(button({ icon: "close", label: text("help.close"), class: "tiny", press: () => toast.remove() }));
    this.node.append(toast);
    while (this.node.childElementCount > 4) this.node.firstElementChild!.remove();
    setTimeout(() => toast.remove(), 4000 + 60 * sentence.length);
  }
}
