// SPDX-License-Identifier: Apache-2.0
import { element, linkButton } from "../dom.ts";
import type { Session } from "../session.ts";

/// A list row for a component: its name, which selects it, and a badge of the given CSS class.
export function componentRow(session: Session, component: number, badge: string, badgeClass: string): HTMLElement {
  const name = linkButton(session.nameOf(component), () => session.select([component]));
  return element("li", {}, name, element("span", { class: `badge ${badgeClass}` }, badge));
}
