// SPDX-License-Identifier: Apache-2.0
import type { Viewport } from "./viewport.ts";

const kFramesPerSecond = 30;
const kBitsPerSecond = 8_000_000;
/// Number of times that the last image is repeated, and the interval [ms].
const kFinalFrames = 5;
const kFinalFrameInterval = 100;
/// Best quality at edges first.
const kFormats = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

/// The MIME type in which this browser can record video; undefined: none.
export function videoFormat(): string | undefined {
  return typeof MediaRecorder === "undefined"
    ? undefined
    : kFormats.find((type) => MediaRecorder.isTypeSupported(type));
}

/// Records the viewport, with the theme's background, as a video.
export class VideoRecorder {
  private readonly canvas = document.createElement("canvas");
  private readonly recorder: MediaRecorder;
  private readonly pieces: Blob[] = [];
  private readonly captureFrame = () => this.viewport.copyImage(this.canvas);

  /// @pre videoFormat() is not undefined
  constructor(private readonly viewport: Viewport) {
    this.captureFrame();
    const stream = this.canvas.captureStream(kFramesPerSecond);
    this.recorder = new MediaRecorder(stream, { mimeType: videoFormat(), videoBitsPerSecond: kBitsPerSecond });
    this.recorder.ondataavailable = ({ data }) => this.pieces.push(data);
    viewport.afterRender.add(this.captureFrame);
    this.recorder.start();
  }

  /// Ends the recording. Resolves with the video.
  async stop(): Promise<Blob> {
    // Holds the last image, and gives slow browsers at least one frame.
    for (let k = 0; k < kFinalFrames; ++k) {
      this.captureFrame();
      await new Promise((resolve) => setTimeout(resolve, kFinalFrameInterval));
    }
    const stopped = new Promise((resolve) => {
      this.recorder.onstop = resolve;
    });
    this.recorder.stop();
    await stopped;
    this.viewport.afterRender.delete(this.captureFrame);
    return new Blob(this.pieces, { type: this.recorder.mimeType });
  }
}
