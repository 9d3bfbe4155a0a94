// SPDX-License-Identifier: Apache-2.0
import type { Viewport } from "./viewport.ts";

const kFramesPerSecond = 30;
const kBitsPerSecond = 8_000_000;
/// How often the last picture is shown, and for how long each time [ms].
const kLastPictures = 5;
const kLastPicturesEvery = 100;
/// In the order of how well they keep edges.
const kFormats = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

export function videoFormat(): string | undefined {
  return typeof MediaRecorder === "undefined"
    ? undefined
    : kFormats.find((type) => MediaRecorder.isTypeSupported(type));
}

/// Records what the viewport draws, with the background of the theme.
export class FilmRecorder {
  private readonly copy = document.createElement("canvas");
  private readonly recorder: MediaRecorder;
  private readonly pieces: Blob[] = [];
  private readonly take = () => this.viewport.copyPicture(this.copy);

  /// @pre videoFormat() is there
  constructor(private readonly viewport: Viewport) {
    this.take();
    const stream = this.copy.captureStream(kFramesPerSecond);
    this.recorder = new MediaRecorder(stream, { mimeType: videoFormat(), videoBitsPerSecond: kBitsPerSecond });
    this.recorder.ondataavailable = ({ data }) => this.pieces.push(data);
    viewport.afterPicture.add(this.take);
    this.recorder.start();
  }

  async stop(): Promise<Blob> {
    // The last picture stays for a moment; and a browser that is slow to begin has one at all.
    for (let k = 0; k < kLastPictures; ++k) {
      this.take();
      await new Promise((resolve) => setTimeout(resolve, kLastPicturesEvery));
    }
    const stopped = new Promise((resolve) => {
      this.recorder.onstop = resolve;
    });
    this.recorder.stop();
    await stopped;
    this.viewport.afterPicture.delete(this.take);
    return new Blob(this.pieces, { type: this.recorder.mimeType });
  }
}
