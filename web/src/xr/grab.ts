// SPDX-License-Identifier: Apache-2.0
import { Matrix4, type Vector3 } from "three";
import { matrixOf } from "../pose.ts";
import type { WirePose } from "../wire/structs.ts";
import { type HandPose, motionOfHand, motionOfHands } from "./hand_motion.ts";

/// A rotation by one radian counts as this much travel [m].
const kMetresPerRadian = 0.1;

/// A hand, located in the room.
interface GrabbingHand {
  readonly pose: HandPose;
}

/// A set of components grabbed by one or both hands, and the motion that the hands have given it since it was grabbed,
/// or since it was rebased.
export class Grab<Hand extends GrabbingHand> {
  private anchors: { hand: Hand; from: HandPose }[] = [];
  private completed = new Matrix4();
  /// The grabbed point in the assembled component's frame.
  private readonly grabbedPoint: Vector3;

  /// @param point grabbed, world frame, while the component has this pose
  constructor(
    readonly components: number[],
    point: Vector3,
    pose: WirePose | null,
  ) {
    this.grabbedPoint = point.clone().applyMatrix4(matrixOf(pose).invert());
  }

  get hands(): Hand[] {
    return this.anchors.map(({ hand }) => hand);
  }

  /// The grabbed point, world frame, at a pose of the component.
  point(pose: WirePose | null): Vector3 {
    return this.grabbedPoint.clone().applyMatrix4(matrixOf(pose));
  }

  /// Changes the hands that hold the set; its motion continues from the current one.
  regrip(hands: Hand[], roomFromWorld: Matrix4): void {
    if (this.anchors.length > 0) this.completed = this.motion(roomFromWorld);
    this.anchors = hands.map((hand) => ({ hand, from: hand.pose }));
  }

  /// The motion given by the hands, world frame [mm].
  motion(roomFromWorld: Matrix4): Matrix4 {
    const [a, b] = this.anchors;
    const inRoom = b ? motionOfHands([a.from, b.from], [a.hand.pose, b.hand.pose]) : motionOfHand(a.from, a.hand.pose);
    const worldFromRoom = roomFromWorld.clone().invert();
    return worldFromRoom.multiply(inRoom).multiply(roomFromWorld).multiply(this.completed);
  }

  /// Restarts the motion at the hands' current poses.
  rebase(): void {
    this.completed.identity();
    this.anchors = this.hands.map((hand) => ({ hand, from: hand.pose }));
  }

  /// Travel of the hands since the set was grabbed or rebased [m].
  get travel(): number {
    const distances = this.anchors.map(
      ({ hand, from }) =>
        hand.pose.position.distanceTo(from.position) +
        kMetresPerRadian * hand.pose.orientation.angleTo(from.orientation),
    );
    return Math.max(0, ...distances);
  }
}
