// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { type Axis, kAxes, kAxisNames } from "../axes.ts";
import { button, element } from "../dom.ts";
import type { Session } from "../session.ts";
import type { SectionPlane } from "../store.ts";
import { text } from "../strings.ts";

/// Up to three section planes, one normal to each axis.
export class SectionPanel {
  readonly node = element("section", {
    id: "section-panel",
    class: "floating",
    "aria-label": text("section"),
    hidden: true,
  });
  private readonly rows = kAxes.map((axis) => this.makeRow(axis));
  private open = false;

  constructor(private readonly session: Session) {
    this.node.append(...this.rows.map(({ row }) => row));
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    this.open = !this.open;
    const { model } = this.session.store;
    this.set(this.open && model ? [{ axis: 1, flipped: false, fraction: 0.5 }] : []);
    if (this.open) this.rows[1].slider.focus();
  }

  private makeRow(axis: Axis) {
    const name = kAxisNames[axis];
    const on = element("input", {
      type: "checkbox",
      id: `section-${axis}`,
      "aria-label": text("section.axis", { axis: name }),
    });
    const slider = element("input", {
      type: "range",
      min: "0",
      max: "1",
      step: "0.002",
      value: "0.5",
      "aria-label": text("section.position", { axis: name }),
    });
    const flip = button({
      icon: "redo",
      label: text("section.flip"),
      press: () =>
        this.edit(axis, (plane) => {
          plane.flipped = !plane.flipped;
        }),
    });
    on.onchange = () => {
      const others = this.session.store.planes.filter((plane) => plane.axis !== axis);
      this.set(on.checked ? [...others, { axis, flipped: false, fraction: Number(slider.value) }] : others);
    };
    slider.oninput = () =>
      this.edit(axis, (plane) => {
        plane.fraction = Number(slider.value);
      });
    const row = element(
      "div",
      { class: "section-row" },
      element("label", {}, on, element("span", {}, name)),
      slider,
      flip,
    );
    return { row, on, slider, flip };
  }

  private edit(axis: number, change: (plane: SectionPlane) => void): void {
    const planes = this.session.store.planes.map((plane) => ({ ...plane }));
    for (const plane of planes) if (plane.axis === axis) change(plane);
    this.set(planes);
  }

  private set(planes: SectionPlane[]): void {
    this.session.change(() => {
      this.session.store.planes = planes;
    });
    const { min, max } = this.session.modelBox;
    this.session.viewport.setPlanes(
      planes.map(({ axis, flipped, fraction }) => {
        const [low, high] = [min.getComponent(axis), max.getComponent(axis)];
        const at = low + fraction * (high - low);
        const normal = new Vector3().setComponent(axis, flipped ? -1 : 1);
        return { normal, constant: flipped ? at : -at };
      }),
    );
  }

  private update(): void {
    const { planes } = this.session.store;
    if (planes.length === 0 && !this.rows.some(({ on }) => on === document.activeElement)) this.open = false;
    this.node.hidden = !this.open;
    this.rows.forEach(({ on, slider, flip }, axis) => {
      const plane = planes.find((candidate) => candidate.axis === axis);
      on.checked = plane !== undefined;
      slider.disabled = flip.disabled = plane === undefined;
      if (plane) slider.value = String(plane.fraction);
    });
  }
}
