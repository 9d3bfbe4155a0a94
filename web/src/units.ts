// SPDX-License-Identifier: Apache-2.0
// Lengths as text, in the unit that the user has chosen. The server's lengths are millimetres.

/// Units in which lengths can be shown.
export type LengthUnit = "mm" | "in";

const kStorageKey = "dismantle.unit";
const kMillimetresPerInch = 25.4;

let unit: LengthUnit = storedUnit();

/// The unit in which lengths are shown.
export function shownUnit(): LengthUnit {
  return unit;
}

/// Changes the unit in which lengths are shown; kept for the next visit.
export function showUnit(chosen: LengthUnit): void {
  unit = chosen;
  try {
    localStorage.setItem(kStorageKey, chosen);
  } catch {
    // An exported page that is opened as a file may have no storage.
  }
}

/// A length in the shown unit.
export function toShown(millimetres: number): number {
  return unit === "in" ? millimetres / kMillimetresPerInch : millimetres;
}

/// The millimetres of a length in a unit; by default the shown one.
export function fromShown(length: number, of = unit): number {
  return of === "in" ? length * kMillimetresPerInch : length;
}

/// A length as text: about three significant digits, in millimetres or micrometres, or in inches.
export function lengthText(millimetres: number): string {
  const length = toShown(Math.abs(millimetres));
  if (length === 0) return `0 ${unit}`;
  const sign = millimetres < 0 ? "−" : "";
  if (unit === "in") return `${sign}${inchText(length)} in`;
  if (length < 0.1) return `${sign}${(length * 1000).toFixed(length < 0.01 ? 1 : 0)} µm`;
  return `${sign}${length.toFixed(length < 10 ? 2 : length < 100 ? 1 : 0)} mm`;
}

/// A coordinate as text in the shown unit, without the unit: 0.01 mm or 0.0005 in are seen.
export function coordinateText(millimetres: number): string {
  const text = toShown(millimetres).toFixed(unit === "in" ? 4 : 2);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/// The size of an assembly as text: three significant digits, in metres above 1 m, or in inches.
export function sizeText(millimetres: number): string {
  if (millimetres < 1000 || unit === "in") return lengthText(millimetres);
  return `${Number((millimetres / 1000).toPrecision(3))} m`;
}

/// The sides of a box as text, with the unit: "12.0 × 8.5 × 3.0 mm".
export function boxText(sides: number[]): string {
  const digits = unit === "in" ? 3 : 1;
  return `${sides.map((side) => toShown(side).toFixed(digits)).join(" × ")} ${unit}`;
}

function inchText(inches: number): string {
  if (inches < 0.001) return Number(inches.toPrecision(2)).toFixed(6).replace(/0+$/, "");
  return inches.toFixed(inches < 1 ? 4 : inches < 100 ? 3 : 1);
}

function storedUnit(): LengthUnit {
  try {
    return globalThis.localStorage?.getItem(kStorageKey) === "in" ? "in" : "mm";
  } catch {
    return "mm";
  }
}
