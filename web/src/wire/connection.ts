// SPDX-License-Identifier: Apache-2.0
import type { GuideStep } from "../guide.ts";
import { EventListeners } from "./event_listeners.ts";
import type { Commands, Events } from "./messages.ts";
import { type PoseFrame, readPoseFrame } from "./structs.ts";

/// State of the connection to the server.
export type Link = "connecting" | "open" | "lost";

interface PendingCommand {
  text: string;
  resolve: (reply: never) => void;
  reject: (error: Error) => void;
}

type Listener<T> = (value: T) => void;

const kMinRetryDelay = 200;
const kMaxRetryDelay = 2000;
/// A connection with as much as this unsent is congested.
const kMaxUnsentBytes = 4096;

/// The connection of a session to the server, or to its substitute in an exported page.
export interface Transport {
  onFrame: Listener<PoseFrame>;
  onLink: Listener<Link>;
  /// True if every command and request has been answered.
  readonly settled: boolean;
  /// The steps of the path, if there is no server to request them from.
  readonly steps?: GuideStep[];
  connect(): void;
  /// Drops the connection. It is restored as after any loss.
  reconnect(): void;
  on<Name extends keyof Events>(name: Name, listener: Listener<Events[Name]>): void;
  /// Sends a command. Rejects with the server's message if it is refused.
  command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]>;
  /// Sends a struct. Returns false, and sends nothing, if the connection is lost or congested.
  sendStruct(bytes: ArrayBuffer): boolean;
  /// Requests an address under /api/. Resolves with the complete response.
  request(address: string, options?: { method?: string; body?: Blob }): Promise<globalThis.Response>;
}

/// A WebSocket connection that reconnects automatically and sends unanswered commands again.
export class Connection implements Transport {
  onFrame: Listener<PoseFrame> = () => {};
  onLink: Listener<Link> = () => {};
  link: Link = "connecting";

  private socket: WebSocket | null = null;
  private retry = kMinRetryDelay;
  private readonly token: string;
  private readonly client: string;
  private readonly pending = new Map<number, PendingCommand>();
  private requests = 0;
  private readonly listeners = new EventListeners();

  constructor() {
    this.token = /[#&]token=([0-9a-f]+)/i.exec(location.hash)?.[1] ?? "";
    this.client = stored("dismantle.client", randomHex);
  }

  connect(): void {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const address = `${scheme}://${location.host}/session?client=${this.client}`;
    this.socket = new WebSocket(address, ["dismantle.1", `token.${this.token}`]);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.retry = kMinRetryDelay;
      this.setLink("open");
      for (const { text } of this.pending.values()) this.socket?.send(text);
    };
    this.socket.onclose = () => {
      this.setLink("lost");
      setTimeout(() => this.connect(), this.retry);
      this.retry = Math.min(2 * this.retry, kMaxRetryDelay);
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
    this.listeners.on(name, listener);
  }

  command<Name extends keyof Commands>(name: Name, members: Commands[Name][0]): Promise<Commands[Name][1]> {
    const id = Number(stored("dismantle.command", () => "0")) + 1;
    sessionStorage.setItem("dismantle.command", String(id));
    const text = JSON.stringify({ id, command: name, ...members });
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
    return new Promise((resolve, reject) => {
      this.pending.set(id, { text, resolve: resolve as (reply: never) => void, reject });
    });
  }

  sendStruct(bytes: ArrayBuffer): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN || this.socket.bufferedAmount >= kMaxUnsentBytes) return false;
    this.socket.send(bytes);
    return true;
  }

  async request(address: string, options: { method?: string; body?: Blob } = {}): Promise<globalThis.Response> {
    const headers = { Authorization: `Bearer ${this.token}`, "X-Client": this.client };
    ++this.requests;
    try {
      const response = await fetch(address, { ...options, headers });
      if (response.ok) return new Response(await response.arrayBuffer(), { headers: response.headers });
      const body = (await response.json().catch(() => ({}))) as { error?: string };
      throw new Error(body.error ?? `${response.status} ${response.statusText}`);
    } finally {
      --this.requests;
    }
  }

  get settled(): boolean {
    return this.pending.size === 0 && this.requests === 0;
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
    if (message.event) return this.listeners.emit(message.event, message as never);
    const pending = this.pending.get(message.reply ?? 0);
    if (!pending) return;
    this.pending.delete(message.reply ?? 0);
    if (message.ok) pending.resolve(message as never);
    else pending.reject(new Error(message.error));
  }
}

/// A value that survives a reload of this tab.
function stored(key: string, make: () => string): string {
  const value = sessionStorage.getItem(key) ?? make();
  sessionStorage.setItem(key, value);
  return value;
}

function randomHex(): string {
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
