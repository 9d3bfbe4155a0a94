// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { App } from "./app.ts";
import type { Drag } from "./input/drag.ts";
import type { Viewport } from "./scene/viewport.ts";
import type { Session } from "./session.ts";
import type { Triple } from "./wire/messages.ts";

/// A page under test.
interface TestedPage {
  readonly viewport: Viewport;
  readonly session: Session;
  readonly drag: Drag;
}

/// Queries for tests, and a promise to wait for instead of sleeping. Changes nothing.
export interface TestApi<Page extends TestedPage = App> {
  /// Resolves when all commands are answered, shown and drawn; rejects after a time with what is not.
  idle(): Promise<void>;
  /// Matrix from assembled to drawn position of the component called `name`, by columns.
  drawnMatrix(name: string): number[];
  /// True if the component called `name` is visible.
  drawn(name: string): boolean;
  /// A point of the page at which the component is in front, with no panel over it; null: none.
  visiblePoint(name: string): { x: number; y: number } | null;
  /// Position of a world point on the page.
  project(point: Triple): { x: number; y: number };
  /// Name of the component at a point of the page; null: none.
  at(x: number, y: number): string | null;
  /// The last rendered image.
  imageData(): ImageData;
  readonly app: Page;
  /// Time of the first render of a model, since the page was loaded [ms]; null: not yet.
  readonly modelDrawn: number | null;
}

const kGridSize = 60;
/// The page is to be idle within this time, on a loaded machine, too [ms].
const kMaxWait = 90_000;

/// Makes the test interface of a page.
export function testApi<Page extends TestedPage>(app: Page): TestApi<Page> {
  const view = (name: string) => app.viewport.model?.components.find(({ raw }) => raw.name === name);
  const onPage = (x: number, y: number) => {
    const box = app.viewport.canvas.getBoundingClientRect();
    return { x: x + box.left, y: y + box.top };
  };
  const nameAt = (x: number, y: number) => {
    const pick = app.viewport.pick(x, y);
    return pick && app.session.nameOf(pick.component);
  };
  let modelDrawn: number | null = null;
  const watch = () => {
    if (!app.viewport.model) return;
    modelDrawn = performance.now();
    app.viewport.afterRender.delete(watch);
  };
  app.viewport.afterRender.add(watch);
  return {
    app,
    get modelDrawn() {
      return modelDrawn;
    },
    idle: () => waitUntilIdle(app),
    drawnMatrix: (name) => view(name)?.worldFromAssembled.toArray() ?? [],
    drawn: (name) => view(name)?.visible ?? false,
    visiblePoint(name) {
      const { rig, canvas } = app.viewport;
      const bounds = view(name)?.bounds();
      if (!bounds) return null;
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
        rig.project(
          new Vector3(
            k & 1 ? bounds.max.x : bounds.min.x,
            k & 2 ? bounds.max.y : bounds.min.y,
            k & 4 ? bounds.max.z : bounds.min.z,
          ),
        ),
      );
      const xs = corners.map(({ x }) => Math.min(Math.max(x, 0), rig.size.x));
      const ys = corners.map(({ y }) => Math.min(Math.max(y, 0), rig.size.y));
      const isShown = (x: number, y: number) => {
        const there = onPage(x, y);
        return nameAt(x, y) === name && document.elementFromPoint(there.x, there.y) === canvas;
      };
      const sample = (values: number[], k: number) =>
        Math.min(...values) + ((k + 0.5) / kGridSize) * (Math.max(...values) - Math.min(...values));
      const order = Array.from({ length: kGridSize }, (_, k) => k).sort(
        (a, b) => Math.abs(a - kGridSize / 2) - Math.abs(b - kGridSize / 2),
      );
      for (const i of order)
        for (const j of order) if (isShown(sample(xs, i), sample(ys, j))) return onPage(sample(xs, i), sample(ys, j));
      return null;
    },
    project(point) {
      const position = app.viewport.rig.project(new Vector3(...point));
      return onPage(position.x, position.y);
    },
    imageData() {
      const { canvas } = app.viewport;
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext("2d")!;
      context.drawImage(canvas, 0, 0);
      return context.getImageData(0, 0, copy.width, copy.height);
    },
    at(x, y) {
      const origin = onPage(0, 0);
      return nameAt(x - origin.x, y - origin.y);
    },
  };
}

async function waitUntilIdle(app: TestedPage): Promise<void> {
  const limit = performance.now() + kMaxWait;
  const unsettled = () =>
    Object.entries({
      "a command or an action": !app.session.settled,
      "a frame of the view": !app.viewport.settled,
      "the connection": app.session.store.link !== "open",
      "the target of a drag": app.drag.pending,
    }).flatMap(([what, pending]) => (pending ? [what] : []));
  for (let calm = 0; calm < 3; ) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
    const pending = unsettled();
    calm = pending.length === 0 ? calm + 1 : 0;
    if (performance.now() > limit) throw new Error(`the page is not idle: ${pending.join(", ") || "frames take long"}`);
  }
}
