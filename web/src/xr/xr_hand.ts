// SPDX-License-Identifier: Apache-2.0
import {
  BufferGeometry,
  type Group,
  Line,
  LineBasicMaterial,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  Ray,
  SphereGeometry,
  Vector3,
  type WebXRManager,
  type XRTargetRaySpace,
} from "three";
import type { HandPose } from "./hand_motion.ts";

/// Length of a ray that hits nothing [m].
const kFreeRayLength = 3;

/// An input source of a headset, controller or bare hand: its pointing ray and its buttons.
export class XrHand {
  source: XRInputSource | null = null;
  /// Called when the trigger is pressed or released, and when the grip button is.
  onGrab: () => void = () => {};
  onRelease: () => void = () => {};
  onSqueeze: () => void = () => {};
  onSqueezeEnd: () => void = () => {};

  /// The poses of the pointing ray and of the hand itself.
  readonly aim: XRTargetRaySpace;
  readonly grip: Group;
  private readonly line: Line<BufferGeometry, LineBasicMaterial>;
  private readonly hitMarker: Mesh<SphereGeometry, MeshBasicMaterial>;

  /// @param index of the input source
  constructor(manager: WebXRManager, index: number, color: string) {
    this.aim = manager.getController(index);
    this.grip = manager.getControllerGrip(index);
    const ends = new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, -1)]);
    this.line = new Line(ends, new LineBasicMaterial({ color }));
    this.hitMarker = new Mesh(new SphereGeometry(0.006), new MeshBasicMaterial({ color, depthTest: false }));
    this.hitMarker.renderOrder = 12;
    this.aim.add(this.line, this.hitMarker);
    const body = new Mesh(new SphereGeometry(0.02), new MeshBasicMaterial({ color }));
    this.grip.add(body);
    this.aim.addEventListener("connected", ({ data }) => {
      this.source = data;
    });
    this.aim.addEventListener("disconnected", () => {
      this.source = null;
      this.onRelease();
      this.onSqueezeEnd();
    });
    this.aim.addEventListener("selectstart", () => this.onGrab());
    this.aim.addEventListener("selectend", () => this.onRelease());
    this.aim.addEventListener("squeezestart", () => this.onSqueeze());
    this.aim.addEventListener("squeezeend", () => this.onSqueezeEnd());
  }

  /// Pose in the room.
  get pose(): HandPose {
    const [position, orientation] = [new Vector3(), new Quaternion()];
    this.aim.matrixWorld.decompose(position, orientation, new Vector3());
    return { position, orientation };
  }

  /// Pointing ray in the room.
  get ray(): Ray {
    const { position, orientation } = this.pose;
    return new Ray(position, new Vector3(0, 0, -1).applyQuaternion(orientation));
  }

  /// @param distance to the hit point [m]; null: nothing is hit
  showRay(distance: number | null): void {
    this.line.scale.setZ(distance ?? kFreeRayLength);
    this.hitMarker.visible = distance !== null;
    this.hitMarker.position.set(0, 0, -(distance ?? 0));
  }

  /// A short haptic pulse.
  pulse(): void {
    const [actuator] = this.source?.gamepad?.hapticActuators ?? [];
    void (actuator as unknown as { pulse?(value: number, duration: number): Promise<boolean> })?.pulse?.(0.5, 30);
  }

  /// The pointing ray in a frame given by its transform to the room.
  rayIn(roomFrom: Matrix4): Ray {
    return this.ray.applyMatrix4(new Matrix4().copy(roomFrom).invert());
  }

  dispose(): void {
    this.aim.clear();
    this.grip.clear();
    this.line.geometry.dispose();
    this.hitMarker.geometry.dispose();
  }
}
