// SPDX-License-Identifier: Apache-2.0
import { Color, SRGBColorSpace } from "three";

/// A colour as in glTF: linear, with opacity.
export type LinearColor = [number, number, number, number];

/// sRGB. The colour of components without one, as the importers set it, and the palette of the work instructions.
const kUncolored = [0.7, 0.7, 0.72] as const;
const kParts = [
  [0.55, 0.67, 0.8],
  [0.86, 0.7, 0.45],
  [0.62, 0.76, 0.58],
  [0.8, 0.56, 0.53],
  [0.72, 0.74, 0.77],
  [0.68, 0.6, 0.78],
  [0.47, 0.7, 0.7],
  [0.88, 0.8, 0.58],
  [0.58, 0.6, 0.66],
  [0.82, 0.65, 0.72],
] as const;
/// Rounding of colours in files.
const kSameColor = 0.003;

const linear = ([r, g, b]: readonly [number, number, number]): LinearColor => {
  const color = new Color().setRGB(r, g, b, SRGBColorSpace);
  return [color.r, color.g, color.b, 1];
};

/// The colours in which components are drawn: their own, or those of a palette where none has a colour of its own.
export function partColors(own: LinearColor[]): LinearColor[] {
  const uncolored = linear(kUncolored);
  const isUncolored = (color: LinearColor) => color.every((value, i) => Math.abs(value - uncolored[i]) < kSameColor);
  if (own.length < 2 || !own.every(isUncolored)) return own;
  const parts = kParts.map(linear);
  return own.map((_, i) => parts[i % parts.length]);
}
