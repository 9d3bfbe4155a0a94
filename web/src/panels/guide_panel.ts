// SPDX-License-Identifier: Apache-2.0
import { button, element, relabel, setText } from "../dom.ts";
import { type ComponentStatus, type GuideStep, nextStep, poseAt, type Score, scoreOf } from "../guide.ts";
import { showPath } from "../path_view.ts";
import { matrixOf } from "../pose.ts";
import { Ghost } from "../scene/ghost.ts";
import type { Session } from "../session.ts";
import { countText, text } from "../strings.ts";

/// Duration of the ghost's motion, and its pause at the end [ms].
const kGhostTime = 2200;
const kGhostHold = 500;
const kNoFaults: Score = { wrong: 0, hints: 0, contacts: 0 };

/// Guides through the steps of a path: the next components are highlighted and a ghost shows their motion. In practice
/// mode it counts mistakes instead.
export class GuidePanel {
  readonly node = element("section", {
    id: "guide-panel",
    "aria-label": text("guide"),
    hidden: true,
  });
  private readonly title = element("strong");
  private readonly progress = element("progress", { max: 1, value: 0, "aria-label": text("guide") });
  private readonly instruction = element("p", { id: "guide-step", role: "status" });
  private readonly score = element("span", { class: "muted", id: "guide-score" });
  private readonly practice = element("input", { type: "checkbox", id: "guide-practice" });
  private readonly showButton: HTMLButtonElement;
  private readonly skipButton: HTMLButtonElement;
  private readonly ghost: Ghost;

  private steps: GuideStep[] = [];
  private step = 0;
  private shownGuide: string | null = null;
  private ghostStart: number | null = null;
  private faults: Score = { ...kNoFaults };
  private scoredGrip: number | null = null;
  private wasBlocked = false;
  private lastMoveCount = 0;
  private wasPlayed = false;

  constructor(private readonly session: Session) {
    this.showButton = button({
      icon: "play",
      label: text("guide.show"),
      wide: true,
      id: "guide-show",
      press: () => this.showPath(),
    });
    this.skipButton = button({
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
      press: () => void session.send("close_guide", {}),
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
      this.instruction,
      element(
        "div",
        { class: "guide-tools" },
        this.showButton,
        this.skipButton,
        play,
        element("label", {}, this.practice, element("span", {}, text("guide.practice"))),
        this.score,
      ),
    );
    this.ghost = new Ghost(session.viewport.palette.next);
    session.viewport.scene.add(this.ghost.object);
    session.viewport.beforeRender.push((now) => this.animate(now));
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
    if (moves === 0 && this.lastMoveCount > 0) this.restart();
    this.lastMoveCount = moves;
    this.updateScore();
    const { playback } = state;
    const played = playback?.source === "guide" ? playback.move : null;
    const from = this.wasPlayed && !playback ? 0 : this.step;
    this.wasPlayed = played !== null;
    const next = played ?? (playback ? this.step : nextStep(this.steps, from, (c) => this.statusOf(c)));
    if (next !== this.step && !state.hand) this.goTo(next);
    this.showStep();
  }

  private async load(): Promise<void> {
    this.steps = [];
    this.restart();
    const { store } = this.session;
    if (!store.state?.guide || !store.model) return;
    try {
      this.steps = await this.session.loadSteps("guide");
    } catch (error) {
      this.session.onNote("warning", (error as Error).message);
    }
    this.restart();
    this.session.notifier.notify();
  }

  private restart(): void {
    this.faults = { ...kNoFaults };
    this.goTo(0);
  }

  private goTo(step: number): void {
    this.step = Math.min(step, this.steps.length);
    this.ghostStart = null;
    this.ghost.clear();
    const highlighted = this.practice.checked ? [] : (this.steps[this.step]?.components ?? []);
    for (const view of this.session.viewport.model?.components ?? [])
      view.setAppearance({ next: highlighted.includes(view.index) });
    this.showStep();
    this.session.viewport.invalidate();
  }

  private showStep(): void {
    const { state } = this.session.store;
    const count = this.steps.length;
    const step = this.steps[this.step];
    setText(this.title, guideTitle(state?.guide?.name ?? ""));
    this.progress.value = count > 0 ? this.step / count : 0;
    const names = step?.components.map((c) => this.session.nameOf(c)).join(", ") ?? "";
    const known = this.practice.checked
      ? text("guide.practice.step", { step: this.step + 1, count })
      : text("guide.step", { step: this.step + 1, count, names });
    setText(this.instruction, step ? known : text("guide.done"));
    setText(this.score, this.practice.checked ? scoreText(this.faults) : "");
    relabel(this.showButton, text(this.practice.checked ? "guide.hint" : "guide.show"));
    this.showButton.disabled = this.skipButton.disabled = !step;
  }

  /// Plays the step's motion once, with the ghost.
  private showPath(): void {
    const step = this.steps[this.step];
    if (!step) return;
    if (this.practice.checked) ++this.faults.hints;
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
    if (elapsed > kGhostTime + kGhostHold) {
      this.ghostStart = null;
      this.ghost.clear();
      return false;
    }
    const pose = poseAt(step, Math.max(0, Math.min(1, elapsed / kGhostTime)) * step.duration);
    this.ghost.place(matrixOf(pose), null, 1);
    return true;
  }

  /// Counts mistakes in practice mode: components out of order, and contacts.
  private updateScore(): void {
    const { state, frame } = this.session.store;
    if (!this.practice.checked || !this.steps[this.step]) return;
    const hand = state?.hand;
    if (hand && hand.grip !== this.scoredGrip) {
      this.scoredGrip = hand.grip;
      if (!hand.components.every((c) => this.steps[this.step].components.includes(c))) ++this.faults.wrong;
    }
    const blocked = hand != null && frame?.blocked === true;
    if (blocked && !this.wasBlocked) ++this.faults.contacts;
    this.wasBlocked = blocked;
  }

  private async playAll(): Promise<void> {
    await showPath(this.session, "guide");
    await this.session.send("seek", { time: 0, source: "guide" });
    await this.session.send("play", { speed: 1, source: "guide" });
  }

  private statusOf(component: number): ComponentStatus {
    const removed = this.session.store.state?.components[component]?.removed === true;
    return { pose: this.session.poseOf(component), removed };
  }
}

/// The title of a guide, from the name of its file; the planner's is called plan.path.json.
export function guideTitle(file: string): string {
  return file === "plan.path.json" ? text("guide.plan") : file.replace(/\.path\.json$/, "");
}

function scoreText(faults: Score): string {
  return text("guide.score", {
    points: countText(scoreOf(faults), "point"),
    wrong: faults.wrong,
    contacts: countText(faults.contacts, "contact"),
    hints: countText(faults.hints, "hint"),
  });
}
