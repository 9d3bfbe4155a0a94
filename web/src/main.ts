// SPDX-License-Identifier: Apache-2.0
import { App } from "./app.ts";
import { element } from "./dom.ts";
import { OfflineApp } from "./offline/offline_app.ts";
import { isOffline, readOfflineContent } from "./offline/offline_content.ts";
import { text } from "./strings.ts";
import { type TestApi, testApi } from "./test_api.ts";

declare global {
  interface Window {
    dismantle?: TestApi;
    /// Present on an exported page.
    dismantleOffline?: TestApi<OfflineApp>;
  }
}

/// "" for tests; "pictures" for the guide's pictures, with antialiasing.
const test = new URLSearchParams(location.search).get("test");
const testing = test !== null;

/// Runs after the first paint: creating a WebGL context can take a second.
async function start(): Promise<void> {
  try {
    const options = { testing, smooth: !testing || test === "pictures" };
    if (isOffline()) {
      const app = new OfflineApp(options, await readOfflineContent());
      if (testing) window.dismantleOffline = testApi(app);
    } else {
      const app = new App(options);
      if (testing) window.dismantle = testApi(app);
    }
    document.getElementById("boot")?.remove();
  } catch (error) {
    document.body.replaceChildren(element("p", { class: "fatal", role: "alert" }, text("noWebGl")));
    throw error;
  }
}

requestAnimationFrame(() => setTimeout(() => void start()));
