// SPDX-License-Identifier: Apache-2.0
import type { Store } from "./store.ts";
import { text } from "./strings.ts";
import type { JobEvent } from "./wire/messages.ts";

/// Interval at which the time of running jobs is updated [ms].
const kInterval = 1000;

/// The server's jobs: imports, searches, work instructions. Keeps the running ones in the store.
export class JobList {
  /// Last events of jobs, and those who wait for one.
  private readonly ended = new Map<number, JobEvent>();
  private waiting: (() => void)[] = [];

  /// @param changed the store has changed; @param say shows a message to the user
  constructor(
    private readonly store: Store,
    changed: () => void,
    private readonly say: (level: "note" | "warning", message: string) => void,
  ) {
    setInterval(() => {
      if (store.jobs.size === 0) return;
      for (const job of store.jobs.values()) job.seconds += kInterval / 1000;
      changed();
    }, kInterval);
  }

  /// Takes in an event, and tells the user how a job ended if that was not well.
  apply(event: JobEvent): void {
    const { job, name, status, error = "" } = event;
    if (status === "running") {
      this.store.jobs.set(job, { ...event });
      return;
    }
    this.store.jobs.delete(job);
    this.ended.set(job, event);
    for (const look of this.waiting.splice(0)) look();
    if (status === "failed") this.say("warning", error.includes(name) ? error : text("job.failed", { name, error }));
    if (status === "cancelled") this.say("note", text("job.cancelled.of", { name }));
  }

  /// Resolves with the last event of a job.
  endOf(job: number): Promise<JobEvent> {
    return new Promise((resolve) => {
      const look = (): void => {
        const event = this.ended.get(job);
        if (event) resolve(event);
        else this.waiting.push(look);
      };
      look();
    });
  }
}
