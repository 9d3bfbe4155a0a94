// SPDX-License-Identifier: Apache-2.0
import { Box3, Group, Matrix4, PerspectiveCamera, Scene, Vector3 } from "three";
import type { Drag } from "../input/drag.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { type HandPose, roomMotionOfHands } from "./hand_motion.ts";
import { Hold } from "./hold.ts";
import { type WristButton, WristPanel } from "./wrist_panel.ts";
import { XrHand } from "./xr_hand.ts";

/// The assembly is put before the eyes, its longest side so long [m]: so far ahead, and so far below them.
const kSide = 0.5;
const kAhead = 0.6;
const kBelow = 0.25;
/// Of two sets in two hands the engine moves one at a time: the other has its turn when its hand has gone so far [m], and the
/// first has had so long [ms].
const kStir = 0.01;
const kTurn = 150;
const kHandColors = ["#56b4e9", "#e69f00"];
/// z up in the world, y up in the room.
const kUpright = new Matrix4().makeRotationX(-Math.PI / 2);

type Grabbed = { hand: XrHand; from: HandPose };

/// What the wrist panel's buttons do, by the names of the page's actions.
export type HeadsetActions = Record<"undo" | "redo" | "takeOut" | "putBack" | "findPath", () => void>;

/// Whether this browser can show the scene in a headset.
export async function hasHeadset(): Promise<boolean> {
  return (await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false)) ?? false;
}

/// An immersive session: the scene stands in a room in metres, in which a head and two hands move. The hands take components
/// as the pointer does: they send targets, and the engine says where things are.
export class Headset {
  private readonly room = new Scene();
  /// Where the scene stands in the room.
  readonly stage = new Group();
  private readonly camera = new PerspectiveCamera();
  readonly panel = new WristPanel();
  hands: XrHand[] = [];
  private xr: XRSession | null = null;
  private isPlaced = false;
  /// The sets that hands hold: one, or in each hand another; and the one of them that the engine moves now.
  private holds: Hold<XrHand>[] = [];
  private moved: Hold<XrHand> | null = null;
  private turnBegan = 0;
  private givesTurn = false;
  private pulls: Grabbed[] = [];
  private stageThen = new Matrix4();
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

  /// Call on a press of a button: browsers want one.
  async enter(): Promise<void> {
    if (this.xr) return void this.xr.end();
    const { viewport } = this.session;
    try {
      this.xr = await navigator.xr!.requestSession("immersive-vr", {
        requiredFeatures: ["local-floor"],
        optionalFeatures: ["hand-tracking"],
      });
    } catch (error) {
      return this.session.onNote("warning", text("headset.refused", { why: (error as Error).message }));
    }
    this.xr.addEventListener("end", () => this.leave());
    this.isPlaced = false;
    this.stage.add(viewport.scene);
    const manager = await viewport.immerse(this.xr, this.room, this.camera, () => this.everyFrame());
    this.hands = kHandColors.map((color, i) => new XrHand(manager, i, color));
    for (const hand of this.hands) this.connect(hand);
    this.session.notifier.notify();
  }

  private leave(): void {
    const { viewport } = this.session;
    if (this.drag.active) void this.drag.end();
    [this.xr, this.holds, this.moved, this.pulls] = [null, [], null, []];
    for (const hand of this.hands) hand.dispose();
    this.room.remove(...this.hands.flatMap(({ aim, grip }) => [aim, grip]));
    this.stage.remove(viewport.scene);
    viewport.surface();
    this.session.notifier.notify();
  }

  private connect(hand: XrHand): void {
    this.room.add(hand.aim, hand.grip);
    hand.onGrab = () => this.grab(hand);
    hand.onLetGo = () => this.letGo(hand);
    const others = () => this.pulls.map((pull) => pull.hand).filter((other) => other !== hand);
    hand.onPull = () => this.pull([...others(), hand]);
    hand.onStopPulling = () => this.pull(others());
  }

  /// What a hand points at: a distance along its ray [m], the component and the point of the world.
  private aimed(hand: XrHand): { distance: number; component: number; point: Vector3 } | null {
    const pick = this.session.viewport.castWorld(hand.rayIn(this.stage.matrix));
    if (!pick) return null;
    const there = pick.point.clone().applyMatrix4(this.stage.matrix);
    return { distance: there.distanceTo(hand.pose.position), component: pick.component, point: pick.point };
  }

  private panelMet(hand: XrHand): { distance: number; button: WristButton | null } | null {
    if (hand.grip === this.panel.object.parent) return null;
    return this.panel.meet(hand.ray);
  }

  private grab(hand: XrHand): void {
    const met = this.panelMet(hand);
    if (met) return met.button?.enabled ? met.button.press() : undefined;
    const aimed = this.aimed(hand);
    if (!aimed || !this.drag.allowed) return this.session.select([]);
    const { store } = this.session;
    const held = this.holds.find(({ components }) => components.includes(aimed.component));
    if (held) return held.regrip([...held.hands, hand], this.stage.matrix);
    if (this.drag.active && this.holds.length === 0) return hand.tap();
    const isFirst = this.holds.length === 0;
    if (isFirst && !store.selection.includes(aimed.component)) this.session.select([aimed.component]);
    const components = isFirst ? [...store.selection] : [aimed.component];
    const hold = new Hold<XrHand>(components, aimed.point, this.session.poseOf(components[0]));
    hold.regrip([hand], this.stage.matrix);
    this.holds.push(hold);
    if (isFirst) void this.giveTurn(hold);
  }

  private letGo(hand: XrHand): void {
    const hold = this.holds.find(({ hands }) => hands.includes(hand));
    if (!hold) return;
    const others = hold.hands.filter((other) => other !== hand);
    if (others.length > 0) return hold.regrip(others, this.stage.matrix);
    this.holds = this.holds.filter((other) => other !== hold);
    if (hold === this.moved) void this.giveTurn(this.holds[0] ?? null);
  }

  /// Has the engine move a set that a hand holds in place of what it moves now; another one where that cannot be taken, or was
  /// let go of in the meantime.
  private async giveTurn(next: Hold<XrHand> | null): Promise<void> {
    if (this.givesTurn) return;
    this.givesTurn = true;
    this.moved?.rest();
    if (this.drag.active) await this.drag.end();
    this.moved = next;
    if (next && !(await this.take(next))) this.holds = this.holds.filter((hold) => hold !== next);
    this.turnBegan = performance.now();
    this.givesTurn = false;
    if (this.moved && !this.holds.includes(this.moved)) await this.giveTurn(this.holds[0] ?? null);
  }

  private take(hold: Hold<XrHand>): Promise<boolean> {
    this.session.select(hold.components);
    return this.drag.begin(hold.components, hold.point(this.session.poseOf(hold.components[0])));
  }

  private pull(hands: XrHand[]): void {
    this.pulls = hands.map((hand) => ({ hand, from: hand.pose }));
    this.stageThen.copy(this.stage.matrix);
  }

  private everyFrame(): void {
    this.room.updateMatrixWorld();
    const eye = new Vector3().setFromMatrixPosition(this.camera.matrixWorld);
    if (!this.isPlaced && eye.lengthSq() > 0) this.place(eye);
    this.followHands();
    this.pullRoom();
    this.session.viewport.setEye(eye.applyMatrix4(this.stage.matrix.clone().invert()), this.stage.matrix);
    this.showRays();
    this.showPanel();
    this.tellContact();
  }

  private followHands(): void {
    if (this.givesTurn || !this.moved) return;
    this.drag.follow(this.moved.motion(this.stage.matrix));
    const other = this.holds.find((hold) => hold !== this.moved);
    if (other && other.stirred > kStir && performance.now() - this.turnBegan > kTurn) void this.giveTurn(other);
  }

  private place(eye: Vector3): void {
    const bounds = this.session.viewport.model?.bounds() ?? new Box3();
    if (bounds.isEmpty()) return;
    this.isPlaced = true;
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

  private pullRoom(): void {
    const [a, b] = this.pulls;
    if (!a) return;
    const moved = b
      ? roomMotionOfHands([a.from, b.from], [a.hand.pose, b.hand.pose])
      : new Matrix4().makeTranslation(a.hand.pose.position.sub(a.from.position));
    this.stage.matrix.multiplyMatrices(moved, this.stageThen);
    this.stage.matrixWorldNeedsUpdate = true;
  }

  private showRays(): void {
    let [hovered, button]: [number | null, WristButton | null] = [null, null];
    for (const hand of this.hands) {
      if (!hand.source) continue;
      const met = this.panelMet(hand);
      const aimed = met ? null : this.aimed(hand);
      hand.showRay(met?.distance ?? aimed?.distance ?? null);
      hovered ??= aimed?.component ?? null;
      button ??= met?.button ?? null;
    }
    this.session.hover(hovered);
    this.panel.hover(button);
  }

  /// Worn on the left hand, or on the only one.
  private showPanel(): void {
    const { store } = this.session;
    const wearer = this.hands.find(({ source }) => source?.handedness === "left") ?? this.hands.find((h) => h.source);
    if (wearer && this.panel.object.parent !== wearer.grip) wearer.grip.add(this.panel.object);
    const { state } = store;
    const idle = store.control && state?.hand == null && state?.automatic == null && state?.playback == null;
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
        { id: "place", label: text("headset.place"), enabled: true, press: () => this.placeAnew() },
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
      enabled: control && state !== null,
      pressed: state?.response === response,
      press: () => void this.session.ask("set_response", { response }),
    }));
  }

  private placeAnew(): void {
    this.isPlaced = false;
  }

  /// What is held runs into something: the hand feels it.
  private tellContact(): void {
    const blocked = this.moved !== null && this.session.store.frame?.blocked === true;
    if (blocked && !this.wasBlocked) for (const hand of this.moved!.hands) hand.tap();
    this.wasBlocked = blocked;
  }
}
