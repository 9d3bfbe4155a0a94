// SPDX-License-Identifier: Apache-2.0
import { Quaternion, Vector3 } from "three";
import { rotationOf } from "./pose.ts";
import type { Triple } from "./wire/messages.ts";
import type { WirePose } from "./wire/structs.ts";

/// Smaller rotations are ignored [rad].
const kMinAngle = 1e-12;

/// The pose at a fraction (0 to 1) of the screw motion between two poses; the same as in src/dismantle/math/screw.h.
export function poseBetween(start: WirePose, end: WirePose, fraction: number): WirePose {
  if (fraction <= 0) return start;
  if (fraction >= 1) return end;
  const turn = rotationOf(end).multiply(rotationOf(start).conjugate());
  if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
  const sine = Math.hypot(turn.x, turn.y, turn.z);
  const angle = 2 * Math.atan2(sine, turn.w);
  const shift = new Vector3(...end.position).sub(new Vector3(...start.position));
  if (angle < kMinAngle) return { position: moved(start, shift.multiplyScalar(fraction)), rotation: start.rotation };

  const axis = new Vector3(turn.x, turn.y, turn.z).divideScalar(sine);
  const along = axis.clone().multiplyScalar(shift.dot(axis));
  const across = shift.sub(along);
  // Velocity across the axis with this displacement: inverts sin(a)/a v + (1 - cos(a))/a axis x v.
  const velocity = across
    .clone()
    .multiplyScalar(turn.w / sine)
    .sub(axis.clone().cross(across))
    .multiplyScalar(angle / 2);
  const half = (fraction * angle) / 2;
  const displacement = velocity
    .clone()
    .multiplyScalar((2 * Math.sin(half) * Math.cos(half)) / angle)
    .addScaledVector(axis.clone().cross(velocity), (2 * Math.sin(half) ** 2) / angle)
    .addScaledVector(along, fraction);
  const now = new Quaternion()
    .setFromAxisAngle(axis, fraction * angle)
    .multiply(rotationOf(start))
    .normalize();
  return { position: moved(start, displacement), rotation: [now.w, now.x, now.y, now.z] };
}

function moved({ position: [x, y, z] }: WirePose, by: Vector3): Triple {
  return [x + by.x, y + by.y, z + by.z];
}
