// SPDX-License-Identifier: Apache-2.0

/// The scene's colours in a theme. Blue, orange and purple of Okabe and Ito's palette, safe for colour-blind users, and
/// never the only cue: blocking components have wider edges, contacts have arrows, ghosts are translucent.
export interface Palette {
  background: [string, string];
  sky: string;
  ground: string;
  edge: string;
  accent: string;
  selection: string;
  blocking: string;
  contact: string;
  ghost: string;
  free: string;
  next: string;
  measure: string;
}

/// The palettes of the two themes.
export const kPalettes: Record<"light" | "dark", Palette> = {
  light: {
    background: ["#f7f8fa", "#dfe4ea"],
    sky: "#ffffff",
    ground: "#9a9fa8",
    edge: "#20262e",
    accent: "#0072b2",
    selection: "#0072b2",
    blocking: "#e06c00",
    contact: "#b8457f",
    ghost: "#2f8fd0",
    free: "#0072b2",
    next: "#7a4fc0",
    measure: "#20262e",
  },
  dark: {
    background: ["#2a3038", "#14181d"],
    sky: "#dfe6ee",
    ground: "#6b7380",
    edge: "#0a0d10",
    accent: "#56b4e9",
    selection: "#56b4e9",
    blocking: "#ff9a2e",
    contact: "#e0559b",
    ghost: "#7cc8f5",
    free: "#56b4e9",
    next: "#b79cff",
    measure: "#f2f5f8",
  },
};
