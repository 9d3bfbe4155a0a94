// SPDX-License-Identifier: Apache-2.0
import { type Box3, Vector3 } from "three";
import { button, element, setText } from "../dom.ts";
import type { GuideStep } from "../guide.ts";
import { endOf, kSameTime } from "../moves.ts";
import { pathExtent } from "../path_view.ts";
import type { View } from "../scene/camera_rig.ts";
import { Trails, trailsUntil } from "../scene/trails.ts";
import { Seeker } from "../seeker.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { ModelEvent, Move, Source } from "../wire/messages.ts";

/// The quick exploded view moves components away from the centre by up to this times their distance from it.
const kMaxQuick = 2;
/// Positions that differ by less are the same [steps].
const kSamePosition = 1e-6;

/// The exploded view: the steps of a path, scrubbed in order, with trails. The server's playback moves the components,
/// so only poses on the path are shown.
export class ExplodePanel {
  readonly node = element("section", {
    id: "explode-panel",
    class: "docked",
    "aria-label": text("explode"),
    hidden: true,
  });
  private readonly status = element("p", { id: "explode-step", role: "status" });
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
  private readonly quick = element("input", {
    type: "range",
    min: "0",
    max: String(kMaxQuick),
    step: "0.02",
    value: "0",
    id: "explode-quick",
  });
  private readonly quickTools: HTMLElement;
  private readonly trails = new Trails();
  private readonly seeker: Seeker;
  private steps: GuideStep[] = [];
  private savedView: View | null = null;
  /// True if this panel has started the playback.
  private opened = false;
  private shownModel: ModelEvent | null = null;
  /// End of the shown trails [s]; null: no trails.
  private shownTime: number | null = null;

  constructor(private readonly session: Session) {
    this.seeker = new Seeker(session);
    this.before = button({
      icon: "start",
      label: text("explode.before"),
      id: "explode-before",
      press: () => this.scrubTo(Math.ceil(this.position() - kSamePosition) - 1),
    });
    this.after = button({
      icon: "end",
      label: text("explode.after"),
      id: "explode-after",
      press: () => this.scrubTo(Math.floor(this.position() + kSamePosition) + 1),
    });
    this.slider.oninput = () => this.scrubTo(Number(this.slider.value));
    this.tools = element("div", { class: "explode-tools" }, this.before, this.slider, this.after);
    this.quick.oninput = () => this.explodeQuickly(Number(this.quick.value));
    this.quickTools = element("label", { class: "explode-tools" }, text("explode.quick"), this.quick);
    this.node.append(this.status, this.tools, this.quickTools);
    session.viewport.scene.add(this.trails.object);
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    const { session } = this;
    void session.during(session.store.exploding ? this.close() : this.open());
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
    if (this.moves().length === 0) {
      this.savedView = session.viewport.rig.current;
      return;
    }
    const source = this.source();
    try {
      this.steps = await session.loadSteps(source);
    } catch (error) {
      session.onNote("warning", (error as Error).message);
    }
    const { rig } = session.viewport;
    this.savedView = rig.current;
    await twoFrames(); // the panel has taken its place
    rig.fit(pathExtent(session, this.steps));
    await this.seeker.seek(this.timeAt(this.moves().length), source);
    if (!session.store.exploding) return void session.send("stop", {});
    this.opened = true;
    session.notifier.notify();
  }

  private async close(): Promise<void> {
    this.reset();
    if (this.session.store.state?.playback) await this.session.send("stop", {});
  }

  private reset(): void {
    const { session } = this;
    this.opened = false;
    this.steps = [];
    if (this.savedView) session.viewport.rig.fly(this.savedView);
    this.savedView = null;
    this.quick.value = "0";
    this.explodeQuickly(0);
    session.change(() => {
      session.store.exploding = false;
    });
  }

  /// Draws components away from the centre. An approximate view: no engine has checked it.
  private explodeQuickly(factor: number): void {
    const { viewport, store } = this.session;
    if (factor === store.quickExplode) return;
    this.session.change(() => {
      store.quickExplode = factor;
    });
    viewport.model?.explode(factor);
    viewport.updateBounds();
    if (factor > 0 && viewport.model && !viewport.rig.shows(viewport.model.bounds()))
      viewport.rig.fit(viewport.model.bounds());
  }

  /// Number of completed steps, with the fraction of the current one.
  private position(): number {
    const moves = this.moves();
    const time = this.session.playbackTime ?? 0;
    const next = moves.findIndex((move) => time < endOf(move) - kSameTime);
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
    if (model !== this.shownModel) this.savedView = null;
    this.shownModel = model;
    if (this.opened && !(exploding && state?.playback)) return this.reset();
    this.node.hidden = !exploding;
    this.showTrails();
    if (!exploding) return;
    const moves = this.moves();
    this.tools.hidden = moves.length === 0;
    this.quickTools.hidden = moves.length > 0;
    if (moves.length > 0) this.explodeQuickly(0);
    if (moves.length === 0) return setText(this.status, text("explode.none"));
    const position = this.position();
    this.slider.max = String(moves.length);
    if (!this.seeker.busy) this.slider.value = String(position);
    this.slider.disabled = this.before.disabled = this.after.disabled = !control;
    const shown = Math.ceil(position - kSamePosition);
    const step = { step: shown, count: moves.length, label: moves[shown - 1]?.label ?? "" };
    // Before the first seek is answered, no step is shown yet.
    const status = state?.playback ? text(shown === 0 ? "explode.assembled" : "explode.step", step) : "";
    setText(this.status, status);
    this.slider.setAttribute("aria-valuetext", status);
  }

  private showTrails(): void {
    const { exploding, model } = this.session.store;
    const { playbackTime } = this.session;
    const time = exploding && this.steps.length > 0 ? playbackTime : null;
    if (time === this.shownTime) return;
    this.shownTime = time;
    const center = (c: number): Vector3 => {
      const [low, high] = model!.components[c].bounds;
      return new Vector3(...low).add(new Vector3(...high)).multiplyScalar(0.5);
    };
    const size = diagonalOf(this.session.modelBox);
    const segments = time === null ? [] : trailsUntil(this.steps, time, center, size);
    this.trails.show(segments, this.session.viewport.palette.ghost);
  }
}

function diagonalOf(box: Box3): number {
  return box.getSize(new Vector3()).length();
}

/// Resolves when the page has been laid out anew.
function twoFrames(): Promise<void> {
  return new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve())));
}
