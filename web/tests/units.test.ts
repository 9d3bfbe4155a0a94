// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { groupedNamesText } from "../src/names.ts";
import { directionText } from "../src/strings.ts";
import { boxText, coordinateText, fromShown, lengthText, showUnit, sizeText, toShown } from "../src/units.ts";
import type { ModelEvent } from "../src/wire/messages.ts";

afterEach(() => showUnit("mm"));

test("millimetres have about three digits, and small lengths are micrometres", () => {
  assert.equal(lengthText(0), "0 mm");
  assert.equal(lengthText(0.0042), "4.2 µm");
  assert.equal(lengthText(-1.234), "−1.23 mm");
  assert.equal(lengthText(250.4), "250 mm");
  assert.equal(sizeText(743_384), "743 m");
});

test("inches are shown as numbers with the unit", () => {
  showUnit("in");
  assert.equal(lengthText(25.4), "1.000 in");
  assert.equal(lengthText(0.0127), "0.0005 in");
  assert.equal(lengthText(2540), "100.0 in");
  assert.equal(lengthText(0), "0 in");
  assert.equal(boxText([25.4, 50.8, 12.7]), "1.000 × 2.000 × 0.500 in");
  assert.ok(Math.abs(toShown(fromShown(3)) - 3) < 1e-12);
});

test("coordinates have a real minus, and zero has none", () => {
  assert.equal(coordinateText(-12.345), "−12.35");
  assert.equal(coordinateText(-0.0001), "0.00");
});

test("directions are named by the nearest axes", () => {
  assert.equal(directionText([0, 0, -1]), "−Z");
  assert.equal(directionText([0.0902, -0.9941, 0.0602]), "near −Y (6° off)");
  assert.equal(directionText([Math.SQRT1_2, 0, -Math.SQRT1_2]), "between +X and −Z");
});

test("equal components are counted in lists of names", () => {
  const names = ["foot", "foot#2", "base", "screw M3", "screw M3#2", "lid"];
  const shapes = [0, 0, 2, 3, 3, 5];
  const components = names.map((name, i) => ({ name, shape: shapes[i] }));
  const model = { components } as unknown as ModelEvent;
  assert.equal(groupedNamesText(model, [2]), "base");
  assert.equal(groupedNamesText(model, [0, 1, 2]), "2 × foot and base");
  assert.equal(groupedNamesText(model, [0, 2, 3, 4, 5, 1]), "2 × foot, base, 2 × screw M3 and 1 more");
});
