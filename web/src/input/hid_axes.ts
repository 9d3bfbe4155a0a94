// SPDX-License-Identifier: Apache-2.0
// The six axes of a 3D mouse, located by its HID report descriptor. The browser parses the descriptor; the position of
// each field in a report, and its range, follow from the items.

/// The members of WebHID's report items that are needed here.
export interface HidItem {
  usages?: number[];
  usageMinimum?: number;
  usageMaximum?: number;
  isRange?: boolean;
  isConstant?: boolean;
  reportSize?: number;
  reportCount?: number;
  logicalMinimum?: number;
  logicalMaximum?: number;
}

/// A collection of a HID report descriptor.
export interface HidCollection {
  usagePage?: number;
  usage?: number;
  children?: HidCollection[];
  inputReports?: { reportId?: number; items?: HidItem[] }[];
}

/// X, Y, Z, Rx, Ry, Rz of the device, each in [-1, 1].
export type HidAxes = [number, number, number, number, number, number];

/// The field of an axis in a report.
export interface HidField {
  report: number;
  axis: number;
  /// First bit in the report's bytes, which exclude the report id.
  begin: number;
  size: number;
  minimum: number;
  maximum: number;
}

/// Generic desktop page, usage X; Y to Rz follow.
const kUsageX = 0x00010030;

/// The fields of a device's six axes; other fields are ignored.
export function axisFields(collections: HidCollection[]): HidField[] {
  const fields: HidField[] = [];
  for (const collection of collections) {
    for (const { reportId = 0, items = [] } of collection.inputReports ?? []) fields.push(...fieldsOf(reportId, items));
    fields.push(...axisFields(collection.children ?? []));
  }
  return fields;
}

function fieldsOf(report: number, items: HidItem[]): HidField[] {
  const fields: HidField[] = [];
  let begin = 0;
  for (const item of items) {
    const { reportSize: size = 0, reportCount: count = 0, logicalMinimum = 0, logicalMaximum = 0 } = item;
    for (let i = 0; i < count; ++i, begin += size) {
      const axis = usageAt(item, i) - kUsageX;
      if (item.isConstant || axis < 0 || axis > 5 || size === 0 || size > 32) continue;
      fields.push({ report, axis, begin, size, minimum: logicalMinimum, maximum: logicalMaximum });
    }
  }
  return fields;
}

/// The usage of an item's i-th field. The last usage covers all further fields.
function usageAt({ isRange, usages = [], usageMinimum = 0, usageMaximum = 0 }: HidItem, index: number): number {
  if (isRange) return Math.min(usageMinimum + index, usageMaximum);
  return usages[Math.min(index, usages.length - 1)] ?? 0;
}

/// The axes after a report. Axes that the report does not contain keep their values.
export function readAxes(fields: HidField[], report: number, bytes: DataView, before: HidAxes): HidAxes {
  const axes: HidAxes = [...before];
  for (const field of fields) {
    if (field.report !== report || field.begin + field.size > 8 * bytes.byteLength) continue;
    const range = Math.max(Math.abs(field.minimum), Math.abs(field.maximum), 1);
    axes[field.axis] = Math.max(-1, Math.min(1, bitsAt(bytes, field) / range));
  }
  return axes;
}

function bitsAt(bytes: DataView, { begin, size, minimum }: HidField): number {
  let value = 0;
  for (let i = 0; i < size; ++i) {
    const bit = (bytes.getUint8((begin + i) >> 3) >> ((begin + i) & 7)) & 1;
    value += bit * 2 ** i;
  }
  return minimum < 0 && value >= 2 ** (size - 1) ? value - 2 ** size : value;
}
