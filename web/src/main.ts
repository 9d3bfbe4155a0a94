// SPDX-License-Identifier: Apache-2.0
import { App } from "./app.ts";
import { element } from "./dom.ts";
import { text } from "./strings.ts";
import { type TestDoor, testDoor } from "./test_door.ts";

declare global {
  interface Window {
    dismantle?: TestDoor;
  }
}

/// "" for tests; "pictures" with smooth edges, for those in the user's guide.
const test = new URLSearchParams(location.search).get("test");
const testing = test !== null;

/// After the first paint: a context for drawing can take the browser a second.
function start(): void {
  try {
    const app = new App({ testing, smooth: !testing || test === "pictures" });
    document.getElementById("boot")?.remove();
    if (testing) window.dismantle = testDoor(app);
  } catch (error) {
    document.body.replaceChildren(element("p", { class: "fatal", role: "alert" }, text("noWebGl")));
    throw error;
  }
}

requestAnimationFrame(() => setTimeout(start));
