// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { type LinearColor, partColors } from "../../src/scene/part_colors.ts";

const grey: LinearColor = [0.44799, 0.44799, 0.47725, 1];
const red: LinearColor = [0.8, 0.1, 0.1, 1];

test("components without colours get those of a palette", () => {
  const colors = partColors(Array.from({ length: 12 }, () => grey));
  assert.equal(new Set(colors.map(String)).size, 10);
  assert.deepEqual(colors[10], colors[0]);
});

test("colours of the file are kept", () => {
  assert.deepEqual(partColors([grey, red]), [grey, red]);
  assert.deepEqual(partColors([grey]), [grey]);
  assert.deepEqual(partColors([]), []);
});
