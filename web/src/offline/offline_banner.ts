// SPDX-License-Identifier: Apache-2.0
import { Banner, type Notice } from "../panels/banner.ts";
import { text } from "../strings.ts";

/// The banner where there is no engine: nothing stops anything, and what plays is all there is.
export class OfflineBanner extends Banner {
  protected override notices(): Notice[] {
    return super
      .notices()
      .filter(({ key }) => key !== "playback")
      .map((notice) =>
        ["isolated", "hidden"].includes(notice.key) ? { ...notice, words: text("offline.hidden") } : notice,
      );
  }
}
