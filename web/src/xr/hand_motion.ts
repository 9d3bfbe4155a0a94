// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Quaternion, Vector3 } from "three";

/// Where a hand is: in metres, y up, as the headset tells it.
export interface HandPose {
  position: Vector3;
  orientation: Quaternion;
}

/// The rigid motion that takes one hand from where it was to where it is.
export function motionOfHand(then: HandPose, now: HandPose): Matrix4 {
  const turn = now.orientation.clone().multiply(then.orientation.clone().invert());
  return rigidMotion(turn, then.position, now.position);
}

/// The rigid motion that takes what both hands hold along: its middle goes with the middle of the hands, and the line between
/// them with their line.
export function motionOfHands(then: [HandPose, HandPose], now: [HandPose, HandPose]): Matrix4 {
  const turn = new Quaternion().setFromUnitVectors(lineOf(then).normalize(), lineOf(now).normalize());
  return rigidMotion(turn, middleOf(then), middleOf(now));
}

/// What both hands do to the room that they pull at: its middle goes with theirs, it grows as they part, and turns about the
/// vertical only, so that nobody falls over.
export function roomMotionOfHands(then: [HandPose, HandPose], now: [HandPose, HandPose]): Matrix4 {
  const [a, b] = [lineOf(then), lineOf(now)];
  const growth = b.length() / Math.max(1e-6, a.length());
  const angle = Math.atan2(-b.z, b.x) - Math.atan2(-a.z, a.x);
  const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle);
  const about = middleOf(then).multiplyScalar(-growth).applyQuaternion(turn).add(middleOf(now));
  return new Matrix4().compose(about, turn, new Vector3(growth, growth, growth));
}

function rigidMotion(turn: Quaternion, from: Vector3, to: Vector3): Matrix4 {
  const offset = to.clone().sub(from.clone().applyQuaternion(turn));
  return new Matrix4().compose(offset, turn, new Vector3(1, 1, 1));
}

function middleOf([a, b]: [HandPose, HandPose]): Vector3 {
  return a.position.clone().add(b.position).multiplyScalar(0.5);
}

function lineOf([a, b]: [HandPose, HandPose]): Vector3 {
  return b.position.clone().sub(a.position);
}
