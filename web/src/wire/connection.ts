// SPDX-License-Identifier: Apache-2.0
import type { Commands, Events } from "./messages.ts";
import { type PoseFrame, readPoseFrame } from "./structs.ts";

export type Link = "connecting" | "open" | "lost";

interface Waiting {
  text: string;
  resolve: (answer: never) => void;
  reject: (error: Error) => void;
}

type Listener<T> = (value: T) => void;

const kFirstRetry = 200;
const kLongestRetry = 2000;

/// What a session talks to: the server, or what stands in its place.
export interface Wire {
  onFrame: Listener<PoseFrame>;
  onLink: Listener<Link>;
  /// Whether every command and request has its answer.
  readonly settled: boolean;
  connect(): void;
  /// Drops the connection; it comes back as after any loss.
  reconnect(): void;
  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void;
  /// Sends a command. Rejects with a sentence where it is refused.
  command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]>;
  /// Sends a struct, or drops it where the connection is lost or behind: the next one is newer.
  sendStruct(bytes: ArrayBuffer): void;
  /// Asks one of the doors under /api/. The answer is there as a whole.
  request(address: string, options?: { method?: string; body?: Blob }): Promise<globalThis.Response>;
}

/// The socket to the server, which comes back by itself: commands that were not answered are sent again.
export class Connection implements Wire {
  onFrame: Listener<PoseFrame> = () => {};
  onLink: Listener<Link> = () => {};
  link: Link = "connecting";

  private socket: WebSocket | null = null;
  private retry = kFirstRetry;
  private readonly token: string;
  private readonly client: string;
  private readonly waiting = new Map<number, Waiting>();
  private requests = 0;
  private readonly listeners: { [Name in keyof Events]?: Listener<Events[Name]>[] } = {};

  constructor() {
    this.token = /[#&]token=([0-9a-f]+)/i.exec(location.hash)?.[1] ?? "";
    this.client = kept("dismantle.client", randomHex);
  }

  connect(): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const address = `${scheme}://${location.host}/session?client=${this.client}`;
    this.socket = new WebSocket(address, ["dismantle.1", `token.${this.token}`]);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.retry = kFirstRetry;
      this.setLink("open");
      for (const { text } of this.waiting.values()) this.socket?.send(text);
    };
    this.socket.onclose = () => {
      this.setLink("lost");
      setTimeout(() => this.connect(), this.retry);
      this.retry = Math.min(2 * this.retry, kLongestRetry);
    };
    this.socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.receive(JSON.parse(data));
      else this.receiveFrame(data as ArrayBuffer);
    };
  }

  reconnect(): void {
    this.socket?.close();
    this.setLink("lost");
  }

  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void {
    const listeners = (this.listeners[name] ?? []) as Listener<Events[Name]>[];
    listeners.push(listener);
    (this.listeners as Record<string, unknown>)[name] = listeners;
  }

  command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]> {
    const id = Number(kept("dismantle.command", () => "0")) + 1;
    sessionStorage.setItem("dismantle.command", String(id));
    const text = JSON.stringify({ id, command: name, ...members });
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { text, resolve: resolve as (answer: never) => void, reject });
    });
  }

  sendStruct(bytes: ArrayBuffer): void {
    if (this.socket?.readyState === WebSocket.OPEN && this.socket.bufferedAmount < 4096) this.socket.send(bytes);
  }

  async request(address: string, options: { method?: string; body?: Blob } = {}): Promise<globalThis.Response> {
    const headers = { Authorization: `Bearer ${this.token}`, "X-Client": this.client };
    ++this.requests;
    try {
      const answer = await fetch(address, { ...options, headers });
      if (answer.ok) return new Response(await answer.arrayBuffer(), { headers: answer.headers });
      const body = (await answer.json().catch(() => ({}))) as { error?: string };
      throw new Error(body.error ?? `${answer.status} ${answer.statusText}`);
    } finally {
      --this.requests;
    }
  }

  get settled(): boolean {
    return this.waiting.size === 0 && this.requests === 0;
  }

  private setLink(link: Link): void {
    this.link = link;
    this.onLink(link);
  }

  private receiveFrame(bytes: ArrayBuffer): void {
    const frame = readPoseFrame(bytes);
    if (frame) this.onFrame(frame);
  }

  private receive(message: { reply?: number; ok?: boolean; error?: string; event?: keyof Events }): void {
    if (message.event) {
      for (const listener of this.listeners[message.event] ?? []) (listener as Listener<unknown>)(message);
      return;
    }
    const waiting = this.waiting.get(message.reply ?? 0);
    if (!waiting) return;
    this.waiting.delete(message.reply ?? 0);
    if (message.ok) waiting.resolve(message as never);
    else waiting.reject(new Error(message.error));
  }
}

/// A value that this tab keeps when it is loaded again.
function kept(key: string, make: () => string): string {
  const value = sessionStorage.getItem(key) ?? make();
  sessionStorage.setItem(key, value);
  return value;
}

function randomHex(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
