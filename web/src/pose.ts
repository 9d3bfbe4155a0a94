// SPDX-License-Identifier: Apache-2.0
import { Matrix4, Quaternion, Vector3 } from "three";
import type { WirePose } from "./wire/structs.ts";

/// The pose of a component in its assembled position.
export const kIdentityPose: WirePose = { position: [0, 0, 0], rotation: [1, 0, 0, 0] };

/// The rotation of a pose as a quaternion of three.js.
export function rotationOf({ rotation: [w, x, y, z] }: WirePose): Quaternion {
  return new Quaternion(x, y, z, w);
}

/// The rigid transform of a pose; null: assembled.
export function matrixOf(pose: WirePose | null): Matrix4 {
  if (!pose) return new Matrix4();
  return new Matrix4().compose(new Vector3(...pose.position), rotationOf(pose), new Vector3(1, 1, 1));
}
