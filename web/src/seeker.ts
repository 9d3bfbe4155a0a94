// SPDX-License-Identifier: Apache-2.0
import type { Session } from "./session.ts";
import type { Source } from "./wire/messages.ts";

/// Follows a scrubber: one seek at a time, the newest next.
export class Seeker {
  private seeking = false;
  private wanted: { time: number; source: Source } | null = null;

  constructor(private readonly session: Session) {}

  /// Whether the server is not yet where it was asked to be.
  get busy(): boolean {
    return this.seeking;
  }

  async seek(time: number, source: Source): Promise<void> {
    this.wanted = { time, source };
    if (this.seeking) return;
    this.seeking = true;
    while (this.wanted) {
      const next: { time: number; source: Source } = this.wanted;
      this.wanted = null;
      await this.session.ask("seek", next);
    }
    this.seeking = false;
  }
}
