// SPDX-License-Identifier: Apache-2.0
import { App } from "./app.ts";
import { element } from "./dom.ts";
import { OfflineApp } from "./offline/offline_app.ts";
import { isOffline, readFilm } from "./offline/read_film.ts";
import { text } from "./strings.ts";
import { type TestDoor, testDoor } from "./test_door.ts";

declare global {
  interface Window {
    dismantle?: TestDoor;
    /// Of a page that was exported.
    dismantleOffline?: TestDoor<OfflineApp>;
  }
}

/// "" for tests; "pictures" with smooth edges, for those in the user's guide.
const test = new URLSearchParams(location.search).get("test");
const testing = test !== null;

/// After the first paint: a context for drawing can take the browser a second.
async function start(): Promise<void> {
  try {
    const options = { testing, smooth: !testing || test === "pictures" };
    if (isOffline()) {
      const app = new OfflineApp(options, await readFilm());
      if (testing) window.dismantleOffline = testDoor(app);
    } else {
      const app = new App(options);
      if (testing) window.dismantle = testDoor(app);
    }
    document.getElementById("boot")?.remove();
  } catch (error) {
    document.body.replaceChildren(element("p", { class: "fatal", role: "alert" }, text("noWebGl")));
    throw error;
  }
}

requestAnimationFrame(() => setTimeout(() => void start()));
