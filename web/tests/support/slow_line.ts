// SPDX-License-Identifier: Apache-2.0
import type { Page } from "playwright-core";

/// A line between the server and a page: what matches arrives so much later [ms], and all after it in its order.
export async function slowLine(page: Page, matches: RegExp, delay: number): Promise<void> {
  await page.routeWebSocket(/\/session\?/, (socket) => {
    let arrived = Promise.resolve();
    const server = socket.connectToServer();
    server.onMessage((message) => {
      const lags = typeof message === "string" && matches.test(message);
      arrived = arrived.then(async () => {
        if (lags) await new Promise((resolve) => setTimeout(resolve, delay));
        socket.send(message);
      });
    });
  });
}
