// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Quaternion, Vector3 } from "three";

/// Pose of a hand in the room: metres, y up.
export interface HandPose {
  position: Vector3;
  orientation: Quaternion;
}

/// The rigid motion of one hand between two poses.
export function motionOfHand(before: HandPose, after: HandPose): Matrix4 {
  const turn = after.orientation.clone().multiply(before.orientation.clone().invert());
  return rigidMotion(turn, before.position, after.position);
}

/// The rigid motion of an object held by both hands: its centre follows the midpoint of the hands, its direction the
/// line between them.
export function motionOfHands(before: [HandPose, HandPose], after: [HandPose, HandPose]): Matrix4 {
  const turn = new Quaternion().setFromUnitVectors(lineOf(before).normalize(), lineOf(after).normalize());
  return rigidMotion(turn, middleOf(before), middleOf(after));
}

/// The motion of a room pulled by both hands: its centre follows theirs and its scale their distance. It rotates about
/// the vertical only, to prevent motion sickness.
export function roomMotionOfHands(before: [HandPose, HandPose], after: [HandPose, HandPose]): Matrix4 {
  const [a, b] = [lineOf(before), lineOf(after)];
  const scale = b.length() / Math.max(1e-6, a.length());
  const angle = Math.atan2(-b.z, b.x) - Math.atan2(-a.z, a.x);
  const turn = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), angle);
  const about = middleOf(before).multiplyScalar(-scale).applyQuaternion(turn).add(middleOf(after));
  return new Matrix4().compose(about, turn, new Vector3(scale, scale, scale));
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
