// SPDX-License-Identifier: Apache-2.0
import { Matrix4 } from "three";
import { button, element, relabel, setText } from "../dom.ts";
import {
  type ComponentNow,
  type GuideStep,
  nextStep,
  type PathFile,
  pointsOf,
  poseAt,
  type Score,
  stepsOfPath,
} from "../guide.ts";
import { Ghost } from "../scene/marks.ts";
import { setMatrixFromPose } from "../scene/model_view.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";

/// A ghost goes its way in this time, and waits a moment at the end [ms].
const kShow = 2200;
const kPause = 500;
const kUnspoilt: Score = { wrong: 0, hints: 0, contacts: 0 };

/// Leads through a path: what to take next glows, a ghost shows where it goes; or, as practice, counts what goes wrong.
export class GuidePanel {
  readonly node = element("section", {
    id: "guide-panel",
    "aria-label": text("guide"),
    hidden: true,
  });
  private readonly title = element("strong");
  private readonly progress = element("progress", { max: 1, value: 0, "aria-label": text("guide") });
  private readonly words = element("p", { id: "guide-step", role: "status" });
  private readonly score = element("span", { class: "muted", id: "guide-score" });
  private readonly practice = element("input", { type: "checkbox", id: "guide-practice" });
  private readonly show: HTMLButtonElement;
  private readonly skip: HTMLButtonElement;
  private readonly ghost: Ghost;

  private steps: GuideStep[] = [];
  private step = 0;
  private shownGuide: string | null = null;
  private ghostStart: number | null = null;
  private points: Score = { ...kUnspoilt };
  private judgedGrip: number | null = null;
  private wasBlocked = false;
  private movesBefore = 0;

  constructor(private readonly session: Session) {
    this.show = button({
      icon: "play",
      label: text("guide.show"),
      wide: true,
      id: "guide-show",
      press: () => this.showWay(),
    });
    this.skip = button({
      icon: "end",
      label: text("guide.skip"),
      wide: true,
      id: "guide-skip",
      press: () => this.goTo(this.step + 1),
    });
    const close = button({
      icon: "close",
      label: text("guide.close"),
      class: "tiny",
      id: "guide-close",
      press: () => void session.ask("close_guide", {}),
    });
    const play = button({
      icon: "guide",
      label: text("guide.play"),
      wide: true,
      id: "guide-play",
      press: () => void this.playAll(),
    });
    this.practice.onchange = () => this.restart();
    this.node.append(
      element("header", {}, this.title, close),
      this.progress,
      this.words,
      element(
        "div",
        { class: "guide-tools" },
        this.show,
        this.skip,
        play,
        element("label", {}, this.practice, element("span", {}, text("guide.practice"))),
        this.score,
      ),
    );
    this.ghost = new Ghost(session.viewport.palette.next);
    session.viewport.scene.add(this.ghost.object);
    session.viewport.beforePicture.push((now) => this.animate(now));
    session.notifier.subscribe(() => this.update());
  }

  private update(): void {
    const { state, model } = this.session.store;
    const guide = state?.guide ? `${model?.sha256} ${state.guide.name} ${JSON.stringify(state.guide.moves)}` : null;
    if (guide !== this.shownGuide) {
      this.shownGuide = guide;
      void this.load();
    }
    this.node.hidden = state?.guide == null;
    if (!state?.guide || this.steps.length === 0) return;
    const moves = state.moves.length;
    if (moves === 0 && this.movesBefore > 0) this.restart();
    this.movesBefore = moves;
    this.judge();
    const next = state.playback ? this.step : nextStep(this.steps, this.step, (c) => this.nowOf(c));
    if (next !== this.step && !state.hand) this.goTo(next);
    this.showStep();
  }

  private async load(): Promise<void> {
    this.steps = [];
    this.restart();
    const { store } = this.session;
    if (!store.state?.guide || !store.model) return;
    try {
      const path = (await (await this.session.connection.request("/api/guide.json")).json()) as PathFile;
      this.steps = stepsOfPath(
        path,
        store.model.components.map(({ name }) => name),
      );
    } catch (error) {
      this.session.onNote("warning", (error as Error).message);
    }
    this.restart();
    this.session.notifier.notify();
  }

  private restart(): void {
    this.points = { ...kUnspoilt };
    this.goTo(0);
  }

  private goTo(step: number): void {
    this.step = Math.min(step, this.steps.length);
    this.ghostStart = null;
    this.ghost.clear();
    const glows = this.practice.checked ? [] : (this.steps[this.step]?.components ?? []);
    for (const view of this.session.viewport.model?.components ?? [])
      view.setLook({ next: glows.includes(view.index) });
    this.showStep();
    this.session.viewport.invalidate();
  }

  private showStep(): void {
    const { state } = this.session.store;
    const count = this.steps.length;
    const step = this.steps[this.step];
    setText(this.title, state?.guide?.name ?? "");
    this.progress.value = count > 0 ? this.step / count : 0;
    const names = step?.components.map((c) => this.session.nameOf(c)).join(", ") ?? "";
    const known = this.practice.checked
      ? text("guide.practice.step", { step: this.step + 1, count })
      : text("guide.step", { step: this.step + 1, count, names });
    setText(this.words, step ? known : text("guide.done"));
    setText(
      this.score,
      this.practice.checked ? text("guide.score", { points: pointsOf(this.points), ...this.points }) : "",
    );
    relabel(this.show, text(this.practice.checked ? "guide.hint" : "guide.show"));
    this.show.disabled = this.skip.disabled = !step;
  }

  /// The ghost goes the step's way once.
  private showWay(): void {
    const step = this.steps[this.step];
    if (!step) return;
    if (this.practice.checked) ++this.points.hints;
    const { model } = this.session.viewport;
    this.ghost.color = this.session.viewport.palette.next;
    this.ghost.show(step.components.map((c) => model!.components[c]));
    this.ghostStart = performance.now();
    this.showStep();
    this.session.viewport.invalidate();
  }

  private animate(now: number): boolean {
    const step = this.steps[this.step];
    if (this.ghostStart === null || !step) return false;
    const elapsed = now - this.ghostStart;
    if (elapsed > kShow + kPause) {
      this.ghostStart = null;
      this.ghost.clear();
      return false;
    }
    const pose = poseAt(step, Math.max(0, Math.min(1, elapsed / kShow)) * step.duration);
    this.ghost.place(setMatrixFromPose(new Matrix4(), pose), null, 1);
    return true;
  }

  /// Practice: what is taken out of turn, and what is run into.
  private judge(): void {
    const { state, frame } = this.session.store;
    if (!this.practice.checked || !this.steps[this.step]) return;
    const hand = state?.hand;
    if (hand && hand.grip !== this.judgedGrip) {
      this.judgedGrip = hand.grip;
      if (!hand.components.every((c) => this.steps[this.step].components.includes(c))) ++this.points.wrong;
    }
    const blocked = hand != null && frame?.blocked === true;
    if (blocked && !this.wasBlocked) ++this.points.contacts;
    this.wasBlocked = blocked;
  }

  private async playAll(): Promise<void> {
    await this.session.ask("seek", { time: 0, source: "guide" });
    await this.session.ask("play", { speed: 1, source: "guide" });
  }

  private nowOf(component: number): ComponentNow {
    const removed = this.session.store.state?.components[component]?.removed === true;
    return { pose: this.session.poseOf(component), removed };
  }
}
