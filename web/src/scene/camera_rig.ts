// SPDX-License-Identifier: Apache-2.0
import {
  type Box3,
  MathUtils,
  Matrix4,
  OrthographicCamera,
  PerspectiveCamera,
  Quaternion,
  Ray,
  Vector2,
  Vector3,
} from "three";

/// A camera position.
export interface View {
  focus: Vector3;
  orientation: Quaternion;
  /// Distance from the focus to the eye [mm].
  distance: number;
}

const kFieldOfView = MathUtils.degToRad(30);
/// Room around what is fitted.
const kFitMargin = 1.06;
const kOrbitSpeed = 0.0075;
const kFlightTime = 220;
/// Angle that counts as a pixel in a headset [rad].
const kEyePixel = 0.0012;
const kUp = new Vector3(0, 0, 1);
/// Direction (towards the eye) from which a model is shown first.
export const kHomeDirection = new Vector3(1, -1.6, 0.9);

/// The camera and its turntable controls, z up. Positions on screen are CSS pixels from the canvas's upper left corner.
export class CameraRig {
  /// Called when the view has changed.
  onChange: () => void = () => {};
  /// True to jump between views without animation.
  instant = false;
  /// Size of the view [px].
  readonly size = new Vector2(1, 1);
  /// Eye position of a headset in the world frame, in place of the camera's; null: none.
  eye: Vector3 | null = null;

  private view: View = { focus: new Vector3(), orientation: orientationFrom(kHomeDirection), distance: 500 };
  readonly perspective = new PerspectiveCamera(MathUtils.radToDeg(kFieldOfView));
  private readonly parallel = new OrthographicCamera();
  private isParallel = false;
  private readonly scene = { center: new Vector3(), radius: 100 };
  private flight: { from: View; to: View; start: number } | null = null;

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.isParallel ? this.parallel : this.perspective;
  }

  get orthographic(): boolean {
    return this.isParallel;
  }

  set orthographic(value: boolean) {
    this.isParallel = value;
    this.update();
  }

  /// True during an animation between views.
  get flying(): boolean {
    return this.flight !== null;
  }

  /// The current view.
  get current(): View {
    return {
      focus: this.view.focus.clone(),
      orientation: this.view.orientation.clone(),
      distance: this.view.distance,
    };
  }

  /// A unit axis of the screen, world frame.
  axis(which: "right" | "up" | "back"): Vector3 {
    const local = { right: new Vector3(1, 0, 0), up: new Vector3(0, 1, 0), back: new Vector3(0, 0, 1) }[which];
    return local.applyQuaternion(this.view.orientation);
  }

  resize(width: number, height: number): void {
    this.size.set(Math.max(1, width), Math.max(1, height));
    this.update();
  }

  /// Sets the box that the near and far planes must enclose.
  setSceneBounds(box: Box3): void {
    box.getCenter(this.scene.center);
    this.scene.radius = Math.max(1e-3, box.getSize(new Vector3()).length() / 2);
    this.update();
  }

  /// Orbits about `pivot` by a pointer motion [px].
  orbit(dx: number, dy: number, pivot: Vector3): void {
    const back = this.axis("back");
    const pitch = Math.asin(MathUtils.clamp(back.z, -1, 1));
    const limit = Math.PI / 2 - 1e-3;
    const tilt = MathUtils.clamp(pitch + dy * kOrbitSpeed, -limit, limit) - pitch;
    const turn = new Quaternion()
      .setFromAxisAngle(kUp, -dx * kOrbitSpeed)
      .multiply(new Quaternion().setFromAxisAngle(this.axis("right"), -tilt));
    this.view.orientation.premultiply(turn).normalize();
    this.view.focus.sub(pivot).applyQuaternion(turn).add(pivot);
    this.endFlight();
  }

  /// Pans so that `grabbed` follows the pointer.
  pan(dx: number, dy: number, grabbed: Vector3): void {
    const scale = this.pixelSize(grabbed);
    this.view.focus.addScaledVector(this.axis("right"), -dx * scale).addScaledVector(this.axis("up"), dy * scale);
    this.endFlight();
  }

  /// Zooms so that `fixed` keeps its position on screen.
  zoom(factor: number, fixed: Vector3): void {
    const distance = MathUtils.clamp(this.view.distance * factor, this.scene.radius * 1e-4, this.scene.radius * 40);
    this.view.focus
      .sub(fixed)
      .multiplyScalar(distance / this.view.distance)
      .add(fixed);
    this.view.distance = distance;
    this.endFlight();
  }

  /// Shows a whole box, from the current direction or from `direction` (towards the eye).
  fit(box: Box3, direction?: Vector3): void {
    if (box.isEmpty()) return;
    const focus = box.getCenter(new Vector3());
    const orientation = direction ? orientationFrom(direction) : this.view.orientation.clone();
    const inverse = orientation.clone().invert();
    const vertical = Math.tan(kFieldOfView / 2);
    const horizontal = vertical * (this.size.x / this.size.y);
    const distances = cornersOf(box).map((corner) => {
      const { x, y, z } = corner.sub(focus).applyQuaternion(inverse);
      return Math.max(Math.abs(x) / horizontal, Math.abs(y) / vertical) + (this.isParallel ? 0 : z);
    });
    this.fly({ focus, orientation, distance: kFitMargin * Math.max(1e-3, ...distances) });
  }

  /// True if a box is completely in the picture.
  shows(box: Box3): boolean {
    return cornersOf(box).every((corner) => {
      const { x, y, z } = this.project(corner);
      return x >= 0 && y >= 0 && x <= this.size.x && y <= this.size.y && z < 1;
    });
  }

  /// Looks from `direction` (towards the eye) at the current focus.
  lookFrom(direction: Vector3): void {
    this.fly({ ...this.current, orientation: orientationFrom(direction) });
  }

  /// Animates to another view.
  fly(to: View): void {
    this.flight = this.instant ? null : { from: this.current, to, start: performance.now() };
    if (this.instant) this.view = to;
    this.update();
  }

  /// Advances the animation between views. Call once a frame.
  advance(now: number): void {
    if (!this.flight) return;
    const { from, to, start } = this.flight;
    const part = MathUtils.clamp((now - start) / kFlightTime, 0, 1);
    const eased = part * part * (3 - 2 * part);
    this.view.focus.lerpVectors(from.focus, to.focus, eased);
    this.view.orientation.slerpQuaternions(from.orientation, to.orientation, eased);
    this.view.distance = from.distance * (to.distance / from.distance) ** eased;
    if (part === 1) this.flight = null;
    this.update();
  }

  /// The ray through a position on screen, world frame.
  ray(x: number, y: number): Ray {
    const ndc = this.ndcFromScreen(x, y);
    const near = new Vector3(ndc.x, ndc.y, -1).unproject(this.camera);
    const far = new Vector3(ndc.x, ndc.y, 1).unproject(this.camera);
    return new Ray(near, far.sub(near).normalize());
  }

  /// Position of a point on screen; z is below 1 in front of the far plane.
  project(point: Vector3): Vector3 {
    const ndc = point.clone().project(this.camera);
    return new Vector3((0.5 + 0.5 * ndc.x) * this.size.x, (0.5 - 0.5 * ndc.y) * this.size.y, ndc.z);
  }

  /// Size of a pixel at a point [mm].
  pixelSize(point: Vector3): number {
    if (this.eye) return Math.max(1e-6, this.eye.distanceTo(point)) * kEyePixel;
    const depth = this.isParallel ? this.view.distance : this.axis("back").dot(this.camera.position.clone().sub(point));
    return (2 * Math.max(depth, 1e-6) * Math.tan(kFieldOfView / 2)) / this.size.y;
  }

  /// Normalized device coordinates of a position on screen.
  ndcFromScreen(x: number, y: number): Vector2 {
    return new Vector2((2 * x) / this.size.x - 1, 1 - (2 * y) / this.size.y);
  }

  private endFlight(): void {
    this.flight = null;
    this.update();
  }

  private update(): void {
    const { focus, orientation, distance } = this.view;
    const aspect = this.size.x / this.size.y;
    for (const camera of [this.perspective, this.parallel]) {
      camera.quaternion.copy(orientation);
      camera.position.copy(focus).addScaledVector(this.axis("back"), distance);
    }
    const depth = this.axis("back").dot(this.perspective.position.clone().sub(this.scene.center));
    const far = Math.max(depth + 1.6 * this.scene.radius, distance * 2);
    this.perspective.aspect = aspect;
    this.perspective.far = far;
    this.perspective.near = Math.max(depth - 1.6 * this.scene.radius, Math.min(distance * 0.02, far * 1e-3));
    const half = distance * Math.tan(kFieldOfView / 2);
    this.parallel.left = -half * aspect;
    this.parallel.right = half * aspect;
    this.parallel.top = half;
    this.parallel.bottom = -half;
    this.parallel.near = depth - 1.6 * this.scene.radius;
    this.parallel.far = far;
    for (const camera of [this.perspective, this.parallel]) {
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld(true);
    }
    this.onChange();
  }
}

function cornersOf({ min, max }: Box3): Vector3[] {
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (k) => new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z),
  );
}

/// Orientation of a camera that looks from `direction`. z is up on screen; y, if it looks along z.
export function orientationFrom(direction: Vector3): Quaternion {
  const back = direction.clone().normalize();
  const up = Math.abs(back.z) > 0.999 ? new Vector3(0, Math.sign(back.z), 0) : kUp;
  return new Quaternion().setFromRotationMatrix(new Matrix4().lookAt(back, new Vector3(), up));
}
