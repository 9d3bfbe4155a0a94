// SPDX-License-Identifier: Apache-2.0
import { Box3, Vector3 } from "three";
import { type GuideStep, type PathFile, stepsOfPath } from "./guide.ts";
import { JobList } from "./job_list.ts";
import { groupedNamesText, namesText } from "./names.ts";
import { readGlb } from "./scene/glb.ts";
import { ModelView } from "./scene/model_view.ts";
import type { Viewport } from "./scene/viewport.ts";
import { emptyStore, Notifier, type Store } from "./store.ts";
import { text } from "./strings.ts";
import { shownUnit, showUnit } from "./units.ts";
import { Connection, type Transport } from "./wire/connection.ts";
import type { Commands, FreeDirection, ModelEvent, Move, Reason, Source, StateEvent } from "./wire/messages.ts";
import type { PoseFrame, WirePose } from "./wire/structs.ts";

/// The client side of the server's session, and the model view that shows it. Components are drawn only at poses that
/// the server sent.
export class Session {
  readonly store: Store = emptyStore();
  readonly notifier: Notifier;
  readonly jobs: JobList;
  /// Shows a message to the user.
  onNote: (level: "note" | "warning", message: string) => void = () => {};
  /// Listeners of pose frames of the current state.
  onFrame: ((frame: PoseFrame) => void)[] = [];

  private loading: Promise<void> | null = null;
  /// Number of running actions of several requests.
  private actions = 0;

  constructor(
    readonly viewport: Viewport,
    readonly connection: Transport = new Connection(),
  ) {
    const { store } = this;
    this.notifier = new Notifier(
      () => viewport.invalidate(),
      () => viewport.requestFrame(),
    );
    viewport.beforeRender.push(() => {
      this.notifier.flush();
      return false;
    });
    connection.onLink = (link) =>
      this.change(() => {
        store.link = link;
      });
    connection.onFrame = (frame) => this.applyFrame(frame);
    connection.on("hello", ({ roots, extensions }) =>
      this.change(() => {
        Object.assign(store, { roots, extensions });
      }),
    );
    connection.on("control", ({ control, clients }) => this.change(() => Object.assign(store, { control, clients })));
    this.jobs = new JobList(
      store,
      () => this.notifier.notifyPanels(),
      (level, message) => this.onNote(level, message),
    );
    connection.on("job", (job) => {
      this.jobs.apply(job);
      this.notifier.notifyPanels();
    });
    connection.on("log", ({ level, text: message }) => this.onNote(level, message));
    connection.on("error", ({ error }) => this.onNote("warning", error));
    connection.on("model", (model) => this.applyModel(model));
    connection.on("state", (state) => this.applyState(state));
  }

  /// Sends a command. If it is refused, shows the reason and returns null.
  async send<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1] | null> {
    try {
      return await this.connection.command(name, members);
    } catch (error) {
      this.onNote("warning", (error as Error).message);
      return null;
    } finally {
      this.notifier.notify();
    }
  }

  /// Has the planner find a removal path for the selection, and follows it.
  async findPath(): Promise<void> {
    const { selection } = this.store;
    if (selection.length === 0) return this.onNote("note", text("select.first"));
    await this.send("find_path", { components: selection });
  }

  /// Has the planner find what blocks the selected component.
  async requestReason(): Promise<void> {
    const { selection } = this.store;
    if (selection.length !== 1)
      return this.onNote("note", text(selection.length === 0 ? "select.first" : "select.one"));
    await this.send("why", { components: selection });
  }

  /// The blockers of the selection, found by the planner; null: not determined.
  get reason(): Reason | null {
    const { state, selection } = this.store;
    return state?.search?.reasons.find(({ component }) => selection.includes(component)) ?? null;
  }

  /// True if nothing moves: no grab, no automatic motion, no playback.
  get idle(): boolean {
    const { state } = this.store;
    return state?.hand == null && state?.automatic == null && state?.playback == null;
  }

  /// The straight directions found for exactly these components; null: not determined.
  directionsOf(components: number[]): FreeDirection[] | null {
    const { directions } = this.store;
    return directions?.components.join() === components.join() ? directions.directions : null;
  }

  /// File name of the model without its extension; "vice-parts" for the folder vice/parts.
  get fileStem(): string {
    return (this.store.model?.name ?? "dismantle").replace(/\.\w+$/, "").replaceAll("/", "-");
  }

  /// Bounding box of the assembled model [mm]; a point if there is no model.
  get modelBox(): Box3 {
    const [low, high] = this.store.model?.bounds ?? [
      [0, 0, 0],
      [0, 0, 0],
    ];
    return new Box3(new Vector3(...low), new Vector3(...high));
  }

  /// Fits the view to the selection, or to all visible components.
  fitView(): void {
    const { selection } = this.store;
    const { model, rig } = this.viewport;
    if (model) rig.fit(selection.length > 0 ? model.boundsOf(selection) : model.bounds());
  }

  /// Shows only the selection, or everything again.
  toggleIsolated(): void {
    const { state, selection } = this.store;
    if (state?.isolated) void this.send("restore", {});
    else if (selection.length > 0) void this.send("isolate", { components: selection });
  }

  /// Hides the selection; shows it again if a part of it is hidden.
  toggleHidden(): void {
    const { state, selection } = this.store;
    if (selection.length === 0) return;
    const hidden = selection.filter((c) => state?.components[c]?.hidden);
    if (hidden.length > 0) void this.send("show", { components: hidden });
    else void this.send("hide", { components: selection });
  }

  /// True if a component is hidden.
  get hasHidden(): boolean {
    return this.store.state?.components.some(({ hidden }) => hidden) ?? false;
  }

  /// Shows all hidden components.
  showAll(): void {
    const { state } = this.store;
    const components = state?.components.flatMap(({ hidden }, c) => (hidden ? [c] : [])) ?? [];
    if (state?.isolated) void this.send("restore", {});
    else if (components.length > 0) void this.send("show", { components });
  }

  /// Selects all components of the same shapes as the selected ones.
  selectSimilar(): void {
    const components = this.store.model?.components ?? [];
    const shapes = new Set(this.store.selection.map((c) => components[c]?.shape));
    this.select(components.flatMap(({ shape }, c) => (shapes.has(shape) ? [c] : [])));
  }

  /// Changes the store and notifies the panels.
  change(apply: () => void): void {
    apply();
    this.notifier.notify();
  }

  /// Name of a component; empty for null.
  nameOf(component: number | null): string {
    return component === null ? "" : (this.store.model?.components[component]?.name ?? "");
  }

  /// See namesText.
  namesOf(components: number[], max?: number): string {
    return namesText(this.store.model, components, max);
  }

  /// See groupedNamesText.
  groupedNamesOf(components: number[]): string {
    return groupedNamesText(this.store.model, components);
  }

  /// Keeps the session unsettled until an action of several requests has ended.
  async during(action: Promise<void>): Promise<void> {
    ++this.actions;
    await action.finally(() => --this.actions);
  }

  /// True if all commands are answered, all actions have ended and everything received is shown.
  get settled(): boolean {
    const answered = this.actions === 0 && this.connection.settled;
    return this.loading === null && answered && ![...this.store.jobs.values()].some(isRunning);
  }

  /// The current pose of a component; null: assembled.
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
    this.updateAppearances();
  }

  /// Highlights the component under the cursor.
  hover(component: number | null): void {
    if (component === this.store.hovered) return;
    this.change(() => {
      this.store.hovered = component;
    });
    this.updateAppearances();
  }

  /// Highlights the components that block the moving set.
  block(components: Set<number>): void {
    const before = this.store.blocking;
    if (components.size === before.size && [...components].every((c) => before.has(c))) return;
    this.change(() => {
      this.store.blocking = components;
    });
    this.updateAppearances();
  }

  /// The moves of the recording or of the guide.
  movesOf(source: Source): Move[] {
    const { state } = this.store;
    return (source === "guide" ? state?.guide?.moves : state?.moves) ?? [];
  }

  /// Time of the playback [s]; null: no playback.
  get playbackTime(): number | null {
    const { state, frame } = this.store;
    if (!state?.playback) return null;
    return frame?.playback ? frame.time : state.playback.time;
  }

  /// Loads the steps of the recording or of the guide from the server.
  async loadSteps(source: Source): Promise<GuideStep[]> {
    if (this.connection.steps) return this.connection.steps;
    const response = await this.connection.request(source === "guide" ? "/api/guide.json" : "/api/path.json");
    const names = this.store.model!.components.map(({ name }) => name);
    return stepsOfPath((await response.json()) as PathFile, names);
  }

  /// Assembles everything and makes the recording the guide.
  async followRecording(): Promise<void> {
    return this.during(this.makeGuide());
  }

  private async makeGuide(): Promise<void> {
    try {
      const path = await (await this.connection.request("/api/path.json")).blob();
      const name = `${this.fileStem}.path.json`;
      await this.connection.command("reset", {});
      await this.connection.request(`/api/guide?name=${encodeURIComponent(name)}`, { method: "POST", body: path });
    } catch (error) {
      this.onNote("warning", (error as Error).message);
    }
  }

  /// Shows lengths in inches instead of millimetres, or the other way round.
  toggleUnit(): void {
    this.change(() => showUnit(shownUnit() === "mm" ? "in" : "mm"));
  }

  /// Makes components translucent, or opaque if all of them are translucent.
  toggleXray(components: number[]): void {
    const { xray } = this.store;
    const on = !components.every((c) => xray.has(c));
    this.change(() => {
      for (const component of components) on ? xray.add(component) : xray.delete(component);
    });
    this.updateAppearances();
  }

  /// Updates how components are drawn after a change of the store.
  updateAppearances(): void {
    const { selection, hovered, xray, blocking } = this.store;
    const blockers = this.reason?.blockers ?? [];
    for (const view of this.viewport.model?.components ?? [])
      view.setAppearance({
        selected: selection.includes(view.index),
        hovered: hovered === view.index,
        xray: xray.has(view.index),
        blocking: blocking.has(view.index) || blockers.some(({ component }) => component === view.index),
      });
    this.viewport.invalidate();
  }

  private applyModel(model: ModelEvent): void {
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
      quickExplode: 0,
      frame: null,
    });
    const loading = this.load(model).finally(() => {
      if (this.loading === loading) this.loading = null;
    });
    this.loading = loading;
  }

  private async load(model: ModelEvent): Promise<void> {
    try {
      const response = await this.connection.request(`/api/model.glb?model=${model.number}`);
      const bytes = await response.arrayBuffer();
      if (this.store.model?.number !== model.number) return;
      this.viewport.setModel(new ModelView(readGlb(bytes), this.viewport.palette));
    } catch (error) {
      if (this.store.model?.number === model.number) this.onNote("warning", (error as Error).message);
      return;
    }
    if (this.store.state) this.showState(this.store.state);
    this.viewport.showWhole();
    this.notifier.notify();
  }

  private applyState(state: StateEvent): void {
    const reasonsChange = state.search !== null || this.store.state?.search != null;
    this.change(() => {
      this.store.state = state;
      // Frames before a state are outdated: the state has all poses.
      this.store.frame = null;
    });
    this.showState(state);
    if (reasonsChange) this.updateAppearances();
  }

  private showState(state: StateEvent): void {
    if (state.model !== this.store.model?.number) return;
    for (const view of this.viewport.model?.components ?? []) {
      const { hidden, removed } = state.components[view.index] ?? {};
      const moves = state.moving.includes(view.index);
      // The exploded view shows removed components, too, where the path has put them.
      const away = removed && !(this.store.exploding && state.playback);
      view.visible = moves || (!hidden && !away);
      view.setPose(poseFromState(state, view.index));
    }
    this.viewport.updateBounds();
    this.viewport.invalidate();
  }

  private applyFrame(frame: PoseFrame): void {
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

/// The directions in which the components can be removed without contact.
export function freeOf(directions: FreeDirection[] | null | undefined): FreeDirection[] {
  return directions?.filter(({ free }) => free) ?? [];
}
