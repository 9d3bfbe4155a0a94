// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import type { App } from "./app.ts";
import type { Drag } from "./input/drag.ts";
import type { Viewport } from "./scene/viewport.ts";
import type { Session } from "./session.ts";
import type { Triple } from "./wire/messages.ts";

/// A page that tests look at.
interface Tested {
  readonly viewport: Viewport;
  readonly session: Session;
  readonly drag: Drag;
}

/// What tests ask of the page instead of waiting for some time and hoping. It looks, and changes nothing.
export interface TestDoor<Page extends Tested = App> {
  /// When everything asked is answered, shown and drawn.
  idle(): Promise<void>;
  /// Where the component called `name` is drawn: the matrix from its assembled position, by columns.
  drawnMatrix(name: string): number[];
  drawn(name: string): boolean;
  /// A place in the view where the component is in front, with no panel over it; or null.
  placeOf(name: string): { x: number; y: number } | null;
  project(point: Triple): { x: number; y: number };
  /// What is in front at a place on screen.
  at(x: number, y: number): string | null;
  readonly app: Page;
  /// When the first model was drawn, from the page's beginning [ms]; null: not yet.
  readonly modelDrawn: number | null;
}

const kGrid = 60;

export function testDoor<Page extends Tested>(app: Page): TestDoor<Page> {
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
    app.viewport.afterPicture.delete(watch);
  };
  app.viewport.afterPicture.add(watch);
  return {
    app,
    get modelDrawn() {
      return modelDrawn;
    },
    idle: () => waitUntilIdle(app),
    drawnMatrix: (name) => view(name)?.worldFromAssembled.toArray() ?? [],
    drawn: (name) => view(name)?.visible ?? false,
    placeOf(name) {
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
      const place = (values: number[], k: number) =>
        Math.min(...values) + ((k + 0.5) / kGrid) * (Math.max(...values) - Math.min(...values));
      const order = Array.from({ length: kGrid }, (_, k) => k).sort(
        (a, b) => Math.abs(a - kGrid / 2) - Math.abs(b - kGrid / 2),
      );
      for (const i of order)
        for (const j of order) if (isShown(place(xs, i), place(ys, j))) return onPage(place(xs, i), place(ys, j));
      return null;
    },
    project(point) {
      const place = app.viewport.rig.project(new Vector3(...point));
      return onPage(place.x, place.y);
    },
    at(x, y) {
      const origin = onPage(0, 0);
      return nameAt(x - origin.x, y - origin.y);
    },
  };
}

async function waitUntilIdle(app: Tested): Promise<void> {
  const settled = () =>
    app.session.settled && app.viewport.settled && app.session.store.link === "open" && !app.drag.waits;
  for (let calm = 0; calm < 3; ) {
    await new Promise((resolve) => requestAnimationFrame(resolve));
    calm = settled() ? calm + 1 : 0;
  }
}
