// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { element, setText } from "../dom.ts";
import type { Pick } from "../scene/model_view.ts";
import type { Session } from "../session.ts";
import { lengthText, text } from "../strings.ts";

/// Measures the distance between two picked points. Enter picks at the centre of the view.
export class Measure {
  private readonly label = element("div", { id: "measure-label", class: "floating label", role: "status" });
  readonly node = element("div", { hidden: true }, this.label, element("div", { id: "measure-center" }));
  private points: Vector3[] = [];
  private readonly line = new LineSegments2(
    new LineSegmentsGeometry(),
    new LineMaterial({ linewidth: 2, depthTest: false, transparent: true }),
  );

  constructor(private readonly session: Session) {
    this.line.visible = false;
    this.line.frustumCulled = false;
    this.line.renderOrder = 8;
    session.viewport.scene.add(this.line);
    session.viewport.beforeRender.push(() => this.update());
    session.viewport.canvas.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || !session.store.measuring) return;
      event.preventDefault();
      const { x, y } = session.viewport.rig.size;
      this.click(session.viewport.pick(x / 2, y / 2));
    });
  }

  toggle(): void {
    const { store } = this.session;
    this.points = [];
    this.session.change(() => {
      store.measuring = !store.measuring;
    });
    if (store.measuring) this.session.viewport.canvas.focus({ preventScroll: true });
    this.session.viewport.invalidate();
  }

  /// Picks a point; returns false if measuring is off.
  click(pick: Pick | null): boolean {
    if (!this.session.store.measuring) return false;
    if (pick) {
      if (this.points.length === 2) this.points = [];
      this.points.push(pick.point);
      this.session.viewport.invalidate();
    }
    return true;
  }

  private update(): boolean {
    const { store, viewport } = this.session;
    this.node.hidden = !store.measuring;
    this.line.visible = store.measuring && this.points.length === 2;
    if (!store.measuring) return false;
    const [a, b] = this.points;
    setText(this.label, this.message(a, b));
    if (a && b) {
      this.line.geometry.setPositions([...a.toArray(), ...b.toArray()]);
      this.line.material.color.set(viewport.palette.measure);
    }
    const at =
      a && b ? viewport.rig.project(a.clone().add(b).multiplyScalar(0.5)) : new Vector3(viewport.rig.size.x / 2, 40, 0);
    this.label.style.left = `${at.x}px`;
    this.label.style.top = `${at.y}px`;
    return false;
  }

  private message(a: Vector3 | undefined, b: Vector3 | undefined): string {
    if (!a) return text("measure.first");
    if (!b) return text("measure.second");
    const by = b.clone().sub(a);
    const format = (value: number) => value.toFixed(2);
    return text("measure.result", {
      distance: lengthText(by.length()),
      x: format(by.x),
      y: format(by.y),
      z: format(by.z),
    });
  }
}
