// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { CameraRig } from "../scene/camera_rig.ts";
import type { Arrow } from "../scene/marks.ts";
import type { Session } from "../session.ts";
import type { PoseFrame } from "../wire/structs.ts";

/// Blocked for so long, the hand is told what is free [ms].
const kStuck = 1000;
/// Contacts nearer than this to each other on screen share an arrow, which is so long [px].
const kArrowGap = 22;
const kArrowLength = 30;

/// What is shown of the set in hand, whatever device holds it: its contacts, what blocks it, the least clearance; and, stuck,
/// what is free. It goes by the server's frames, so a page that watches shows the same.
export class Feedback {
  private grip: number | null = null;
  private stuckSince = 0;
  private stuckAsked = false;

  constructor(private readonly session: Session) {
    session.onFrame.push((frame) => this.takeFrame(frame));
    session.viewport.beforePicture.push((now) => this.watchStuck(now));
    session.notifier.subscribe(() => this.update());
  }

  /// The set in hand has been blocked for long, and was not freed since.
  get stuck(): boolean {
    return this.stuckAsked && this.session.store.blocking.size > 0;
  }

  /// Nothing is shown until the next frame.
  clear(): void {
    this.forgetStuck();
    this.session.viewport.contacts.arrows = [];
    this.session.block(new Set());
  }

  /// Another hand, or none.
  private update(): void {
    const { state } = this.session.store;
    const grip = state?.hand?.grip ?? null;
    if (grip !== this.grip) {
      this.grip = grip;
      this.clear();
      if (grip !== null)
        this.session.change(() => {
          Object.assign(this.session.store, { leastClearance: Number.NaN, stuck: null });
        });
    }
    if (grip === null && !state?.automatic && !state?.playback) this.session.viewport.contacts.arrows = [];
  }

  private takeFrame(frame: PoseFrame): void {
    this.update();
    const { store, viewport } = this.session;
    const held = this.grip !== null && frame.grip === this.grip;
    const shown = held || frame.automatic || frame.playback;
    viewport.contacts.arrows = shown ? contactArrows(frame, viewport.rig) : [];
    if (!held) return;
    if (!Number.isNaN(frame.clearance) && !(store.leastClearance <= frame.clearance))
      store.leastClearance = frame.clearance;
    this.session.block(new Set(frame.blocked ? frame.contacts.map(({ fixed }) => fixed) : []));
    if (!frame.blocked) this.forgetStuck();
    else if (this.stuckSince === 0) this.stuckSince = performance.now();
  }

  /// What was found for a set that was stuck goes when it is not.
  private forgetStuck(): void {
    if (this.stuckAsked)
      this.session.change(() => {
        this.session.store.directions = null;
      });
    [this.stuckSince, this.stuckAsked] = [0, false];
  }

  private watchStuck(now: number): boolean {
    if (this.stuckSince === 0 || this.stuckAsked) return false;
    if (now - this.stuckSince < kStuck) return true;
    this.stuckAsked = true;
    const { store, connection } = this.session;
    const { grip } = this;
    const components = store.state!.hand!.components;
    void connection.command("free_directions", { components }).then(
      ({ directions }) => {
        if (this.grip === grip && this.stuckAsked)
          this.session.change(() => {
            store.directions = { components, directions };
          });
      },
      () => {},
    );
    return false;
  }
}

/// The contacts as arrows; of those that would cover each other on screen, the one with the least gap.
function contactArrows(frame: PoseFrame, rig: CameraRig): Arrow[] {
  const arrows: Arrow[] = [];
  const places: Vector3[] = [];
  for (const contact of frame.contacts) {
    const point = new Vector3(...contact.point);
    const direction = new Vector3(...contact.normal);
    const place = rig.project(point).setZ(0);
    const covered = arrows.some(
      (other, i) => places[i].distanceTo(place) < kArrowGap && other.direction.dot(direction) > 0.9,
    );
    if (covered) continue;
    arrows.push({ point, direction, length: kArrowLength });
    places.push(place);
  }
  return arrows;
}
