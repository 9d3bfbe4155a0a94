// SPDX-License-Identifier: Apache-2.0
import { Box3, Matrix4, Vector3 } from "three";
import { button, element, setText } from "../dom.ts";
import { type GuideStep, type PathFile, stepsOfPath } from "../guide.ts";
import type { View } from "../scene/camera_rig.ts";
import { setMatrixFromPose } from "../scene/model_view.ts";
import { Trails, trailsUntil } from "../scene/trails.ts";
import { Seeker } from "../seeker.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { ModelEvent, Move, Source } from "../wire/messages.ts";

/// What is shown at most, in diagonals of the assembly.
const kMostRoom = 2.5;
/// Positions nearer to each other than this part of a step are the same.
const kSame = 1e-6;

/// The steps of a path, one after another: how far each has taken its components, and the trails that they drew. The
/// server's playback puts them there, so that nothing is shown that is not on the path.
export class ExplodePanel {
  readonly node = element("section", {
    id: "explode-panel",
    class: "floating",
    "aria-label": text("explode"),
    hidden: true,
  });
  private readonly words = element("p", { id: "explode-step", role: "status" });
  private readonly slider = element("input", {
    type: "range",
    min: "0",
    step: "0.02",
    id: "explode-slider",
    "aria-label": text("explode.slider"),
  });
  private readonly before: HTMLButtonElement;
  private readonly after: HTMLButtonElement;
  private readonly tools: HTMLElement;
  private readonly trails = new Trails();
  private readonly seeker: Seeker;
  private steps: GuideStep[] = [];
  private viewBefore: View | null = null;
  /// The playback is the panel's own.
  private opened = false;
  private shownModel: ModelEvent | null = null;
  /// Until when the trails go; null: none are shown.
  private shownTime: number | null = null;

  constructor(private readonly session: Session) {
    this.seeker = new Seeker(session);
    this.before = button({
      icon: "start",
      label: text("explode.before"),
      id: "explode-before",
      press: () => this.scrubTo(Math.ceil(this.position() - kSame) - 1),
    });
    this.after = button({
      icon: "end",
      label: text("explode.after"),
      id: "explode-after",
      press: () => this.scrubTo(Math.floor(this.position() + kSame) + 1),
    });
    this.slider.oninput = () => this.scrubTo(Number(this.slider.value));
    this.tools = element("div", { class: "explode-tools" }, this.before, this.slider, this.after);
    this.node.append(this.words, this.tools);
    session.viewport.scene.add(this.trails.object);
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    if (this.session.store.exploding) void this.close();
    else void this.open();
  }

  private source(): Source {
    const { state } = this.session.store;
    return state?.playback?.source ?? (state?.guide ? "guide" : "recording");
  }

  private moves(): Move[] {
    return this.session.movesOf(this.source());
  }

  private async open(): Promise<void> {
    const { session } = this;
    const { state, model } = session.store;
    if (!state || !model || state.hand || state.automatic) return;
    session.change(() => {
      session.store.exploding = true;
    });
    if (this.moves().length === 0) return;
    const source = this.source();
    try {
      const answer = await session.connection.request(source === "guide" ? "/api/guide.json" : "/api/path.json");
      const names = model.components.map(({ name }) => name);
      this.steps = stepsOfPath((await answer.json()) as PathFile, names);
    } catch (error) {
      session.onNote("warning", (error as Error).message);
    }
    const { rig } = session.viewport;
    this.viewBefore = rig.current;
    rig.fit(this.extent());
    await this.seeker.seek(this.timeAt(this.moves().length), source);
    if (!session.store.exploding) return void session.ask("stop", {});
    this.opened = true;
    session.notifier.notify();
  }

  private async close(): Promise<void> {
    this.leave();
    if (this.session.store.state?.playback) await this.session.ask("stop", {});
  }

  private leave(): void {
    const { session } = this;
    this.opened = false;
    this.steps = [];
    if (this.viewBefore) session.viewport.rig.fly(this.viewBefore);
    this.viewBefore = null;
    session.change(() => {
      session.store.exploding = false;
    });
  }

  /// Of the assembly and of where the path takes it, as far as the assembly stays large enough to be looked at: a recording
  /// takes its components out one after another, each to a place further away.
  private extent(): Box3 {
    const { components } = this.session.store.model!;
    const boxes = components.map(({ bounds: [low, high] }) => new Box3(new Vector3(...low), new Vector3(...high)));
    const all = boxes.reduce((sum, box) => sum.union(box), new Box3());
    for (const { components: set, frames } of this.steps)
      for (const c of set)
        all.union(boxes[c].clone().applyMatrix4(setMatrixFromPose(new Matrix4(), frames[frames.length - 1].pose)));
    const whole = new Box3().setFromArray(this.session.store.model!.bounds.flat());
    const room = kMostRoom * whole.getSize(new Vector3()).length();
    return all.intersect(
      new Box3().setFromCenterAndSize(whole.getCenter(new Vector3()), new Vector3(room, room, room)),
    );
  }

  /// How many steps have been taken; the last one in part.
  private position(): number {
    const moves = this.moves();
    const time = this.session.playedTime ?? 0;
    const next = moves.findIndex(({ start, duration }) => time < start + duration - 1e-9);
    if (next < 0) return moves.length;
    return next + Math.max(0, time - moves[next].start) / moves[next].duration;
  }

  private timeAt(position: number): number {
    const moves = this.moves();
    const move = moves[Math.min(Math.floor(position), moves.length - 1)];
    return move.start + Math.min(1, position - moves.indexOf(move)) * move.duration;
  }

  private scrubTo(position: number): void {
    const within = Math.min(this.moves().length, Math.max(0, position));
    void this.seeker.seek(this.timeAt(within), this.source());
  }

  private update(): void {
    const { exploding, state, control, model } = this.session.store;
    if (model !== this.shownModel) this.viewBefore = null;
    this.shownModel = model;
    if (this.opened && !(exploding && state?.playback)) return this.leave();
    this.node.hidden = !exploding;
    this.showTrails();
    if (!exploding) return;
    const moves = this.moves();
    this.tools.hidden = moves.length === 0;
    if (moves.length === 0) return setText(this.words, text("explode.none"));
    const position = this.position();
    this.slider.max = String(moves.length);
    if (!this.seeker.busy) this.slider.value = String(position);
    this.slider.disabled = this.before.disabled = this.after.disabled = !control;
    const shown = Math.ceil(position - kSame);
    const step = { step: shown, count: moves.length, label: moves[shown - 1]?.label ?? "" };
    const words = text(shown === 0 ? "explode.assembled" : "explode.step", step);
    setText(this.words, words);
    this.slider.setAttribute("aria-valuetext", words);
  }

  private showTrails(): void {
    const { exploding, model } = this.session.store;
    const { playedTime } = this.session;
    const time = exploding && this.steps.length > 0 ? playedTime : null;
    if (time === this.shownTime) return;
    this.shownTime = time;
    const center = (c: number): Vector3 => {
      const [low, high] = model!.components[c].bounds;
      return new Vector3(...low).add(new Vector3(...high)).multiplyScalar(0.5);
    };
    const [low, high] = model?.bounds ?? [
      [0, 0, 0],
      [0, 0, 0],
    ];
    const size = new Vector3(...high).distanceTo(new Vector3(...low));
    const ways = time === null ? [] : trailsUntil(this.steps, time, center, size);
    this.trails.show(ways, this.session.viewport.palette.ghost);
  }
}
