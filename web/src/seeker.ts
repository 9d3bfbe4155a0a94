// SPDX-License-Identifier: Apache-2.0
import type { Session } from "./session.ts";
import type { Source } from "./wire/messages.ts";

/// Sends seeks of a scrubber one at a time. While one is pending, only the newest is kept.
export class Seeker {
  private seeking = false;
  private newest: { time: number; source: Source } | null = null;

  constructor(private readonly session: Session) {}

  /// True if a seek is pending.
  get busy(): boolean {
    return this.seeking;
  }

  /// Requests a seek. Resolves when no seek is pending.
  async seek(time: number, source: Source): Promise<void> {
    this.newest = { time, source };
    if (this.seeking) return;
    this.seeking = true;
    while (this.newest) {
      const next: { time: number; source: Source } = this.newest;
      this.newest = null;
      await this.session.send("seek", next);
    }
    this.seeking = false;
  }
}
