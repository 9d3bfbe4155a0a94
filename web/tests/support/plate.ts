// SPDX-License-Identifier: Apache-2.0

/// A plate from the origin, with round holes through it along z.
interface Plate {
  sides: [number, number, number];
  /// Centres of the holes.
  holes: [number, number][];
  diameter: number;
}

/// Sides of the polygon of a hole; a multiple of 4.
const kSides = 48;

/// The plate as an OBJ file. Each hole is in the middle of a square of its own; the squares are side by side along x, as
/// high as the plate.
export function holedPlate({ sides: [length, width, height], holes, diameter }: Plate): string {
  const lines: string[] = ["o plate"];
  let count = 0;
  const vertex = (x: number, y: number, z: number): number => {
    // Without -0, which would not be the same point as 0.
    const [a, b] = [x, y].map((value) => Math.round(1e6 * value) / 1e6 + 0);
    lines.push(`v ${a} ${b} ${z}`);
    return ++count;
  };
  const quad = (a: number, b: number, c: number, d: number) => lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
  const cell = length / holes.length;
  holes.forEach(([cx, cy], i) => {
    const [left, right] = [i * cell, (i + 1) * cell];
    // Points of the hole, and for each the point of the cell's rim in its direction.
    const ring = Array.from({ length: kSides }, (_, k) => (2 * Math.PI * (k + 0.5)) / kSides).map((angle) => {
      const [dx, dy] = [Math.cos(angle), Math.sin(angle)];
      const [toX, toY] = [dx > 0 ? right - cx : left - cx, dy > 0 ? width - cy : -cy];
      const reach = Math.min(toX / dx, toY / dy);
      const hole = [cx + (diameter / 2) * dx, cy + (diameter / 2) * dy] as const;
      return { hole, rim: [cx + reach * dx, cy + reach * dy] as const };
    });
    const layer = (z: number) => ring.map(({ hole, rim }) => ({ hole: vertex(...hole, z), rim: vertex(...rim, z) }));
    const [low, high] = [layer(0), layer(height)];
    const corners = (z: number) =>
      [
        [right, width],
        [left, width],
        [left, 0],
        [right, 0],
      ].map(([x, y]) => vertex(x, y, z));
    const [lowCorners, highCorners] = [corners(0), corners(height)];
    ring.forEach((point, k) => {
      const n = (k + 1) % kSides;
      quad(high[k].hole, high[k].rim, high[n].rim, high[n].hole);
      quad(low[k].rim, low[k].hole, low[n].hole, low[n].rim);
      quad(low[k].hole, high[k].hole, high[n].hole, low[n].hole);
      const next = ring[n];
      const turnsCorner = [0, 1].every((k) => Math.abs(point.rim[k] - next.rim[k]) > 1e-9);
      if (turnsCorner) {
        const c = Math.floor((4 * (k + 0.5)) / kSides);
        lines.push(
          `f ${high[k].rim} ${highCorners[c]} ${high[n].rim}`,
          `f ${low[k].rim} ${low[n].rim} ${lowCorners[c]}`,
        );
        sideWall(k, lowCorners[c], highCorners[c], point.rim[0]);
        sideWall(n, lowCorners[c], highCorners[c], next.rim[0], true);
      } else if (Math.abs(point.rim[0] - next.rim[0]) > 1e-9 || isOuter(point.rim[0])) {
        quad(low[n].rim, high[n].rim, high[k].rim, low[k].rim);
      }
    });
    function isOuter(x: number): boolean {
      return Math.abs(x) < 1e-9 || Math.abs(x - length) < 1e-9;
    }
    /// The wall between a point of the rim and a corner; there is none between two cells.
    function sideWall(k: number, lowCorner: number, highCorner: number, x: number, after = false): void {
      const isEnd = Math.abs(x - left) < 1e-9 || Math.abs(x - right) < 1e-9;
      if (isEnd && !isOuter(x)) return;
      if (after) quad(low[k].rim, high[k].rim, highCorner, lowCorner);
      else quad(lowCorner, highCorner, high[k].rim, low[k].rim);
    }
  });
  return `${lines.join("\n")}\n`;
}
