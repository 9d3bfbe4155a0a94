// SPDX-License-Identifier: Apache-2.0
import { text } from "./strings.ts";
import type { ModelEvent } from "./wire/messages.ts";

/// Lists of names are cut off after this many.
export const kMaxNames = 3;

/// The first `max` names, and the number of the others.
export function namesText(model: ModelEvent | null, components: number[], max = kMaxNames): string {
  const names = components
    .slice(0, max)
    .map((c) => model?.components[c]?.name ?? "")
    .join(", ");
  return components.length > max ? text("names.more", { names, count: components.length - max }) : names;
}

/// Names in which components of equal shape are counted: "4 × foot and base". The first `max` shapes, and the number of
/// the other components.
export function groupedNamesText(model: ModelEvent | null, components: number[], max = kMaxNames): string {
  const groups = new Map<number, number[]>();
  for (const c of components) {
    const shape = model?.components[c]?.shape ?? c;
    groups.set(shape, [...(groups.get(shape) ?? []), c]);
  }
  const all = [...groups.values()];
  const names = all.slice(0, max).map((group) => {
    const name = model?.components[group[0]]?.name ?? "";
    return group.length === 1 ? name : text("names.counted", { count: group.length, name: name.replace(/#\d+$/, "") });
  });
  const rest = all.slice(max).flat().length;
  if (rest > 0) return text("names.more", { names: names.join(", "), count: rest });
  if (names.length < 2) return names.join();
  return text("names.and", { names: names.slice(0, -1).join(", "), last: names[names.length - 1] });
}
