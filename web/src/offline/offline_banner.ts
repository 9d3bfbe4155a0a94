// SPDX-License-Identifier: Apache-2.0
import { Banner, type Notice } from "../panels/banner.ts";
import { text } from "../strings.ts";

/// The banner of an exported page: without an engine, only hidden components need a notice.
export class OfflineBanner extends Banner {
  protected override notices(): Notice[] {
    return super
      .notices()
      .filter(({ key }) => key !== "playback")
      .map((notice) =>
        ["isolated", "hidden"].includes(notice.key) ? { ...notice, message: text("offline.hidden") } : notice,
      );
  }
}
