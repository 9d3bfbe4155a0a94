// SPDX-License-Identifier: Apache-2.0
import { Quaternion, Vector3 } from "three";
import type { Triple } from "./wire/messages.ts";
import type { WirePose } from "./wire/structs.ts";

/// Smaller turns count as none [rad].
const kSmallestTurn = 1e-12;

/// The pose at `share` (0 to 1) of the one screw motion from pose to pose, as src/dismantle/math/screw.h has it.
export function poseBetween(start: WirePose, end: WirePose, share: number): WirePose {
  if (share <= 0) return start;
  if (share >= 1) return end;
  const turn = quaternion(end).multiply(quaternion(start).conjugate());
  if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
  const sine = Math.hypot(turn.x, turn.y, turn.z);
  const angle = 2 * Math.atan2(sine, turn.w);
  const shift = new Vector3(...end.position).sub(new Vector3(...start.position));
  if (angle < kSmallestTurn) return { position: moved(start, shift.multiplyScalar(share)), rotation: start.rotation };

  const axis = new Vector3(turn.x, turn.y, turn.z).divideScalar(sine);
  const along = axis.clone().multiplyScalar(shift.dot(axis));
  const across = shift.sub(along);
  // The velocity across the axis that makes this shift: inverts sin(a)/a v + (1 - cos(a))/a axis x v.
  const velocity = across
    .clone()
    .multiplyScalar(turn.w / sine)
    .sub(axis.clone().cross(across))
    .multiplyScalar(angle / 2);
  const half = (share * angle) / 2;
  const way = velocity
    .clone()
    .multiplyScalar((2 * Math.sin(half) * Math.cos(half)) / angle)
    .addScaledVector(axis.clone().cross(velocity), (2 * Math.sin(half) ** 2) / angle)
    .addScaledVector(along, share);
  const now = new Quaternion()
    .setFromAxisAngle(axis, share * angle)
    .multiply(quaternion(start))
    .normalize();
  return { position: moved(start, way), rotation: [now.w, now.x, now.y, now.z] };
}

function moved({ position: [x, y, z] }: WirePose, by: Vector3): Triple {
  return [x + by.x, y + by.y, z + by.z];
}

function quaternion({ rotation: [w, x, y, z] }: WirePose): Quaternion {
  return new Quaternion(x, y, z, w);
}
