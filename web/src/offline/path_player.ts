// SPDX-License-Identifier: Apache-2.0
import { type GuideStep, poseAt } from "../guide.ts";
import { kIdentityPose } from "../pose.ts";
import { text } from "../strings.ts";
import type { Link, Transport } from "../wire/connection.ts";
import { EventListeners } from "../wire/event_listeners.ts";
import type { Commands, ComponentState, Events, ModelEvent, StateEvent } from "../wire/messages.ts";
import type { PoseFrame, WirePose } from "../wire/structs.ts";

type Listener<T> = (value: T) => void;
type Handlers = { [Name in keyof Commands]?: (members: Commands[Name][0]) => void };

/// The content of an exported page.
export interface OfflineContent {
  model: ModelEvent;
  glb: ArrayBuffer;
  steps: GuideStep[];
}

/// Plays a path in place of the server: executes the commands that need no engine and emits states and poses as the
/// server does. Contact is not checked: it was when the path was made.
export class PathPlayer implements Transport {
  onFrame: Listener<PoseFrame> = () => {};
  onLink: Listener<Link> = () => {};
  readonly settled = true;

  private readonly listeners = new EventListeners();
  private readonly startTimes: number[] = [];
  private readonly duration: number;
  private readonly hidden = new Set<number>();
  private hiddenBefore: Set<number> | null = null;
  private time = 0;
  private speed = 1;
  private playing = false;
  /// End of a playback of a single step [s]; null: plays to the end of the path.
  private endTime: number | null = null;
  private states = 0;
  private lastTick = 0;

  constructor(private readonly content: OfflineContent) {
    let start = 0;
    for (const { duration } of content.steps) {
      this.startTimes.push(start);
      start += duration;
    }
    this.duration = start;
  }

  connect(): void {
    this.onLink("open");
    this.listeners.emit("control", { control: true, clients: 1 });
    this.listeners.emit("model", this.content.model);
    this.emitState();
  }

  reconnect(): void {}
  sendStruct = () => true;

  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void {
    this.listeners.on(name, listener);
  }

  async command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]> {
    const handler = this.handlers[name] as ((members: Commands[Name][0]) => void) | undefined;
    if (!handler) throw new Error(text("offline.cannot"));
    handler(members);
    this.emitState();
    return {} as Commands[Name][1];
  }

  get steps(): GuideStep[] {
    return this.content.steps;
  }

  async request(address: string): Promise<globalThis.Response> {
    if (!address.startsWith("/api/model.glb")) throw new Error(text("offline.cannot"));
    return new Response(this.content.glb);
  }

  /// Plays one step from its start to its end.
  playStep(step: number): void {
    this.time = this.startTimes[step];
    this.endTime = this.startTimes[step] + this.content.steps[step].duration;
    this.start(1);
    this.emitState();
  }

  /// Index of the step that is played now, or was last.
  get step(): number {
    const after = this.startTimes.findIndex((start) => start > this.time);
    const step = (after < 0 ? this.startTimes.length : after) - 1;
    // Exactly between two steps, the one that was played counts.
    return step > 0 && this.endTime === this.time ? step - 1 : step;
  }

  private readonly handlers: Handlers = {
    play: ({ speed }) => {
      this.endTime = null;
      if (speed < 0 && this.time <= 0) this.time = this.duration;
      this.start(speed);
    },
    pause: () => {
      this.playing = false;
    },
    seek: ({ time }) => {
      this.endTime = null;
      this.time = Math.max(0, Math.min(this.duration, time));
    },
    hide: ({ components }) => {
      for (const component of components) this.hidden.add(component);
    },
    show: ({ components }) => {
      for (const component of components) this.hidden.delete(component);
    },
    isolate: ({ components }) => {
      this.hiddenBefore ??= new Set(this.hidden);
      this.content.model.components.forEach((_, i) => {
        if (!components.includes(i)) this.hidden.add(i);
      });
    },
    restore: () => {
      if (!this.hiddenBefore) return;
      this.hidden.clear();
      for (const component of this.hiddenBefore) this.hidden.add(component);
      this.hiddenBefore = null;
    },
  };

  private start(speed: number): void {
    this.speed = speed;
    if (this.playing) return;
    this.playing = true;
    this.lastTick = performance.now();
    const tick = (): void => {
      if (!this.playing) return;
      this.advance(performance.now());
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  private advance(now: number): void {
    const step = this.step;
    const last = this.endTime ?? this.duration;
    const target = this.time + (this.speed * (now - this.lastTick)) / 1000;
    this.lastTick = now;
    this.time = Math.max(0, Math.min(last, target));
    if (this.time === (this.speed < 0 ? 0 : last)) this.playing = false;
    if (!this.playing || this.step !== step) this.emitState();
    this.emitPose();
  }

  /// The pose of each component; null: assembled.
  private poses(): (WirePose | null)[] {
    const poses: (WirePose | null)[] = this.content.model.components.map(() => null);
    const { steps } = this.content;
    // Before its step begins, a component is at the step's start: of an assembly path, that is not its assembled
    // position.
    for (let i = steps.length - 1; i >= 0; --i) for (const c of steps[i].components) poses[c] = steps[i].frames[0].pose;
    for (let i = 0; i <= this.step; ++i)
      for (const c of steps[i].components) poses[c] = poseAt(steps[i], this.time - this.startTimes[i]);
    return poses;
  }

  private emitState(): void {
    const { steps } = this.content;
    const step = this.step;
    const components = this.poses().map((pose, i): ComponentState => {
      const state: ComponentState = pose && isMoved(pose) ? { pose: numbersOf(pose) } : {};
      if (this.hidden.has(i)) state.hidden = true;
      return state;
    });
    const state: StateEvent = {
      number: ++this.states,
      model: this.content.model.number,
      components,
      isolated: this.hiddenBefore !== null,
      hand: null,
      moving: steps[step]?.components ?? [],
      automatic: null,
      response: "slide",
      responses: ["slide"],
      method: "certificates",
      undo: null,
      redo: null,
      moves: steps.map(({ label, components: moved, duration }, i) => ({
        label,
        components: moved,
        start: this.startTimes[i],
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
    this.listeners.emit("state", state);
  }

  private emitPose(): void {
    const step = this.content.steps[this.step];
    if (!step) return;
    this.onFrame({
      ...poseAt(step, this.time - this.startTimes[this.step]),
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
}

function numbersOf({ position, rotation }: WirePose): NonNullable<ComponentState["pose"]> {
  return [...position, ...rotation];
}

function isMoved(pose: WirePose): boolean {
  const assembled = numbersOf(kIdentityPose);
  return numbersOf(pose).some((value, k) => value !== assembled[k]);
}
