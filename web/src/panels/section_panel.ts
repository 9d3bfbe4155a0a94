// SPDX-License-Identifier: Apache-2.0
import { type Box3, Vector3 } from "three";
import { type Axis, kAxes, kAxisNames } from "../axes.ts";
import { button, element, panelHeader, setText } from "../dom.ts";
import type { Pick } from "../scene/model_view.ts";
import { faceAt } from "../scene/snap.ts";
import type { Session } from "../session.ts";
import type { SectionPlane } from "../store.ts";
import { text } from "../strings.ts";
import { coordinateText, fromShown, shownUnit, toShown } from "../units.ts";

/// Planes that cut at the same time.
const kMaxPlanes = 3;

/// A row of the panel: a plane normal to an axis, or one by a face.
interface Row {
  axis: Axis | null;
  node: HTMLElement;
  on: HTMLInputElement;
  slider: HTMLInputElement;
  number: HTMLInputElement;
  unit: HTMLElement;
  flip: HTMLButtonElement;
}

/// Up to three section planes: one normal to each axis, and one by a face.
export class SectionPanel {
  readonly node = element("section", {
    id: "section-panel",
    class: "side-panel",
    "aria-label": text("section"),
    hidden: true,
  });
  private readonly rows: Row[] = [...kAxes, null].map((axis) => this.makeRow(axis));
  private readonly faceButton: HTMLButtonElement;
  private readonly hint = element("p", { class: "muted", role: "status" });
  private open = false;
  private shownModel = -1;
  private picking = false;

  constructor(private readonly session: Session) {
    this.faceButton = button({
      icon: "section",
      label: text("section.face"),
      wide: true,
      id: "section-face",
      press: () => this.setPicking(!this.picking),
    });
    this.node.append(
      panelHeader(text("section"), () => this.toggle()),
      ...this.rows.map(({ node }) => node),
      this.faceButton,
      this.hint,
    );
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    this.open = !this.open;
    this.setPicking(false);
    this.set(this.open && this.session.store.model ? [this.planeOf(1)] : []);
    if (this.open) this.rows[1].slider.focus();
  }

  /// Takes a click while a face is to be picked; returns false if none is.
  click(pick: Pick | null): boolean {
    if (!this.picking) return false;
    const model = this.session.viewport.model;
    const found = pick && model ? faceAt(model, pick) : null;
    if (pick && found?.feature.kind !== "plane") {
      this.session.onNote("note", text("section.curved"));
      return true;
    }
    if (found?.feature.kind !== "plane") return true;
    const { point, normal } = found.feature;
    const [x, y, z] = normal.toArray();
    // What is in front of the face is cut away.
    const plane: SectionPlane = { axis: null, normal: [x, y, z], base: point.dot(normal), offset: 0, flipped: true };
    this.setPicking(false);
    this.set([...this.others(null).slice(-(kMaxPlanes - 1)), plane]);
    return true;
  }

  private setPicking(picking: boolean): void {
    this.picking = picking;
    setText(this.hint, picking ? text("section.pick") : "");
    this.faceButton.setAttribute("aria-pressed", String(picking));
  }

  private makeRow(axis: Axis | null): Row {
    const name = axis === null ? text("section.byFace") : kAxisNames[axis];
    const label = text(axis === null ? "section.position.face" : "section.position", { axis: name });
    const on = element("input", {
      type: "checkbox",
      id: `section-${axis ?? "plane"}`,
      "aria-label": axis === null ? name : text("section.axis", { axis: name }),
    });
    const slider = element("input", { type: "range", min: "0", max: "1", step: "0.002", "aria-label": label });
    const number = element("input", { type: "number", step: "any", "aria-label": label });
    const unit = element("span", { class: "muted" });
    const flip = button({
      icon: "redo",
      label: text("section.flip"),
      press: () => this.edit(axis, (plane) => ({ ...plane, flipped: !plane.flipped })),
    });
    on.onchange = () => {
      if (on.checked && axis !== null) this.set([...this.others(axis).slice(-(kMaxPlanes - 1)), this.planeOf(axis)]);
      else this.set(this.others(axis));
    };
    slider.oninput = () =>
      this.edit(axis, (plane) => {
        const [low, high] = this.rangeOf(plane);
        return { ...plane, offset: low + Number(slider.value) * (high - low) };
      });
    number.onchange = () => this.edit(axis, (plane) => ({ ...plane, offset: fromShown(Number(number.value) || 0) }));
    const node = element(
      "div",
      { class: "section-row" },
      element("label", {}, on, element("span", {}, name)),
      slider,
      number,
      unit,
      flip,
    );
    return { axis, node, on, slider, number, unit, flip };
  }

  private planeOf(axis: Axis): SectionPlane {
    const center = this.session.modelBox.getCenter(new Vector3());
    const normal: [number, number, number] = [0, 0, 0];
    normal[axis] = 1;
    return { axis, normal, base: 0, offset: center.getComponent(axis), flipped: false };
  }

  private others(axis: Axis | null): SectionPlane[] {
    return this.session.store.planes.filter((plane) => plane.axis !== axis);
  }

  /// The lowest and the highest offset at which a plane meets the model's box.
  private rangeOf({ normal, base }: SectionPlane): [number, number] {
    const { min, max }: Box3 = this.session.modelBox;
    const end = (high: boolean) =>
      kAxes.reduce((sum, k) => sum + normal[k] * (normal[k] > 0 === high ? max : min).getComponent(k), -base);
    return [end(false), end(true)];
  }

  private edit(axis: Axis | null, change: (plane: SectionPlane) => SectionPlane): void {
    this.set(this.session.store.planes.map((plane) => (plane.axis === axis ? change(plane) : plane)));
  }

  private set(planes: SectionPlane[]): void {
    this.session.change(() => {
      this.session.store.planes = planes;
    });
    this.session.viewport.setPlanes(
      planes.map(({ normal, base, offset, flipped }) => {
        const side = new Vector3(...normal).multiplyScalar(flipped ? -1 : 1);
        return { normal: side, constant: flipped ? base + offset : -base - offset };
      }),
    );
  }

  private update(): void {
    const { planes, model } = this.session.store;
    if (model && model.number !== this.shownModel) {
      this.shownModel = model.number;
      this.setPicking(false);
      this.session.viewport.setPlanes([]);
    }
    if (planes.length === 0 && !this.node.contains(document.activeElement) && !this.picking) this.open = false;
    if (!model) this.open = false;
    this.node.hidden = !this.open;
    for (const row of this.rows) {
      const plane = planes.find(({ axis }) => axis === row.axis);
      row.on.checked = plane !== undefined;
      row.node.hidden = row.axis === null && !plane;
      row.slider.disabled = row.number.disabled = row.flip.disabled = plane === undefined;
      setText(row.unit, shownUnit());
      if (plane) this.showPlane(row, plane);
      else row.number.value = "";
    }
  }

  private showPlane({ slider, number }: Row, plane: SectionPlane): void {
    const [low, high] = this.rangeOf(plane);
    slider.value = String(high > low ? (plane.offset - low) / (high - low) : 0);
    slider.setAttribute("aria-valuetext", `${coordinateText(plane.offset)} ${shownUnit()}`);
    if (document.activeElement !== number) number.value = String(Number(toShown(plane.offset).toFixed(4)));
  }
}
