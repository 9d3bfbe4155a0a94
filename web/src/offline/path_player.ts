// SPDX-License-Identifier: Apache-2.0
import { type GuideStep, poseAt } from "../guide.ts";
import { text } from "../strings.ts";
import type { Link, Wire } from "../wire/connection.ts";
import type { Commands, ComponentState, Events, ModelEvent, StateEvent } from "../wire/messages.ts";
import type { PoseFrame, WirePose } from "../wire/structs.ts";

type Listener<T> = (value: T) => void;
type Handlers = { [Name in keyof Commands]?: (members: Commands[Name][0]) => void };

const kAssembled = [0, 0, 0, 1, 0, 0, 0];

/// What an offline page holds.
export interface Film {
  model: ModelEvent;
  glb: ArrayBuffer;
  steps: GuideStep[];
}

/// Plays a path in the server's place: it answers what a viewer without an engine can be asked, and tells states and
/// poses as the server does. Nothing is checked for contact: the path was, when it was made.
export class PathPlayer implements Wire {
  onFrame: Listener<PoseFrame> = () => {};
  onLink: Listener<Link> = () => {};
  readonly settled = true;

  private readonly listeners: { [Name in keyof Events]?: Listener<Events[Name]>[] } = {};
  private readonly starts: number[] = [];
  private readonly duration: number;
  private readonly hidden = new Set<number>();
  private shownBefore: Set<number> | null = null;
  private time = 0;
  private speed = 1;
  private playing = false;
  /// Where a playback stops that is of one step only.
  private until: number | null = null;
  private states = 0;
  private ticked = 0;

  constructor(private readonly film: Film) {
    let start = 0;
    for (const { duration } of film.steps) {
      this.starts.push(start);
      start += duration;
    }
    this.duration = start;
  }

  connect(): void {
    this.onLink("open");
    this.tell("control", { control: true, clients: 1 });
    this.tell("model", this.film.model);
    this.tellState();
  }

  reconnect(): void {}
  sendStruct(): void {}

  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void {
    const listeners = (this.listeners[name] ?? []) as Listener<Events[Name]>[];
    listeners.push(listener);
    (this.listeners as Record<string, unknown>)[name] = listeners;
  }

  async command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]> {
    const handler = this.handlers[name] as ((members: Commands[Name][0]) => void) | undefined;
    if (!handler) throw new Error(text("offline.cannot"));
    handler(members);
    this.tellState();
    return {} as Commands[Name][1];
  }

  async request(address: string): Promise<globalThis.Response> {
    if (!address.startsWith("/api/model.glb")) throw new Error(text("offline.cannot"));
    return new Response(this.film.glb);
  }

  /// Plays one step from its beginning to its end.
  playStep(step: number): void {
    this.time = this.starts[step];
    this.until = this.starts[step] + this.film.steps[step].duration;
    this.start(1);
    this.tellState();
  }

  /// The step that is played now, or was last.
  get step(): number {
    const after = this.starts.findIndex((start) => start > this.time);
    const step = (after < 0 ? this.starts.length : after) - 1;
    // At the end of the one and the beginning of the next: the one that one came from.
    return step > 0 && this.until === this.time ? step - 1 : step;
  }

  private readonly handlers: Handlers = {
    play: ({ speed }) => {
      this.until = null;
      if (speed < 0 && this.time <= 0) this.time = this.duration;
      this.start(speed);
    },
    pause: () => {
      this.playing = false;
    },
    seek: ({ time }) => {
      this.until = null;
      this.time = Math.max(0, Math.min(this.duration, time));
    },
    hide: ({ components }) => {
      for (const component of components) this.hidden.add(component);
    },
    show: ({ components }) => {
      for (const component of components) this.hidden.delete(component);
    },
    isolate: ({ components }) => {
      this.shownBefore ??= new Set(this.hidden);
      this.film.model.components.forEach((_, i) => {
        if (!components.includes(i)) this.hidden.add(i);
      });
    },
    restore: () => {
      if (!this.shownBefore) return;
      this.hidden.clear();
      for (const component of this.shownBefore) this.hidden.add(component);
      this.shownBefore = null;
    },
  };

  private start(speed: number): void {
    this.speed = speed;
    if (this.playing) return;
    this.playing = true;
    this.ticked = performance.now();
    const tick = (): void => {
      if (!this.playing) return;
      this.advance(performance.now());
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  private advance(now: number): void {
    const step = this.step;
    const last = this.until ?? this.duration;
    const wanted = this.time + (this.speed * (now - this.ticked)) / 1000;
    this.ticked = now;
    this.time = Math.max(0, Math.min(last, wanted));
    if (this.time === (this.speed < 0 ? 0 : last)) this.playing = false;
    if (!this.playing || this.step !== step) this.tellState();
    this.tellPose();
  }

  /// Where every component is; null: assembled.
  private poses(): (WirePose | null)[] {
    const poses: (WirePose | null)[] = this.film.model.components.map(() => null);
    const { steps } = this.film;
    // What a step moves stands at its beginning before: of a path together, that is not where it is assembled.
    for (let i = steps.length - 1; i >= 0; --i) for (const c of steps[i].components) poses[c] = steps[i].frames[0].pose;
    for (let i = 0; i <= this.step; ++i)
      for (const c of steps[i].components) poses[c] = poseAt(steps[i], this.time - this.starts[i]);
    return poses;
  }

  private tellState(): void {
    const { steps } = this.film;
    const step = this.step;
    const components = this.poses().map((pose, i): ComponentState => {
      const moved = pose && [...pose.position, ...pose.rotation].some((value, k) => value !== kAssembled[k]);
      const state: ComponentState = moved ? { pose: [...pose.position, ...pose.rotation] } : {};
      if (this.hidden.has(i)) state.hidden = true;
      return state;
    });
    const state: StateEvent = {
      number: ++this.states,
      model: this.film.model.number,
      components,
      isolated: this.shownBefore !== null,
      hand: null,
      moving: steps[step]?.components ?? [],
      automatic: null,
      response: "slide",
      undo: null,
      redo: null,
      moves: steps.map(({ label, components: moved, duration }, i) => ({
        label,
        components: moved,
        start: this.starts[i],
        duration,
      })),
      playback: {
        source: "recording",
        time: this.time,
        duration: this.duration,
        speed: this.speed,
        playing: this.playing,
        move: Math.max(0, step),
        blocked: null,
      },
      guide: null,
      search: null,
      resumed: false,
      resumable: false,
    };
    this.tell("state", state);
  }

  private tellPose(): void {
    const step = this.film.steps[this.step];
    if (!step) return;
    this.onFrame({
      ...poseAt(step, this.time - this.starts[this.step]),
      reached: true,
      blocked: false,
      playback: true,
      automatic: false,
      state: this.states,
      grip: 0,
      number: 0,
      time: this.time,
      clearance: Number.NaN,
      stepTime: 0,
      stepsPerSecond: 0,
      contacts: [],
    });
  }

  private tell<Name extends keyof Events>(name: Name, event: Events[Name]): void {
    for (const listener of this.listeners[name] ?? []) (listener as Listener<Events[Name]>)(event);
  }
}
