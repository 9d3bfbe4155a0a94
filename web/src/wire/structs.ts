// SPDX-License-Identifier: Apache-2.0
// The binary messages of docs/wire.md.

import type { Triple } from "./messages.ts";

/// A rigid motion from the assembled position; the rotation is the quaternion w, x, y, z.
export interface WirePose {
  position: Triple;
  rotation: [number, number, number, number];
}

/// A contact between the moving set and a fixed component.
export interface WireContact {
  moving: number;
  fixed: number;
  faceMoving: number;
  faceFixed: number;
  /// Gap along the normal [mm]; negative if the faces overlap.
  gap: number;
  point: Triple;
  normal: Triple;
}

/// Pose of the moving set.
export interface PoseFrame extends WirePose {
  reached: boolean;
  blocked: boolean;
  playback: boolean;
  automatic: boolean;
  state: number;
  grip: number;
  number: number;
  time: number;
  /// Lower bound of the distance to all other components [mm], or NaN.
  clearance: number;
  /// Duration of the engine's step [us].
  stepTime: number;
  stepsPerSecond: number;
  contacts: WireContact[];
}

const kTarget = 1;
const kRate = 2;
const kPose = 16;
const kPoseBytes = 96;
const kContactBytes = 48;

/// Encodes a target pose; `number` counts the messages of a grip.
export function targetMessage(grip: number, number: number, pose: WirePose): ArrayBuffer {
  return numbersMessage(kTarget, grip, number, [...pose.position, ...pose.rotation]);
}

/// Encodes a target velocity.
/// @param linear velocity of the set's centre [mm/s]; @param angular velocity [rad/s]; both along world axes
export function rateMessage(grip: number, number: number, linear: Triple, angular: Triple): ArrayBuffer {
  return numbersMessage(kRate, grip, number, [...linear, ...angular]);
}

function numbersMessage(kind: number, grip: number, number: number, values: number[]): ArrayBuffer {
  const bytes = new ArrayBuffer(16 + 8 * values.length);
  const view = new DataView(bytes);
  view.setUint8(0, kind);
  view.setUint32(4, grip, true);
  view.setUint32(8, number, true);
  values.forEach((value, i) => {
    view.setFloat64(16 + 8 * i, value, true);
  });
  return bytes;
}

/// Decodes a pose frame; null if the message is none.
export function readPoseFrame(bytes: ArrayBuffer): PoseFrame | null {
  const view = new DataView(bytes);
  if (bytes.byteLength < kPoseBytes || view.getUint8(0) !== kPose) return null;
  const count = view.getUint16(2, true);
  if (bytes.byteLength !== kPoseBytes + count * kContactBytes) return null;
  const flags = view.getUint8(1);
  const double = (offset: number) => view.getFloat64(offset, true);
  return {
    reached: (flags & 1) !== 0,
    blocked: (flags & 2) !== 0,
    playback: (flags & 4) !== 0,
    automatic: (flags & 8) !== 0,
    state: view.getUint32(4, true),
    grip: view.getUint32(8, true),
    number: view.getUint32(12, true),
    time: double(16),
    position: [double(24), double(32), double(40)],
    rotation: [double(48), double(56), double(64), double(72)],
    clearance: double(80),
    stepTime: view.getFloat32(88, true),
    stepsPerSecond: view.getFloat32(92, true),
    contacts: Array.from({ length: count }, (_, i) => readContact(view, kPoseBytes + i * kContactBytes)),
  };
}

function readContact(view: DataView, begin: number): WireContact {
  const triple = (offset: number): Triple => [
    view.getFloat32(offset, true),
    view.getFloat32(offset + 4, true),
    view.getFloat32(offset + 8, true),
  ];
  return {
    moving: view.getUint32(begin, true),
    fixed: view.getUint32(begin + 4, true),
    faceMoving: view.getUint32(begin + 8, true),
    faceFixed: view.getUint32(begin + 12, true),
    gap: view.getFloat32(begin + 16, true),
    point: triple(begin + 24),
    normal: triple(begin + 36),
  };
}
