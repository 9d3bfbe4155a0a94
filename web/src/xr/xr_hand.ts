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

/// A ray that meets nothing is drawn so long [m].
const kFreeRay = 3;

/// One of the two input sources of a headset, controller or bare hand: where it points, and what it presses.
export class XrHand {
  source: XRInputSource | null = null;
  onGrab: () => void = () => {};
  onLetGo: () => void = () => {};
  onPull: () => void = () => {};
  onStopPulling: () => void = () => {};

  readonly aim: XRTargetRaySpace;
  readonly grip: Group;
  private readonly line: Line<BufferGeometry, LineBasicMaterial>;
  private readonly spot: Mesh<SphereGeometry, MeshBasicMaterial>;

  /// @param index of the input source
  constructor(manager: WebXRManager, index: number, color: string) {
    this.aim = manager.getController(index);
    this.grip = manager.getControllerGrip(index);
    const ends = new BufferGeometry().setFromPoints([new Vector3(), new Vector3(0, 0, -1)]);
    this.line = new Line(ends, new LineBasicMaterial({ color }));
    this.spot = new Mesh(new SphereGeometry(0.006), new MeshBasicMaterial({ color, depthTest: false }));
    this.spot.renderOrder = 12;
    this.aim.add(this.line, this.spot);
    const body = new Mesh(new SphereGeometry(0.02), new MeshBasicMaterial({ color }));
    this.grip.add(body);
    this.aim.addEventListener("connected", ({ data }) => {
      this.source = data;
    });
    this.aim.addEventListener("disconnected", () => {
      this.source = null;
      this.onLetGo();
      this.onStopPulling();
    });
    this.aim.addEventListener("selectstart", () => this.onGrab());
    this.aim.addEventListener("selectend", () => this.onLetGo());
    this.aim.addEventListener("squeezestart", () => this.onPull());
    this.aim.addEventListener("squeezeend", () => this.onStopPulling());
  }

  /// In the room.
  get pose(): HandPose {
    const [position, orientation] = [new Vector3(), new Quaternion()];
    this.aim.matrixWorld.decompose(position, orientation, new Vector3());
    return { position, orientation };
  }

  /// In the room, where the hand points.
  get ray(): Ray {
    const { position, orientation } = this.pose;
    return new Ray(position, new Vector3(0, 0, -1).applyQuaternion(orientation));
  }

  /// @param distance to what the ray meets [m]; null: nothing
  showRay(distance: number | null): void {
    this.line.scale.setZ(distance ?? kFreeRay);
    this.spot.visible = distance !== null;
    this.spot.position.set(0, 0, -(distance ?? 0));
  }

  /// A short tap that is felt.
  tap(): void {
    const [actuator] = this.source?.gamepad?.hapticActuators ?? [];
    void (actuator as unknown as { pulse?(value: number, duration: number): Promise<boolean> })?.pulse?.(0.5, 30);
  }

  /// The ray of the room as one of what `roomFrom` brings there.
  rayIn(roomFrom: Matrix4): Ray {
    return this.ray.applyMatrix4(new Matrix4().copy(roomFrom).invert());
  }

  dispose(): void {
    this.aim.clear();
    this.grip.clear();
    this.line.geometry.dispose();
    this.spot.geometry.dispose();
  }
}
