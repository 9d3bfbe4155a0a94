// SPDX-License-Identifier: Apache-2.0
import type { Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { element, setText } from "../dom.ts";
import { measureBetween } from "../measurement.ts";
import type { Feature, OutlinedFeature } from "../scene/feature.ts";
import type { Pick } from "../scene/model_view.ts";
import { snap } from "../scene/snap.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { coordinateText, shownUnit } from "../units.ts";

/// Half the size of the cross at a point [px].
const kCross = 6;
/// Measures that are smaller say nothing: the same face was picked twice [mm].
const kNothing = 1e-6;

/// A picked point, and what it belongs to.
interface Picked {
  point: Vector3;
  found: OutlinedFeature;
}

/// Measures edges, diameters, and between two features: corners, edges, centres and faces, to which the cursor snaps.
/// Enter picks at the centre of the view.
export class Measure {
  private readonly label = element("div", { id: "measure-label", class: "floating", role: "status" });
  readonly node = element("div", { hidden: true }, this.label, element("div", { id: "measure-center" }));
  private picked: Picked[] = [];
  private hovered: OutlinedFeature | null = null;
  private readonly line = lines(2);
  private readonly marks = lines(3);

  constructor(private readonly session: Session) {
    session.viewport.scene.add(this.line, this.marks);
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
    this.picked = [];
    this.hovered = null;
    this.session.change(() => {
      store.measuring = !store.measuring;
    });
    if (store.measuring) this.session.viewport.canvas.focus({ preventScroll: true });
    this.session.viewport.invalidate();
  }

  /// Picks a feature; returns false if measuring is off.
  click(pick: Pick | null): boolean {
    if (!this.session.store.measuring) return false;
    if (pick) {
      if (this.picked.length === 2) this.picked = [];
      this.picked.push({ point: pick.point, found: this.snapped(pick) });
      this.session.viewport.invalidate();
    }
    return true;
  }

  /// Shows what a click would pick.
  hover(pick: Pick | null): void {
    if (!this.session.store.measuring) return;
    this.hovered = pick && this.snapped(pick);
    this.session.viewport.invalidate();
  }

  private snapped(pick: Pick): OutlinedFeature {
    const { model, rig } = this.session.viewport;
    return snap(model!, pick, rig.pixelSize(pick.point));
  }

  private update(): boolean {
    const { store } = this.session;
    this.node.hidden = !store.measuring;
    this.line.visible = this.marks.visible = false;
    if (!store.measuring) return false;
    const [a, b] = this.picked;
    const ends = a && b ? this.measureEnds(a, b) : null;
    if (ends) this.draw(this.line, ends);
    const marked = [...this.picked.map(({ found }) => found), ...(this.hovered ? [this.hovered] : [])];
    this.draw(
      this.marks,
      marked.flatMap((found) => this.marksOf(found)),
    );
    setText(this.label, this.message(a, b));
    return false;
  }

  private draw(object: LineSegments2, segments: Vector3[]): void {
    object.visible = segments.length > 0;
    if (segments.length === 0) return;
    // The buffers of a LineSegmentsGeometry cannot grow.
    object.geometry.dispose();
    object.geometry = new LineSegmentsGeometry().setPositions(segments.flatMap((point) => point.toArray()));
    object.material.color.set(this.session.viewport.palette.measure);
  }

  /// The lines that mark a feature: its outline, and a cross at a point or a centre.
  private marksOf({ feature, outline }: OutlinedFeature): Vector3[] {
    const point = feature.kind === "point" ? feature.point : feature.kind === "circle" ? feature.center : null;
    if (!point) return outline;
    const { rig } = this.session.viewport;
    const half = kCross * rig.pixelSize(point);
    const [right, up] = [rig.axis("right").multiplyScalar(half), rig.axis("up").multiplyScalar(half)];
    const cross = [right, up].flatMap((arm) => [point.clone().sub(arm), point.clone().add(arm)]);
    return [...outline, ...cross];
  }

  /// Where the distance is taken: that of the features, or of the picked points if the features have none.
  private measureEnds(a: Picked, b: Picked): [Vector3, Vector3] {
    const measured = measureBetween(a.found.feature, b.found.feature);
    if (measured.kind === "angle" || measured.from.distanceTo(measured.to) < kNothing) return [a.point, b.point];
    return [measured.from, measured.to];
  }

  private message(a: Picked | undefined, b: Picked | undefined): string {
    if (!a) return text("measure.first");
    const { feature } = a.found;
    if (!b) return `${featureText(feature)} ${text("measure.second")}`.trim();
    const [from, to] = this.measureEnds(a, b);
    const by = to.clone().sub(from);
    const result = text("measure.result", {
      distance: measureText(by.length()),
      x: coordinateText(by.x),
      y: coordinateText(by.y),
      z: coordinateText(by.z),
    });
    const measured = measureBetween(feature, b.found.feature);
    if (measured.kind === "distance") return result;
    return text("measure.angle", { result, angle: ((measured.angle * 180) / Math.PI).toFixed(1) });
  }
}

/// The measure that one feature has by itself.
function featureText(feature: Feature): string {
  switch (feature.kind) {
    case "point": {
      const { x, y, z } = feature.point;
      return text("measure.point", { x: coordinateText(x), y: coordinateText(y), z: coordinateText(z) });
    }
    case "line":
      return text("measure.edge", { length: measureText(feature.from.distanceTo(feature.to)) });
    case "curve":
      return text("measure.edge", { length: measureText(feature.length) });
    case "circle":
      return feature.isWhole
        ? text("measure.diameter", { length: measureText(2 * feature.radius) })
        : text("measure.radius", { length: measureText(feature.radius) });
    case "cylinder":
      return text("measure.diameter", { length: measureText(2 * feature.radius) });
    case "plane":
      return text("measure.face");
  }
}

function measureText(millimetres: number): string {
  return `${coordinateText(millimetres)} ${shownUnit()}`;
}

function lines(width: number): LineSegments2 {
  const material = new LineMaterial({ linewidth: width, depthTest: false, transparent: true });
  const object = new LineSegments2(new LineSegmentsGeometry(), material);
  object.visible = false;
  object.frustumCulled = false;
  object.renderOrder = 8;
  return object;
}
