// SPDX-License-Identifier: Apache-2.0
import type { HidCollection } from "../../src/input/hid_axes.ts";

/// Descriptor of the SpaceMouse Wireless: all six axes in report 1, 16 bits each.
export const kSpaceMouse: HidCollection[] = [
  {
    usagePage: 1,
    usage: 8,
    inputReports: [
      {
        reportId: 1,
        items: [
          {
            isRange: true,
            usageMinimum: 0x00010030,
            usageMaximum: 0x00010035,
            reportSize: 16,
            reportCount: 6,
            logicalMinimum: -350,
            logicalMaximum: 350,
          },
        ],
      },
    ],
  },
];
