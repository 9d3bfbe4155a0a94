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

const testing = new URLSearchParams(location.search).has("test");
try {
  const app = new App(testing);
  if (testing) window.dismantle = testDoor(app);
} catch (error) {
  document.body.replaceChildren(element("p", { class: "fatal", role: "alert" }, text("noWebGl")));
  throw error;
}
