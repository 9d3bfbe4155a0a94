// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { Arrow } from "../scene/arrow_field.ts";
import type { CameraRig } from "../scene/camera_rig.ts";
import type { Session } from "../session.ts";
import type { PoseFrame } from "../wire/structs.ts";

/// A set blocked for this long is reported as stuck, and its free directions are queried [ms].
const kStuckTime = 1000;
/// Contacts closer than this on screen share an arrow; length of the arrows [px].
const kArrowGap = 22;
const kArrowLength = 30;

/// Feedback about the moving set, whichever device drives it: contacts, blocking components, minimum clearance and,
/// when stuck, the free directions. Driven by the server's frames, so a watching page shows the same.
export class Feedback {
  private grip: number | null = null;
  private moves = 0;
  private stuckSince = 0;
  private stuckReported = false;

  constructor(private readonly session: Session) {
    session.onFrame.push((frame) => this.receiveFrame(frame));
    session.viewport.beforeRender.push((now) => this.watchStuck(now));
    session.notifier.subscribe(() => this.update());
  }

  /// True if the moving set has been reported as stuck and is still blocked.
  get stuck(): boolean {
    return this.stuckReported && this.session.store.blocking.size > 0;
  }

  /// Shows nothing until the next frame.
  clear(): void {
    this.clearStuck();
    this.session.viewport.contacts.arrows = [];
    this.session.block(new Set());
  }

  /// Follows changes of the moving set.
  private update(): void {
    const { state } = this.session.store;
    const grip = state?.hand?.grip ?? null;
    if (grip !== this.grip) {
      this.grip = grip;
      this.clear();
      if (grip !== null)
        this.session.change(() => {
          Object.assign(this.session.store, { minClearance: Number.NaN, stuck: null });
        });
    }
    // The minimum of a drag that was undone says nothing any more.
    const moves = state?.moves.length ?? 0;
    if (moves < this.moves && grip === null)
      this.session.change(() => {
        this.session.store.minClearance = Number.NaN;
      });
    this.moves = moves;
    if (grip === null && !state?.automatic && !state?.playback) this.session.viewport.contacts.arrows = [];
  }

  private receiveFrame(frame: PoseFrame): void {
    this.update();
    const { store, viewport } = this.session;
    const held = this.grip !== null && frame.grip === this.grip;
    const shown = held || frame.automatic || frame.playback;
    viewport.contacts.arrows = shown ? contactArrows(frame, viewport.rig) : [];
    if (!held) return;
    if (!Number.isNaN(frame.clearance) && !(store.minClearance <= frame.clearance))
      store.minClearance = frame.clearance;
    this.session.block(new Set(frame.blocked ? frame.contacts.map(({ fixed }) => fixed) : []));
    if (!frame.blocked) this.clearStuck();
    else if (this.stuckSince === 0) this.stuckSince = performance.now();
  }

  /// Drops the free directions that were found for a stuck set.
  private clearStuck(): void {
    if (this.stuckReported)
      this.session.change(() => {
        this.session.store.directions = null;
      });
    [this.stuckSince, this.stuckReported] = [0, false];
  }

  private watchStuck(now: number): boolean {
    if (this.stuckSince === 0 || this.stuckReported) return false;
    if (now - this.stuckSince < kStuckTime) return true;
    this.stuckReported = true;
    const { store, connection } = this.session;
    const { grip } = this;
    const components = store.state!.hand!.components;
    void connection.command("free_directions", { components }).then(
      ({ directions }) => {
        if (this.grip === grip && this.stuckReported)
          this.session.change(() => {
            store.directions = { components, directions };
          });
      },
      () => {},
    );
    return false;
  }
}

/// Contacts as arrows. Of those that would overlap on screen, only the one with the smallest gap.
function contactArrows(frame: PoseFrame, rig: CameraRig): Arrow[] {
  const arrows: Arrow[] = [];
  const positions: Vector3[] = [];
  for (const contact of frame.contacts) {
    const point = new Vector3(...contact.point);
    const direction = new Vector3(...contact.normal);
    const position = rig.project(point).setZ(0);
    const covered = arrows.some(
      (other, i) => positions[i].distanceTo(position) < kArrowGap && other.direction.dot(direction) > 0.9,
    );
    if (covered) continue;
    arrows.push({ point, direction, length: kArrowLength });
    positions.push(position);
  }
  return arrows;
}
