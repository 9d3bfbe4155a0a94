// SPDX-License-Identifier: Apache-2.0
import type { Page } from "playwright-core";

/// Delays the server's matching messages, and all after them [ms].
export async function slowConnection(page: Page, matches: RegExp, delay: number): Promise<void> {
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
