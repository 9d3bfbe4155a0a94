// SPDX-License-Identifier: Apache-2.0

/// A box of six faces, as an OBJ file.
export function box(lower: number[], upper: number[]): string {
  const corner = (k: number) => [0, 1, 2].map((axis) => (k & (1 << axis) ? upper[axis] : lower[axis])).join(" ");
  return `${[0, 1, 2, 3, 4, 5, 6, 7].map((k) => `v ${corner(k)}`).join("\n")}
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
`;
}
