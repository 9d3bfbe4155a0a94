// SPDX-License-Identifier: Apache-2.0
import { CanvasTexture, SRGBColorSpace } from "three";

/// What a word is drawn with, on a square of `size` pixels.
export interface WordStyle {
  size: number;
  color: string;
  /// Of CSS, without the family.
  font: string;
  /// Paints what is behind the word; the origin is the square's middle.
  ground: (brush: CanvasRenderingContext2D) => void;
  /// Of the word [rad].
  turn?: number;
}

/// A square picture of a word in its middle.
export function wordTexture(word: string, { size, color, font, ground, turn = 0 }: WordStyle): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const brush = canvas.getContext("2d")!;
  brush.translate(size / 2, size / 2);
  ground(brush);
  brush.rotate(turn);
  brush.fillStyle = color;
  brush.font = `${font} system-ui, sans-serif`;
  brush.textAlign = "center";
  brush.textBaseline = "middle";
  brush.fillText(word, 0, 2);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
