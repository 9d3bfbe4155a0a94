// SPDX-License-Identifier: Apache-2.0
import { Quaternion, Vector3 } from "three";
import { poseBetween } from "./screw.ts";
import type { Triple } from "./wire/messages.ts";
import type { WirePose } from "./wire/structs.ts";

/// A path file, as far as a guide needs it (docs/formats.md).
export interface PathFile {
  moves: {
    label?: string;
    components: string[];
    frames: { t: number; position: Triple; rotation: WirePose["rotation"] }[];
  }[];
}

/// One step of a guide: which components go where.
export interface GuideStep {
  label: string;
  components: number[];
  frames: { t: number; pose: WirePose }[];
  duration: number;
}

export interface ComponentNow {
  pose: WirePose | null;
  removed: boolean;
}

/// What practice costs.
export interface Score {
  wrong: number;
  hints: number;
  contacts: number;
}

/// So much of a step's way counts as having done it: nobody moves a component to the micrometre where another one did.
const kEnough = 0.7;
/// Ways shorter than this are done when their end is this near [mm].
const kNear = 2;
const kPoints = { wrong: 10, hints: 5, contacts: 1 };

/// The steps of a path; moves of components that the assembly has not are passed over.
export function stepsOfPath(path: PathFile, names: string[]): GuideStep[] {
  const index = new Map(names.map((name, i) => [name, i]));
  return path.moves.flatMap(({ label, components, frames }) => {
    const known = components.map((name) => index.get(name)).filter((c): c is number => c !== undefined);
    if (known.length !== components.length || frames.length === 0) return [];
    const poses = frames.map(({ t, position, rotation }) => ({ t, pose: { position, rotation } }));
    return [{ label: label ?? components.join(", "), components: known, frames: poses, duration: frames.at(-1)!.t }];
  });
}

/// Where a step's components are at a time of it.
export function poseAt(step: GuideStep, time: number): WirePose {
  const { frames } = step;
  const after = frames.findIndex(({ t }) => t >= time);
  if (after === 0) return frames[0].pose;
  if (after < 0) return frames[frames.length - 1].pose;
  const [a, b] = [frames[after - 1], frames[after]];
  return poseBetween(a.pose, b.pose, b.t > a.t ? (time - a.t) / (b.t - a.t) : 1);
}

/// Whether a component is where a step leads, or far enough on the way, or gone altogether.
export function isDone(step: GuideStep, now: ComponentNow): boolean {
  if (now.removed) return true;
  const start = new Vector3(...step.frames[0].pose.position);
  const way = new Vector3(...step.frames[step.frames.length - 1].pose.position).sub(start);
  const gone = new Vector3(...(now.pose?.position ?? [0, 0, 0])).sub(start);
  if (way.length() < kNear) return gone.distanceTo(way) < kNear && !sameTurn(step, now.pose);
  return gone.dot(way) / way.lengthSq() >= kEnough || gone.distanceTo(way) < kNear;
}

/// The first step that is not done yet, not before `from`; the number of steps where all are.
export function nextStep(steps: GuideStep[], from: number, nowOf: (component: number) => ComponentNow): number {
  for (let i = from; i < steps.length; ++i)
    if (!steps[i].components.every((component) => isDone(steps[i], nowOf(component)))) return i;
  return steps.length;
}

/// From 100 down.
export function pointsOf({ wrong, hints, contacts }: Score): number {
  return Math.max(0, 100 - wrong * kPoints.wrong - hints * kPoints.hints - contacts * kPoints.contacts);
}

/// A step that only turns is not done before the component has turned.
function sameTurn(step: GuideStep, pose: WirePose | null): boolean {
  const [start, end] = [step.frames[0].pose, step.frames[step.frames.length - 1].pose];
  const whole = quaternion(start).angleTo(quaternion(end));
  const made = quaternion(start).angleTo(pose ? quaternion(pose) : new Quaternion());
  return whole > 0.05 && made < kEnough * whole;
}

function quaternion({ rotation: [w, x, y, z] }: WirePose): Quaternion {
  return new Quaternion(x, y, z, w);
}
