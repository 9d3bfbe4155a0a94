// SPDX-License-Identifier: Apache-2.0
import { button, element, setText } from "../dom.ts";
import { endOf, kSameTime } from "../moves.ts";
import { showPath } from "../path_view.ts";
import { Seeker } from "../seeker.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { Move, Source } from "../wire/messages.ts";

const kSpeeds = [0.25, 0.5, 1, 2, 4];
const kTicks = 1000;

/// The timeline: recorded moves as blocks, with a scrubber and playback buttons.
export class TimelinePanel {
  readonly node: HTMLElement;
  private readonly blocks = element("div", { class: "blocks", "aria-hidden": "true" });
  private readonly scrub = element("input", {
    type: "range",
    min: "0",
    max: String(kTicks),
    step: "1",
    id: "scrub",
    "aria-label": text("timeline.scrub"),
  });
  private readonly speed = element("select", {
    "aria-label": text("timeline.speed"),
    title: text("timeline.speed"),
    id: "speed",
  });
  private readonly clock = element("output", { class: "clock", for: "scrub" });
  private readonly empty = element("p", { class: "muted" }, text("timeline.empty"));
  private readonly buttons: Record<
    "start" | "before" | "reverse" | "pause" | "play" | "next" | "end" | "stop" | "follow",
    HTMLButtonElement
  >;
  private shownMoves: Move[] | null = null;
  private scrubbing = false;
  private readonly seeker: Seeker;

  constructor(private readonly session: Session) {
    this.seeker = new Seeker(session);
    this.buttons = {
      start: button({ icon: "start", label: text("timeline.start"), id: "play-start", press: () => this.seek(0) }),
      before: button({
        icon: "stepBack",
        label: text("timeline.before"),
        id: "play-before",
        press: () => this.step(-1),
      }),
      reverse: button({
        icon: "playBack",
        label: text("timeline.reverse"),
        id: "play-reverse",
        press: () => void session.during(this.play(-1)),
      }),
      pause: button({
        icon: "pause",
        label: text("timeline.pause"),
        id: "play-pause",
        press: () => void session.send("pause", {}),
      }),
      play: button({
        icon: "play",
        label: text("timeline.play"),
        key: "P",
        id: "play",
        press: () => void session.during(this.play(1)),
      }),
      next: button({ icon: "stepOn", label: text("timeline.next"), id: "play-next", press: () => this.step(1) }),
      end: button({
        icon: "end",
        label: text("timeline.end"),
        id: "play-end",
        press: () => this.seek(this.duration()),
      }),
      follow: button({
        icon: "guide",
        label: text("guide.follow"),
        id: "follow",
        press: () => void session.followRecording(),
      }),
      stop: button({
        icon: "close",
        label: text("timeline.stop"),
        wide: true,
        id: "play-stop",
        press: () => void session.send("stop", {}),
      }),
    };
    for (const value of kSpeeds)
      this.speed.append(element("option", { value: String(value), selected: value === 1 }, `${value}×`));
    this.scrub.oninput = () => this.scrubTo(Number(this.scrub.value) / kTicks);
    this.scrub.onchange = () => {
      this.scrubbing = false;
    };
    this.speed.onchange = () => this.changeSpeed();
    const { start, before, reverse, pause, play, next, end, stop, follow } = this.buttons;
    this.node = element(
      "section",
      { id: "timeline", "aria-label": text("timeline") },
      element("div", { class: "transport" }, start, before, reverse, pause, play, next, end, this.speed),
      element("div", { class: "track" }, this.blocks, this.scrub, this.empty),
      this.clock,
      follow,
      stop,
    );
    session.notifier.subscribe(() => this.update());
  }

  /// Toggles between playing and pausing.
  toggle(): void {
    if (this.session.store.state?.playback?.playing) void this.session.send("pause", {});
    else void this.session.during(this.play(1));
  }

  /// Seeks to the end of the current move (1), or to its start (-1).
  step(by: 1 | -1): void {
    const time = this.time();
    const ends = [0, ...this.moves().map(endOf)];
    const target =
      by > 0 ? ends.find((end) => end > time + kSameTime) : ends.filter((end) => end < time - kSameTime).at(-1);
    if (target !== undefined) this.seek(target);
  }

  private source(): Source {
    return this.session.store.state?.playback?.source ?? "recording";
  }

  private moves(): Move[] {
    return this.session.movesOf(this.source());
  }

  private duration(): number {
    const last = this.moves().at(-1);
    return last ? endOf(last) : 0;
  }

  private time(): number {
    return this.session.playbackTime ?? this.duration();
  }

  private async play(sign: 1 | -1): Promise<void> {
    const { state } = this.session.store;
    if (this.duration() === 0) return;
    const speed = sign * Number(this.speed.value);
    // Without a playback the time is the recording's end: playing forward starts at its beginning.
    const time = this.time();
    if (!state?.playback || time <= kSameTime || time >= this.duration() - kSameTime)
      await showPath(this.session, this.source());
    if (!state?.playback)
      await this.session.send("seek", { time: sign > 0 ? 0 : this.duration(), source: this.source() });
    else if (sign > 0 && this.time() >= this.duration() - kSameTime) await this.session.send("seek", { time: 0 });
    await this.session.send("play", { speed, source: this.source() });
  }

  private changeSpeed(): void {
    const playback = this.session.store.state?.playback;
    if (playback?.playing)
      void this.session.send("play", {
        speed: Math.sign(playback.speed) * Number(this.speed.value),
        source: playback.source,
      });
  }

  private seek(time: number): void {
    if (this.duration() > 0) void this.session.send("seek", { time, source: this.source() });
  }

  private scrubTo(fraction: number): void {
    this.scrubbing = true;
    void this.seeker.seek(fraction * this.duration(), this.source());
  }

  private update(): void {
    const { state, control } = this.session.store;
    const moves = this.moves();
    if (moves !== this.shownMoves) this.showMoves(moves);
    const [duration, playback] = [this.duration(), state?.playback];
    const unavailable = duration === 0 || !control || state?.hand != null || state?.automatic != null;
    for (const name of ["start", "before", "reverse", "play", "next", "end"] as const)
      this.buttons[name].disabled = unavailable;
    this.buttons.pause.disabled = !playback?.playing;
    this.buttons.stop.hidden = !playback;
    this.buttons.follow.hidden = playback != null;
    this.buttons.follow.disabled = unavailable;
    this.scrub.disabled = unavailable;
    this.empty.hidden = duration > 0;
    const time = this.time();
    if (!this.scrubbing) this.scrub.value = String(duration > 0 ? Math.round((kTicks * time) / duration) : 0);
    const label = duration > 0 ? `${time.toFixed(1)} / ${duration.toFixed(1)} s` : "";
    setText(this.clock, label);
    this.scrub.setAttribute("aria-valuetext", label);
    for (const [i, block] of [...this.blocks.children].entries()) {
      block.classList.toggle("done", endOf(moves[i]) <= time + kSameTime);
      block.classList.toggle("blocked", playback?.blocked != null && playback.move === i);
    }
  }

  private showMoves(moves: Move[]): void {
    this.shownMoves = moves;
    this.blocks.replaceChildren(
      ...moves.map((move, i) => {
        const label = text("timeline.move", { label: move.label, duration: move.duration.toFixed(1) });
        // The number is what is left of it in a narrow block.
        const name = `${i + 1}  ${this.session.groupedNamesOf(move.components)}`;
        const block = element("div", { class: "block", title: `${i + 1}  ${label}` }, element("span", {}, name));
        block.style.flexGrow = String(Math.max(move.duration, 1e-3));
        return block;
      }),
    );
  }
}
