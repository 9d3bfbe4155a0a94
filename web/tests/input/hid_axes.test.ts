// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { axisFields, type HidAxes, type HidCollection, readAxes } from "../../src/input/hid_axes.ts";
import { kSpaceMouse } from "../support/space_mouse.ts";

const kRest: HidAxes = [0, 0, 0, 0, 0, 0];
const usages = (from: number, count: number) => Array.from({ length: count }, (_, i) => 0x00010030 + from + i);

/// Descriptor of the SpaceNavigator: three 16-bit axes each in reports 1 and 2, buttons in report 3.
const kTwoReports: HidCollection[] = [
  {
    usagePage: 1,
    usage: 8,
    children: [
      {
        inputReports: [
          {
            reportId: 1,
            items: [
              { usages: usages(0, 3), reportSize: 16, reportCount: 3, logicalMinimum: -350, logicalMaximum: 350 },
            ],
          },
        ],
      },
      {
        inputReports: [
          {
            reportId: 2,
            items: [
              { usages: usages(3, 3), reportSize: 16, reportCount: 3, logicalMinimum: -350, logicalMaximum: 350 },
            ],
          },
        ],
      },
    ],
    inputReports: [
      {
        reportId: 3,
        items: [
          {
            isRange: true,
            usageMinimum: 0x00090001,
            usageMaximum: 0x00090002,
            reportSize: 1,
            reportCount: 2,
            logicalMaximum: 1,
          },
          { isConstant: true, usages: [], reportSize: 1, reportCount: 14 },
        ],
      },
    ],
  },
];

function report(...values: number[]): DataView {
  const view = new DataView(new ArrayBuffer(2 * values.length));
  values.forEach((value, i) => {
    view.setInt16(2 * i, value, true);
  });
  return view;
}

test("axes in two reports are found, and each report updates its own", () => {
  const fields = axisFields(kTwoReports);
  assert.equal(fields.length, 6);
  const moved = readAxes(fields, 1, report(350, -175, 0), kRest);
  assert.deepEqual(moved, [1, -0.5, 0, 0, 0, 0]);
  assert.deepEqual(readAxes(fields, 2, report(0, 0, 70), moved), [1, -0.5, 0, 0, 0, 0.2]);
});

test("all axes in one report are found", () => {
  const fields = axisFields(kSpaceMouse);
  assert.deepEqual(
    fields.map(({ axis, begin }) => [axis, begin]),
    [0, 1, 2, 3, 4, 5].map((axis) => [axis, 16 * axis]),
  );
  assert.deepEqual(readAxes(fields, 1, report(0, 0, 35, 0, -35, 0), kRest), [0, 0, 0.1, 0, -0.1, 0]);
});

test("axes that begin within a byte, after padding, are decoded", () => {
  const items = [
    { isConstant: true, usages: [], reportSize: 3, reportCount: 1 },
    { usages: usages(2, 1), reportSize: 10, reportCount: 1, logicalMinimum: -512, logicalMaximum: 511 },
  ];
  const fields = axisFields([{ inputReports: [{ reportId: 0, items }] }]);
  const bits = (0b1000000000 << 3) | 0b111;
  assert.equal(readAxes(fields, 0, new DataView(Uint8Array.of(bits & 255, bits >> 8).buffer), kRest)[2], -1);
});

test("short reports and reports with another id are ignored", () => {
  const fields = axisFields(kSpaceMouse);
  assert.deepEqual(readAxes(fields, 1, report(), kRest), kRest);
  assert.deepEqual(readAxes(fields, 9, report(350, 0, 0, 0, 0, 0), kRest), kRest);
});
