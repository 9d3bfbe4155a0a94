// SPDX-License-Identifier: Apache-2.0
import { Box3, Group, Matrix4, PerspectiveCamera, Scene, Vector3 } from "three";
import type { Drag } from "../input/drag.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { Grab } from "./grab.ts";
import { type HandPose, roomMotionOfHands } from "./hand_motion.ts";
import { type WristButton, WristPanel } from "./wrist_panel.ts";
import { XrHand } from "./xr_hand.ts";

/// Initial placement of the assembly: length of its longest side, and distance ahead of and below the eyes [m].
const kSide = 0.5;
const kAhead = 0.6;
const kBelow = 0.25;
/// The engine moves one set at a time. If each hand holds a set, the engine switches to the other one when its hand has
/// moved this far [m] and the active one has had this much time [ms].
const kSwitchDistance = 0.01;
const kMinActiveTime = 150;
const kHandColors = ["#56b4e9", "#e69f00"];
/// Rotates z up (world) to y up (room).
const kUpright = new Matrix4().makeRotationX(-Math.PI / 2);

type Grabbed = { hand: XrHand; from: HandPose };

/// The page's actions that the wrist panel offers.
export type HeadsetActions = Record<"undo" | "redo" | "takeOut" | "putBack" | "findPath", () => void>;

/// True if this browser can show the scene in a headset.
export async function hasHeadset(): Promise<boolean> {
  return (await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false)) ?? false;
}

/// An immersive session: the scene stands in a room (metres) in which the head and two hands move. Hands grab
/// components as the pointer does: they send targets, and the engine returns poses.
export class Headset {
  private readonly room = new Scene();
  /// Placement of the scene in the room.
  readonly stage = new Group();
  private readonly camera = new PerspectiveCamera();
  readonly panel = new WristPanel();
  hands: XrHand[] = [];
  private xr: XRSession | null = null;
  private placed = false;
  /// The grabbed sets, at most one for each hand, and the one that the engine moves now.
  private grabs: Grab<XrHand>[] = [];
  private activeGrab: Grab<XrHand> | null = null;
  private activeSince = 0;
  private switching = false;
  private squeezes: Grabbed[] = [];
  private stageBefore = new Matrix4();
  private wasBlocked = false;

  constructor(
    private readonly session: Session,
    private readonly drag: Drag,
    private readonly actions: HeadsetActions,
  ) {
    this.camera.near = 0.02;
    this.camera.far = 100;
    this.stage.matrixAutoUpdate = false;
    this.room.add(this.stage);
  }

  get active(): boolean {
    return this.xr !== null;
  }

  /// Starts or ends the session. Browsers allow this only in response to a click.
  async enter(): Promise<void> {
    if (this.xr) return void this.xr.end();
    const { viewport } = this.session;
    try {
      this.xr = await navigator.xr!.requestSession("immersive-vr", {
        requiredFeatures: ["local-floor"],
        optionalFeatures: ["hand-tracking"],
      });
    } catch (error) {
      return this.session.onNote("warning", text("headset.refused", { reason: (error as Error).message }));
    }
    this.xr.addEventListener("end", () => this.leave());
    this.placed = false;
    this.stage.add(viewport.scene);
    const manager = await viewport.enterImmersive(this.xr, this.room, this.camera, () => this.updateFrame());
    this.hands = kHandColors.map((color, i) => new XrHand(manager, i, color));
    for (const hand of this.hands) this.connect(hand);
    this.session.notifier.notify();
  }

  private leave(): void {
    const { viewport } = this.session;
    if (this.drag.active) void this.drag.end();
    [this.xr, this.grabs, this.activeGrab, this.squeezes] = [null, [], null, []];
    for (const hand of this.hands) hand.dispose();
    this.room.remove(...this.hands.flatMap(({ aim, grip }) => [aim, grip]));
    this.stage.remove(viewport.scene);
    viewport.leaveImmersive();
    this.session.notifier.notify();
  }

  private connect(hand: XrHand): void {
    this.room.add(hand.aim, hand.grip);
    hand.onGrab = () => this.grab(hand);
    hand.onRelease = () => this.release(hand);
    const others = () => this.squeezes.map((squeeze) => squeeze.hand).filter((other) => other !== hand);
    hand.onSqueeze = () => this.squeeze([...others(), hand]);
    hand.onSqueezeEnd = () => this.squeeze(others());
  }

  /// The component that a hand points at: distance along its ray [m], and the point in the world frame.
  private aimedAt(hand: XrHand): { distance: number; component: number; point: Vector3 } | null {
    const pick = this.session.viewport.castWorld(hand.rayIn(this.stage.matrix));
    if (!pick) return null;
    const there = pick.point.clone().applyMatrix4(this.stage.matrix);
    return { distance: there.distanceTo(hand.pose.position), component: pick.component, point: pick.point };
  }

  private panelHit(hand: XrHand): { distance: number; button: WristButton | null } | null {
    if (hand.grip === this.panel.object.parent) return null;
    return this.panel.intersect(hand.ray);
  }

  private grab(hand: XrHand): void {
    const hit = this.panelHit(hand);
    if (hit) return hit.button?.enabled ? hit.button.press() : undefined;
    const aimedAt = this.aimedAt(hand);
    if (!aimedAt || !this.drag.allowed) return this.session.select([]);
    const { store } = this.session;
    const existing = this.grabs.find(({ components }) => components.includes(aimedAt.component));
    if (existing) return existing.regrip([...existing.hands, hand], this.stage.matrix);
    if (this.drag.active && this.grabs.length === 0) return hand.pulse();
    const isFirst = this.grabs.length === 0;
    if (isFirst && !store.selection.includes(aimedAt.component)) this.session.select([aimedAt.component]);
    const components = isFirst ? [...store.selection] : [aimedAt.component];
    const grab = new Grab<XrHand>(components, aimedAt.point, this.session.poseOf(components[0]));
    grab.regrip([hand], this.stage.matrix);
    this.grabs.push(grab);
    if (isFirst) void this.switchTo(grab);
  }

  private release(hand: XrHand): void {
    const grab = this.grabs.find(({ hands }) => hands.includes(hand));
    if (!grab) return;
    const others = grab.hands.filter((other) => other !== hand);
    if (others.length > 0) return grab.regrip(others, this.stage.matrix);
    this.grabs = this.grabs.filter((other) => other !== grab);
    if (grab === this.activeGrab) void this.switchTo(this.grabs[0] ?? null);
  }

  /// Makes the engine move another grabbed set. If that is refused, or it was released meanwhile, continues with the
  /// next one.
  private async switchTo(next: Grab<XrHand> | null): Promise<void> {
    if (this.switching) return;
    this.switching = true;
    this.activeGrab?.rebase();
    if (this.drag.active) await this.drag.end();
    this.activeGrab = next;
    if (next && !(await this.begin(next))) this.grabs = this.grabs.filter((grab) => grab !== next);
    this.activeSince = performance.now();
    this.switching = false;
    if (this.activeGrab && !this.grabs.includes(this.activeGrab)) await this.switchTo(this.grabs[0] ?? null);
  }

  private begin(grab: Grab<XrHand>): Promise<boolean> {
    this.session.select(grab.components);
    return this.drag.begin(grab.components, grab.point(this.session.poseOf(grab.components[0])));
  }

  private squeeze(hands: XrHand[]): void {
    this.squeezes = hands.map((hand) => ({ hand, from: hand.pose }));
    this.stageBefore.copy(this.stage.matrix);
  }

  private updateFrame(): void {
    this.room.updateMatrixWorld();
    const eye = new Vector3().setFromMatrixPosition(this.camera.matrixWorld);
    if (!this.placed && eye.lengthSq() > 0) this.place(eye);
    this.followHands();
    this.moveRoom();
    this.session.viewport.setEye(eye.applyMatrix4(this.stage.matrix.clone().invert()), this.stage.matrix);
    this.updateRays();
    this.updatePanel();
    this.pulseOnContact();
  }

  private followHands(): void {
    if (this.switching || !this.activeGrab) return;
    this.drag.follow(this.activeGrab.motion(this.stage.matrix));
    const other = this.grabs.find((grab) => grab !== this.activeGrab);
    if (other && other.travel > kSwitchDistance && performance.now() - this.activeSince > kMinActiveTime)
      void this.switchTo(other);
  }

  private place(eye: Vector3): void {
    const bounds = this.session.viewport.model?.bounds() ?? new Box3();
    if (bounds.isEmpty()) return;
    this.placed = true;
    const size = bounds.getSize(new Vector3());
    const scale = kSide / Math.max(size.x, size.y, size.z, 1e-3);
    const ahead = new Vector3(0, 0, -1).transformDirection(this.camera.matrixWorld).setY(0).normalize();
    const at = eye
      .clone()
      .addScaledVector(ahead, kAhead)
      .setY(eye.y - kBelow);
    const facing = new Matrix4().makeRotationY(Math.atan2(-ahead.x, -ahead.z));
    this.stage.matrix
      .makeTranslation(at)
      .multiply(facing)
      .multiply(kUpright)
      .multiply(new Matrix4().makeScale(scale, scale, scale))
      .multiply(new Matrix4().makeTranslation(bounds.getCenter(new Vector3()).negate()));
    this.stage.matrixWorldNeedsUpdate = true;
  }

  private moveRoom(): void {
    const [a, b] = this.squeezes;
    if (!a) return;
    const motion = b
      ? roomMotionOfHands([a.from, b.from], [a.hand.pose, b.hand.pose])
      : new Matrix4().makeTranslation(a.hand.pose.position.sub(a.from.position));
    this.stage.matrix.multiplyMatrices(motion, this.stageBefore);
    this.stage.matrixWorldNeedsUpdate = true;
  }

  private updateRays(): void {
    let [hovered, button]: [number | null, WristButton | null] = [null, null];
    for (const hand of this.hands) {
      if (!hand.source) continue;
      const hit = this.panelHit(hand);
      const aimedAt = hit ? null : this.aimedAt(hand);
      hand.showRay(hit?.distance ?? aimedAt?.distance ?? null);
      hovered ??= aimedAt?.component ?? null;
      button ??= hit?.button ?? null;
    }
    this.session.hover(hovered);
    this.panel.hover(button);
  }

  /// Updates the panel on the wrist of the left hand, or of the only one.
  private updatePanel(): void {
    const { store } = this.session;
    const wearer = this.hands.find(({ source }) => source?.handedness === "left") ?? this.hands.find((h) => h.source);
    if (wearer && this.panel.object.parent !== wearer.grip) wearer.grip.add(this.panel.object);
    const { state } = store;
    const idle = store.control && this.session.idle;
    const some = store.selection.length > 0;
    const subject = store.selection[0] ?? store.hovered;
    const by = [...store.blocking][0];
    this.panel.show({
      lines: [
        subject === null || subject === undefined ? text("headset.empty") : this.session.nameOf(subject),
        by === undefined ? text("headset.hint") : text("stuck", { name: this.session.nameOf(by) }),
      ],
      buttons: [
        { id: "undo", label: text("undo"), enabled: idle && state?.undo != null, press: this.actions.undo },
        { id: "redo", label: text("redo"), enabled: idle && state?.redo != null, press: this.actions.redo },
        { id: "place", label: text("headset.place"), enabled: true, press: () => this.recenter() },
        { id: "takeOut", label: text("takeOut"), enabled: idle && some, press: this.actions.takeOut },
        { id: "putBack", label: text("putBack"), enabled: idle && some, press: this.actions.putBack },
        { id: "findPath", label: text("findPath"), enabled: idle && some, press: this.actions.findPath },
        ...this.responseButtons(),
        { id: "leave", label: text("headset.leave"), enabled: true, press: () => void this.xr?.end() },
      ],
    });
  }

  private responseButtons(): WristButton[] {
    const { state, control } = this.session.store;
    return (["slide", "touch", "stop"] as const).map((response) => ({
      id: response,
      label: text(`response.${response}`),
      enabled: control && state?.responses.includes(response) === true,
      pressed: state?.response === response,
      press: () => void this.session.send("set_response", { response }),
    }));
  }

  private recenter(): void {
    this.placed = false;
  }

  /// Pulses the hands when their set gets blocked.
  private pulseOnContact(): void {
    const blocked = this.activeGrab !== null && this.session.store.frame?.blocked === true;
    if (blocked && !this.wasBlocked) for (const hand of this.activeGrab!.hands) hand.pulse();
    this.wasBlocked = blocked;
  }
}
