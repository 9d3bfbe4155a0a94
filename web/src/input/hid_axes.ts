// SPDX-License-Identifier: Apache-2.0
// The axes of a 3D mouse, found in its report descriptor. (The browser reads the descriptor's items; where a field lies in
// a report, and what its numbers mean, follows from them.)

/// The part of WebHID's description of a device that matters here.
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

export interface HidCollection {
  usagePage?: number;
  usage?: number;
  children?: HidCollection[];
  inputReports?: { reportId?: number; items?: HidItem[] }[];
}

/// X, Y, Z, Rx, Ry, Rz of the device, each from -1 to 1.
export type HidAxes = [number, number, number, number, number, number];

export interface HidField {
  report: number;
  axis: number;
  /// Where it begins in the report's bytes, which do not count the report's id [bit].
  begin: number;
  size: number;
  minimum: number;
  maximum: number;
}

/// Generic desktop page, X; Y to Rz follow it.
const kUsageX = 0x00010030;

/// Where a device's reports hold its six axes; other fields are passed over.
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

/// The usage of an item's field: the last one stands for all that follow it.
function usageAt({ isRange, usages = [], usageMinimum = 0, usageMaximum = 0 }: HidItem, index: number): number {
  if (isRange) return Math.min(usageMinimum + index, usageMaximum);
  return usages[Math.min(index, usages.length - 1)] ?? 0;
}

/// The axes after a report; those that it does not hold stay.
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
