// SPDX-License-Identifier: Apache-2.0
import { CanvasTexture, SRGBColorSpace } from "three";

/// Style of a label on a square of `size` pixels.
export interface LabelStyle {
  size: number;
  color: string;
  /// CSS font without the family.
  font: string;
  /// Paints the background; the origin is the square's centre.
  background: (context: CanvasRenderingContext2D) => void;
  /// Rotation of the label [rad].
  turn?: number;
}

/// A square texture with a centred label.
export function labelTexture(label: string, { size, color, font, background, turn = 0 }: LabelStyle): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const context = canvas.getContext("2d")!;
  context.translate(size / 2, size / 2);
  background(context);
  context.rotate(turn);
  context.fillStyle = color;
  context.font = `${font} system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(label, 0, 2);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
