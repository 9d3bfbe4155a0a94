// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { kIdentityPose, rotationOf } from "./pose.ts";
import { poseBetween } from "./screw.ts";
import type { Triple } from "./wire/messages.ts";
import type { WirePose } from "./wire/structs.ts";

/// The members of a path file that a guide needs (docs/formats.md).
export interface PathFile {
  moves: {
    label?: string;
    components: string[];
    frames: { t: number; position: Triple; rotation: WirePose["rotation"] }[];
  }[];
}

/// One step of a guide: the components to move and their motion.
export interface GuideStep {
  label: string;
  components: number[];
  frames: { t: number; pose: WirePose }[];
  duration: number;
}

/// Current pose of a component (null: assembled), and whether it was removed.
export interface ComponentStatus {
  pose: WirePose | null;
  removed: boolean;
}

/// Mistakes made and hints used in practice mode.
export interface Score {
  wrong: number;
  hints: number;
  contacts: number;
}

/// A step counts as done after this fraction of its displacement: nobody reaches the recorded end to the micrometre.
const kDoneFraction = 0.7;
/// A step also counts as done this close to its end [mm]; shorter displacements are not measured as a fraction.
const kDoneDistance = 2;
/// Steps that turn by less count as translations [rad].
const kMinRotation = 0.05;
const kPenalties = { wrong: 10, hints: 5, contacts: 1 };

/// The steps of a path. Moves with components that the assembly does not have are skipped.
export function stepsOfPath(path: PathFile, names: string[]): GuideStep[] {
  const index = new Map(names.map((name, i) => [name, i]));
  return path.moves.flatMap(({ label, components, frames }) => {
    const known = components.map((name) => index.get(name)).filter((c): c is number => c !== undefined);
    if (known.length !== components.length || frames.length === 0) return [];
    const poses = frames.map(({ t, position, rotation }) => ({ t, pose: { position, rotation } }));
    return [{ label: label ?? components.join(", "), components: known, frames: poses, duration: frames.at(-1)!.t }];
  });
}

/// The pose of a step's components at a time of the step [s].
export function poseAt(step: GuideStep, time: number): WirePose {
  const { frames } = step;
  const after = frames.findIndex(({ t }) => t >= time);
  if (after === 0) return frames[0].pose;
  if (after < 0) return frames[frames.length - 1].pose;
  const [a, b] = [frames[after - 1], frames[after]];
  return poseBetween(a.pose, b.pose, b.t > a.t ? (time - a.t) / (b.t - a.t) : 1);
}

/// True if a component has reached the step's end, most of its displacement, or has been removed.
export function isDone(step: GuideStep, now: ComponentStatus): boolean {
  if (now.removed) return true;
  const start = new Vector3(...step.frames[0].pose.position);
  const whole = new Vector3(...step.frames[step.frames.length - 1].pose.position).sub(start);
  const moved = new Vector3(...(now.pose ?? kIdentityPose).position).sub(start);
  const atEnd = moved.distanceTo(whole) < kDoneDistance;
  if (whole.length() < kDoneDistance) return atEnd && !rotationPending(step, now.pose);
  return atEnd || moved.dot(whole) / whole.lengthSq() >= kDoneFraction;
}

/// Index of the first unfinished step, starting at `from`; the number of steps if all are done.
export function nextStep(steps: GuideStep[], from: number, statusOf: (component: number) => ComponentStatus): number {
  for (let i = from; i < steps.length; ++i)
    if (!steps[i].components.every((component) => isDone(steps[i], statusOf(component)))) return i;
  return steps.length;
}

/// Points in practice mode, 0 to 100.
export function scoreOf({ wrong, hints, contacts }: Score): number {
  return Math.max(0, 100 - wrong * kPenalties.wrong - hints * kPenalties.hints - contacts * kPenalties.contacts);
}

/// True if the step rotates the component and most of that rotation is still missing.
function rotationPending(step: GuideStep, pose: WirePose | null): boolean {
  const [start, end] = [step.frames[0].pose, step.frames[step.frames.length - 1].pose];
  const whole = rotationOf(start).angleTo(rotationOf(end));
  const turned = rotationOf(start).angleTo(rotationOf(pose ?? kIdentityPose));
  return whole > kMinRotation && turned < kDoneFraction * whole;
}
