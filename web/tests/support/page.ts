// SPDX-License-Identifier: Apache-2.0
import { type ChildProcess, execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { type Browser, chromium as driver, type Page } from "playwright-core";
import type { StateEvent } from "../../src/wire/messages.ts";
import { chromium, pageFolder, program, sourceFolder } from "./environment.ts";

/// Software rendering of the 3D view by Mesa: twice as fast as the browser's own. The page around it is drawn without OpenGL, which
/// takes a quarter less of the processor than by Mesa.
const kChromiumFlags = [
  ...["--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"],
  ...["--disable-gpu-compositing", "--disable-accelerated-2d-canvas"],
];
/// Timeout of all waits [ms], for loaded machines.
const kTimeout = 90_000;

/// A running server.
export class Server {
  private constructor(
    readonly url: string,
    private readonly child: ChildProcess,
    /// The server's own folder: journal, lists, and files of the test.
    readonly home: string,
  ) {}

  static start(...arguments_: string[]): Promise<Server> {
    return Server.startIn(mkdtempSync(join(tmpdir(), "dismantle-viewer-")), ...arguments_);
  }

  /// Starts a server in the folder of an earlier one.
  static startIn(home: string, ...arguments_: string[]): Promise<Server> {
    const folders = { HOME: home, XDG_STATE_HOME: home, XDG_CACHE_HOME: home, XDG_CONFIG_HOME: home };
    return Server.spawn(home, program(), ["view", "--no-browser", ...pageFolder(), ...arguments_], folders);
  }

  /// Starts ./run, as a new user does; it builds first if needed.
  static startRun(): Promise<Server> {
    const home = mkdtempSync(join(tmpdir(), "dismantle-viewer-"));
    return Server.spawn(home, join(sourceFolder(), "run"), ["--no-browser", "--no-journal"], {});
  }

  private static spawn(home: string, command: string, arguments_: string[], environment: object): Promise<Server> {
    const child = spawn(command, arguments_, { env: { ...process.env, ...environment } });
    return new Promise((resolve, reject) => {
      let said = "";
      const listen = (chunk: Buffer) => {
        said += chunk.toString();
        const url = /http:\/\/127\.0\.0\.1:\d+\/#token=[0-9a-f]+/.exec(said)?.[0];
        if (url) resolve(new Server(url, child, home));
      };
      child.stdout?.on("data", listen);
      child.stderr?.on("data", listen);
      child.on("exit", (code) => reject(new Error(`the server ended with ${code}: ${said}`)));
    });
  }

  /// The file of an open assembly: a file in `home`, or a sample.
  fileOf(name: string): string {
    const file = join(this.home, name);
    if (!existsSync(file)) execFileSync(program(), ["sample", basename(name, ".step"), "-o", file]);
    return file;
  }

  /// Ends the server; its folder remains.
  async end(signal: "SIGTERM" | "SIGKILL"): Promise<void> {
    const ended = new Promise((resolve) => this.child.once("exit", resolve));
    this.child.kill(signal);
    await ended;
  }

  async stop(): Promise<void> {
    await this.end("SIGTERM");
    rmSync(this.home, { recursive: true, force: true });
  }
}

let browser: Browser | null = null;

export async function closeBrowser(): Promise<void> {
  await browser?.close();
  browser = null;
}

/// Throttles the processor by DISMANTLE_SLOWDOWN.
async function slowDown(page: Page): Promise<void> {
  const rate = Number(process.env.DISMANTLE_SLOWDOWN ?? 1);
  if (rate === 1) return;
  const browserSession = await page.context().newCDPSession(page);
  await browserSession.send("Emulation.setCPUThrottlingRate", { rate });
}

export interface OpenOptions {
  /// True (default) to wait until the model is drawn.
  waits?: boolean;
  /// The key of the first view.
  view?: string;
  /// Runs before the page's own script.
  before?: (page: Page) => Promise<unknown>;
}

type Touch = (
  type: "touchStart" | "touchMove" | "touchEnd",
  ...touchPoints: { x: number; y: number; id: number }[]
) => Promise<unknown>;

/// A viewer page driven by a test.
export class Viewer {
  readonly problems: string[] = [];

  private constructor(readonly page: Page) {
    page.on("pageerror", (error) => this.problems.push(String(error.stack ?? error)));
    page.on("console", (message) => {
      if (message.type() === "error") this.problems.push(message.text());
    });
  }

  static async visit(url: string, before?: OpenOptions["before"], size = { width: 800, height: 500 }): Promise<Viewer> {
    browser ??= await driver.launch({ executablePath: chromium(), args: kChromiumFlags, timeout: kTimeout });
    const page = await browser.newPage({ viewport: size });
    page.setDefaultTimeout(kTimeout);
    await slowDown(page);
    await before?.(page);
    const viewer = new Viewer(page);
    await page.goto(url);
    return viewer;
  }

  static async open(server: Server, { waits = true, view, before }: OpenOptions = {}): Promise<Viewer> {
    const viewer = await Viewer.visit(server.url.replace("/#", "/?test#"), before);
    if (waits) await viewer.model();
    if (view) await viewer.press(view);
    return viewer;
  }

  /// Waits until a model is loaded and drawn.
  async model(): Promise<void> {
    const there = () => window.dismantle?.app.viewport.model != null;
    await this.page.waitForFunction(there).catch(async (error: Error) => {
      const words = await this.page.locator("body").innerText();
      throw new Error(`${error.message}\n${this.problems.join("\n")}\n${words}`);
    });
    await this.idle();
  }

  idle(): Promise<void> {
    return this.page.evaluate(() => window.dismantle!.idle());
  }

  /// Waits until this page shows the state of another page of the session.
  async catchUpWith(other: Viewer): Promise<void> {
    const { number } = await other.state();
    await this.page.waitForFunction((n) => window.dismantle!.app.session.store.state!.number >= n, number);
    await this.idle();
  }

  state(): Promise<StateEvent> {
    return this.page.evaluate(() => window.dismantle!.app.session.store.state!);
  }

  index(name: string): Promise<number> {
    return this.page.evaluate(
      (n) => window.dismantle!.app.session.store.model!.components.findIndex((c) => c.name === n),
      name,
    );
  }

  /// Translation of a component from its assembled position, in the engine [mm].
  async shift(name: string): Promise<[number, number, number]> {
    const [state, index] = [await this.state(), await this.index(name)];
    const pose = state.components[index].pose;
    return pose ? [pose[0], pose[1], pose[2]] : [0, 0, 0];
  }

  /// The same, as drawn.
  async drawnShift(name: string): Promise<[number, number, number]> {
    const matrix = await this.page.evaluate((n) => window.dismantle!.drawnMatrix(n), name);
    return [matrix[12], matrix[13], matrix[14]];
  }

  /// A point of the page at which the component is in front.
  async visiblePoint(name: string): Promise<{ x: number; y: number }> {
    const place = await this.page.evaluate((n) => window.dismantle!.visiblePoint(n), name);
    if (!place) throw new Error(`${name} is nowhere in front`);
    return place;
  }

  /// The recording as a path file.
  recording(): Promise<string> {
    return this.page.evaluate(async () => {
      const { connection } = window.dismantle!.app.session;
      return (await connection.request("/api/path.json")).text();
    });
  }

  async select(...names: string[]): Promise<void> {
    await this.page.evaluate((wanted) => {
      const { session } = window.dismantle!.app;
      session.select(wanted.map((name) => session.store.model!.components.findIndex((c) => c.name === name)));
    }, names);
    await this.idle();
  }

  selection(): Promise<string[]> {
    return this.page.evaluate(() => {
      const { store } = window.dismantle!.app.session;
      return store.selection.map((c) => store.model!.components[c].name);
    });
  }

  /// Takes a component out by the button and waits for the end.
  async takeOut(name: string): Promise<void> {
    await this.select(name);
    await this.page.click("#take-out");
    await this.page.waitForFunction(
      (i) => {
        const { components, automatic } = window.dismantle!.app.session.store.state!;
        return automatic === null && components[i].removed;
      },
      await this.index(name),
    );
    await this.idle();
  }

  /// Zooms towards a corner of a component's box.
  async zoomTo(name: string, factor: number): Promise<void> {
    await this.page.evaluate(
      ([n, by]) => {
        const { rig, model } = window.dismantle!.app.viewport;
        rig.zoom(by as number, model!.components.find(({ raw }) => raw.name === n)!.bounds().min);
      },
      [name, factor],
    );
    await this.idle();
  }

  async press(...keys: string[]): Promise<void> {
    for (const key of keys) await this.page.keyboard.press(key);
    await this.idle();
  }

  async click(selector: string): Promise<void> {
    await this.page.click(selector);
    await this.idle();
  }

  /// Presses the left button on a component and moves in steps; the button stays pressed.
  async grab(name: string, dx: number, dy: number, steps = 6): Promise<void> {
    const { x, y } = await this.visiblePoint(name);
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    for (let i = 1; i <= steps; ++i) await this.page.mouse.move(x + (dx * i) / steps, y + (dy * i) / steps);
    await this.idle();
  }

  async release(): Promise<void> {
    await this.page.mouse.up();
    await this.idle();
  }

  /// Presses a button. Returns the file that the browser saves.
  async saved(button: string): Promise<{ name: string; bytes: Buffer }> {
    const coming = this.page.waitForEvent("download");
    await this.page.click(button);
    const download = await coming;
    return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
  }

  /// Dispatches touch events.
  async touchscreen(): Promise<Touch> {
    const touches = await this.page.context().newCDPSession(this.page);
    return (type, ...touchPoints) => touches.send("Input.dispatchTouchEvent", { type, touchPoints });
  }

  /// The image of the 3D view without panels.
  async picture(): Promise<string> {
    await this.idle();
    return this.page.evaluate(() => window.dismantle!.app.viewport.canvas.toDataURL());
  }

  async close(): Promise<void> {
    await this.page.close();
  }
}
