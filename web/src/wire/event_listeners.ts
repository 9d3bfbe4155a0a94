// SPDX-License-Identifier: Apache-2.0
import type { Events } from "./messages.ts";

type Listener<Name extends keyof Events> = (event: Events[Name]) => void;

/// Listeners of the server's events, by event name.
export class EventListeners {
  private readonly listeners: { [Name in keyof Events]?: Listener<Name>[] } = {};

  /// Adds a listener.
  on<Name extends keyof Events>(name: Name, listener: Listener<Name>): void {
    const listeners = (this.listeners[name] ?? []) as Listener<Name>[];
    listeners.push(listener);
    (this.listeners as Record<string, unknown>)[name] = listeners;
  }

  /// Calls the listeners of an event, in the order in which they were added.
  emit<Name extends keyof Events>(name: Name, event: Events[Name]): void {
    for (const listener of this.listeners[name] ?? []) (listener as Listener<Name>)(event);
  }
}
