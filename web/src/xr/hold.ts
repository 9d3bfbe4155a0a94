// SPDX-License-Identifier: Apache-2.0
import { Matrix4, type Vector3 } from "three";
import { setMatrixFromPose } from "../scene/model_view.ts";
import type { WirePose } from "../wire/structs.ts";
import { type HandPose, motionOfHand, motionOfHands } from "./hand_motion.ts";

/// A turn of one radian stirs as much as a way of so much [m].
const kTurnAsFar = 0.1;

/// Whoever holds: where it is in the room.
interface Holder {
  readonly pose: HandPose;
}

/// A set of components that one hand or both hold, and what they have made of it since it was taken, or since it rested.
export class Hold<Hand extends Holder> {
  private grips: { hand: Hand; from: HandPose }[] = [];
  private made = new Matrix4();
  /// Where it was taken, of the assembled component.
  private readonly taken: Vector3;

  /// @param point where it is taken, in the world, while it has this pose
  constructor(
    readonly components: number[],
    point: Vector3,
    pose: WirePose | null,
  ) {
    this.taken = point.clone().applyMatrix4(setMatrixFromPose(new Matrix4(), pose).invert());
  }

  get hands(): Hand[] {
    return this.grips.map(({ hand }) => hand);
  }

  /// Where it was taken, in the world, where it has a pose.
  point(pose: WirePose | null): Vector3 {
    return this.taken.clone().applyMatrix4(setMatrixFromPose(new Matrix4(), pose));
  }

  /// From here on these hands hold it: the motion goes on from what it is by now.
  regrip(hands: Hand[], roomFromWorld: Matrix4): void {
    if (this.grips.length > 0) this.made = this.motion(roomFromWorld);
    this.grips = hands.map((hand) => ({ hand, from: hand.pose }));
  }

  /// What the hands have made of it by now, in the world [mm].
  motion(roomFromWorld: Matrix4): Matrix4 {
    const [a, b] = this.grips;
    const inRoom = b ? motionOfHands([a.from, b.from], [a.hand.pose, b.hand.pose]) : motionOfHand(a.from, a.hand.pose);
    const worldFromRoom = roomFromWorld.clone().invert();
    return worldFromRoom.multiply(inRoom).multiply(roomFromWorld).multiply(this.made);
  }

  /// It stays where it is until the hands move on from where they are.
  rest(): void {
    this.made.identity();
    this.grips = this.hands.map((hand) => ({ hand, from: hand.pose }));
  }

  /// How far the hands have gone since they took it, or since it rested [m].
  get stirred(): number {
    const ways = this.grips.map(
      ({ hand, from }) =>
        hand.pose.position.distanceTo(from.position) + kTurnAsFar * hand.pose.orientation.angleTo(from.orientation),
    );
    return Math.max(0, ...ways);
  }
}
