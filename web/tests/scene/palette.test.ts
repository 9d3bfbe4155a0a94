// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kPalettes, type Palette } from "../../src/scene/palette.ts";

type Rgb = [number, number, number];

/// Simulation of dichromacy on linear RGB (Machado, Oliveira and Fernandes, 2009).
const kVisions: Record<string, number[][]> = {
  ordinary: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};
/// Colours that are shown side by side with different meanings, and their minimum distance in CIELAB.
const kPairs: [keyof Palette, keyof Palette][] = [
  ["blocking", "selection"],
  ["blocking", "ghost"],
  ["blocking", "free"],
  ["blocking", "next"],
  ["contact", "selection"],
  ["contact", "ghost"],
  ["contact", "free"],
  ["contact", "next"],
];
const kFarApart = 20;

const linear = (hex: string): Rgb =>
  [1, 3, 5].map((at) => {
    const value = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  }) as Rgb;

/// CIELAB of a linear colour, white point D65.
function lab(rgb: Rgb): Rgb {
  const xyz = [
    [0.4124564, 0.3575761, 0.1804375, 0.95047],
    [0.2126729, 0.7151522, 0.072175, 1],
    [0.0193339, 0.119192, 0.9503041, 1.08883],
  ].map(([r, g, b, white]) => Math.max(0, r * rgb[0] + g * rgb[1] + b * rgb[2]) / white);
  const [x, y, z] = xyz.map((t) => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

for (const [vision, matrix] of Object.entries(kVisions))
  test(`colours of different meaning differ for ${vision} vision`, () => {
    const seen = (hex: string): Rgb => {
      const rgb = linear(hex);
      return lab(matrix.map((row) => row.reduce((sum, value, k) => sum + value * rgb[k], 0)) as Rgb);
    };
    for (const [theme, palette] of Object.entries(kPalettes))
      for (const [one, other] of kPairs) {
        const [a, b] = [seen(palette[one] as string), seen(palette[other] as string)];
        const apart = Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        assert.ok(apart > kFarApart, `${theme}: ${one} and ${other} are ${apart.toFixed(1)} apart`);
      }
  });
