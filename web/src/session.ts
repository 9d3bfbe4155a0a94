// SPDX-License-Identifier: Apache-2.0
import { readGlb } from "./scene/glb.ts";
import { ModelView } from "./scene/model_view.ts";
import type { Viewport } from "./scene/viewport.ts";
import { emptyStore, Notifier, type Store } from "./store.ts";
import { text } from "./strings.ts";
import { Connection, type Wire } from "./wire/connection.ts";
import type { Commands, JobEvent, ModelEvent, Move, Reason, Source, StateEvent } from "./wire/messages.ts";
import type { PoseFrame, WirePose } from "./wire/structs.ts";

/// The server's session as this page knows it, and the model that shows it: components are only ever drawn where the
/// server says that they are.
export class Session {
  readonly store: Store = emptyStore();
  readonly notifier: Notifier;
  /// Shows the user a sentence.
  onNote: (level: "note" | "warning", sentence: string) => void = () => {};
  onModel: () => void = () => {};
  onFrame: ((frame: PoseFrame) => void)[] = [];

  private loading: Promise<void> | null = null;

  constructor(
    readonly viewport: Viewport,
    readonly connection: Wire = new Connection(),
  ) {
    const { store } = this;
    this.notifier = new Notifier(() => viewport.invalidate());
    viewport.beforePicture.push(() => {
      this.notifier.tell();
      return false;
    });
    connection.onLink = (link) =>
      this.change(() => {
        store.link = link;
      });
    connection.onFrame = (frame) => this.takeFrame(frame);
    connection.on("hello", ({ roots }) =>
      this.change(() => {
        store.roots = roots;
      }),
    );
    connection.on("control", ({ control, clients }) => this.change(() => Object.assign(store, { control, clients })));
    connection.on("job", (job) => this.change(() => this.takeJob(job)));
    connection.on("log", ({ level, text: sentence }) => this.onNote(level, sentence));
    connection.on("error", ({ error }) => this.onNote("warning", error));
    connection.on("model", (model) => this.takeModel(model));
    connection.on("state", (state) => this.takeState(state));
  }

  /// Sends a command; a refusal is shown to the user and gives null.
  async ask<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1] | null> {
    try {
      return await this.connection.command(name, members);
    } catch (error) {
      this.onNote("warning", (error as Error).message);
      return null;
    } finally {
      this.notifier.notify();
    }
  }

  /// Has the planner find a way out for what is selected, and take it out.
  async findPath(): Promise<void> {
    const { selection } = this.store;
    if (selection.length > 0) await this.ask("find_path", { components: selection });
  }

  /// Has the planner say why what is selected stays.
  async askWhy(): Promise<void> {
    const { selection } = this.store;
    if (selection.length === 1) await this.ask("why", { components: selection });
  }

  /// Why the selection stays, where the planner has said so.
  get reason(): Reason | null {
    const { state, selection } = this.store;
    return state?.search?.reasons.find(({ component }) => selection.includes(component)) ?? null;
  }

  /// Shows only what is selected, or everything again.
  toggleIsolated(): void {
    const { state, selection } = this.store;
    if (state?.isolated) void this.ask("restore", {});
    else if (selection.length > 0) void this.ask("isolate", { components: selection });
  }

  /// Hides what is selected; where some of it is hidden, shows that again.
  toggleHidden(): void {
    const { state, selection } = this.store;
    if (selection.length === 0) return;
    const hidden = selection.filter((c) => state?.components[c]?.hidden);
    if (hidden.length > 0) void this.ask("show", { components: hidden });
    else void this.ask("hide", { components: selection });
  }

  change(apply: () => void): void {
    apply();
    this.notifier.notify();
  }

  nameOf(component: number | null): string {
    return component === null ? "" : (this.store.model?.components[component]?.name ?? "");
  }

  /// The first few names, and how many more there are.
  namesOf(components: number[], most = 3): string {
    const names = components
      .slice(0, most)
      .map((c) => this.nameOf(c))
      .join(", ");
    return components.length > most ? text("names.more", { names, count: components.length - most }) : names;
  }

  /// Whether everything received is shown and everything asked is answered.
  get settled(): boolean {
    return this.loading === null && this.connection.settled && ![...this.store.jobs.values()].some(isRunning);
  }

  /// Where a component is now; null: assembled.
  poseOf(component: number): WirePose | null {
    const { state, frame } = this.store;
    if (frame && state?.moving.includes(component) && frame.state === state.number) return frame;
    return poseFromState(state, component);
  }

  select(components: number[]): void {
    const before = this.store.selection;
    if (components.length === before.length && components.every((c, i) => c === before[i])) return;
    this.change(() => {
      this.store.selection = components;
      this.store.directions = null;
      this.store.stuck = null;
    });
    this.showLooks();
  }

  hover(component: number | null): void {
    if (component === this.store.hovered) return;
    this.change(() => {
      this.store.hovered = component;
    });
    this.showLooks();
  }

  block(components: Set<number>): void {
    const before = this.store.blocking;
    if (components.size === before.size && [...components].every((c) => before.has(c))) return;
    this.change(() => {
      this.store.blocking = components;
    });
    this.showLooks();
  }

  movesOf(source: Source): Move[] {
    const { state } = this.store;
    return (source === "guide" ? state?.guide?.moves : state?.moves) ?? [];
  }

  /// Where the playback is [s]; null where none is open.
  get playedTime(): number | null {
    const { state, frame } = this.store;
    if (!state?.playback) return null;
    return frame?.playback ? frame.time : state.playback.time;
  }

  /// Begins anew with the recording as the guide.
  async followRecording(): Promise<void> {
    try {
      const path = await (await this.connection.request("/api/path.json")).blob();
      const name = `${(this.store.model?.name ?? "").replace(/\.\w+$/, "")}.path.json`;
      await this.connection.command("reset", {});
      await this.connection.request(`/api/guide?name=${encodeURIComponent(name)}`, { method: "POST", body: path });
    } catch (error) {
      this.onNote("warning", (error as Error).message);
    }
  }

  toggleXray(components: number[]): void {
    const { xray } = this.store;
    const on = !components.every((c) => xray.has(c));
    this.change(() => {
      for (const component of components) on ? xray.add(component) : xray.delete(component);
    });
    this.showLooks();
  }

  showLooks(): void {
    const { selection, hovered, xray, blocking } = this.store;
    const explained = this.reason?.blockers ?? [];
    for (const view of this.viewport.model?.components ?? [])
      view.setLook({
        selected: selection.includes(view.index),
        hovered: hovered === view.index,
        xray: xray.has(view.index),
        blocking: blocking.has(view.index) || explained.some(({ component }) => component === view.index),
      });
    this.viewport.invalidate();
  }

  private takeJob(job: JobEvent): void {
    this.store.jobs.set(job.job, job);
    if (job.status === "running") return;
    this.store.jobs.delete(job.job);
    if (job.status === "failed") this.onNote("warning", text("job.failed", { name: job.name, error: job.error ?? "" }));
  }

  private takeModel(model: ModelEvent): void {
    const known = this.store.model?.number === model.number && this.store.model.sha256 === model.sha256;
    this.change(() => {
      this.store.model = model;
    });
    if (known && this.viewport.model) return;
    Object.assign(this.store, { selection: [], hovered: null, xray: new Set(), blocking: new Set() });
    Object.assign(this.store, {
      pairs: null,
      directions: null,
      stuck: null,
      planes: [],
      exploding: false,
      frame: null,
    });
    const loading = this.load(model).finally(() => {
      if (this.loading === loading) this.loading = null;
    });
    this.loading = loading;
  }

  private async load(model: ModelEvent): Promise<void> {
    try {
      const answer = await this.connection.request(`/api/model.glb?model=${model.number}`);
      const bytes = await answer.arrayBuffer();
      if (this.store.model?.number !== model.number) return;
      this.viewport.setModel(new ModelView(readGlb(bytes), this.viewport.palette));
    } catch (error) {
      if (this.store.model?.number === model.number) this.onNote("warning", (error as Error).message);
      return;
    }
    if (this.store.state) this.showState(this.store.state);
    this.onModel();
    this.notifier.notify();
  }

  private takeState(state: StateEvent): void {
    const explains = state.search !== null || this.store.state?.search != null;
    this.change(() => {
      this.store.state = state;
      // A state says where everything is; the frames of an earlier one are old.
      this.store.frame = null;
    });
    this.showState(state);
    if (explains) this.showLooks();
  }

  private showState(state: StateEvent): void {
    if (state.model !== this.store.model?.number) return;
    for (const view of this.viewport.model?.components ?? []) {
      const { hidden, removed } = state.components[view.index] ?? {};
      const moves = state.moving.includes(view.index);
      // Exploded, what was taken out is shown where the path has put it.
      const gone = removed && !(this.store.exploding && state.playback);
      view.visible = moves || (!hidden && !gone);
      view.setPose(poseFromState(state, view.index));
    }
    this.viewport.updateBounds();
    this.viewport.invalidate();
  }

  private takeFrame(frame: PoseFrame): void {
    const { state } = this.store;
    if (!state || frame.state !== state.number) return;
    this.change(() => {
      this.store.frame = frame;
    });
    for (const component of state.moving) this.viewport.model?.components[component]?.setPose(frame);
    for (const listener of this.onFrame) listener(frame);
    this.viewport.invalidate();
  }
}

function isRunning(job: { status: string }): boolean {
  return job.status === "running";
}

function poseFromState(state: StateEvent | null, component: number): WirePose | null {
  const pose = state?.components[component]?.pose;
  if (!pose) return null;
  const [x, y, z, w, qx, qy, qz] = pose;
  return { position: [x, y, z], rotation: [w, qx, qy, qz] };
}
