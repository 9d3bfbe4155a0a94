// SPDX-License-Identifier: Apache-2.0
import { element, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import { lengthText } from "../units.ts";

const kMetricsInterval = 1000;

/// The status line: component under the cursor, clearance, duration of a step, device, tolerance.
export class StatusLine {
  readonly node: HTMLElement;
  private readonly parts = {
    subject: element("span", { class: "subject" }),
    hint: element("span", { class: "hint" }),
    clearance: element("span", { id: "status-clearance" }),
    step: element("span", { id: "status-step" }),
    device: element("span", { id: "status-device" }),
    tolerance: element("span", { id: "status-tolerance" }),
    triangles: element("span"),
    clients: element("span"),
    link: element("span", { class: "link", id: "status-link" }),
  };
  private requested = false;

  constructor(private readonly session: Session) {
    this.node = element("footer", { id: "status", "aria-label": text("status.label") }, ...Object.values(this.parts));
    session.notifier.subscribe(() => this.update());
    setInterval(() => {
      this.requestMetrics();
      this.showRenderCost();
    }, kMetricsInterval);
  }

  /// Requests metrics only while something moves, so an idle page sends nothing.
  private requestMetrics(): void {
    const { link, state, metrics } = this.session.store;
    if (this.requested || link !== "open" || !state || (metrics && state.moving.length === 0)) return;
    this.requested = true;
    this.session.connection
      .command("metrics", {})
      .then(
        (metrics) => {
          this.session.store.metrics = metrics;
          this.session.notifier.notifyPanels();
        },
        () => {},
      )
      .finally(() => {
        this.requested = false;
      });
  }

  /// What drawing costs is of interest where it is slow: the tooltip says it.
  private showRenderCost(): void {
    const { calls, milliseconds } = this.session.viewport.cost;
    const { frame } = this.session.store;
    const rate = frame ? `, ${text("status.rate", { rate: frame.stepsPerSecond.toFixed(0) })}` : "";
    this.parts.link.title = text("status.render", { calls, time: milliseconds.toFixed(1) }) + rate;
  }

  private update(): void {
    const { store } = this.session;
    const { model, frame, metrics, link } = store;
    const held = store.state?.hand?.components ?? [];
    const subject = store.hovered ?? held[0] ?? null;
    setText(this.parts.subject, this.session.nameOf(subject));
    setText(this.parts.hint, store.dragHint);
    const near = frame && !Number.isNaN(frame.clearance);
    setText(this.parts.clearance, near ? `${text("clearance")} ${clearanceText(frame.clearance)}` : "");
    setText(this.parts.step, frame ? text("status.step", { time: stepText(frame.stepTime) }) : "");
    setText(this.parts.device, metrics ? metrics.device.toUpperCase() : "");
    setText(this.parts.tolerance, model ? text("status.tolerance", { value: lengthText(model.tolerance) }) : "");
    setText(
      this.parts.triangles,
      model ? text("status.triangles", { count: model.triangles.toLocaleString("en") }) : "",
    );
    setText(this.parts.clients, store.clients > 1 ? text("status.clients", { count: store.clients }) : "");
    setText(this.parts.link, text(`status.${link}`));
    this.parts.link.dataset.link = link;
  }
}

/// A clearance [mm] as text.
export function clearanceText(clearance: number): string {
  return clearance === 0 ? text("contact") : lengthText(clearance);
}

function stepText(microseconds: number): string {
  return microseconds < 1000 ? `${microseconds.toFixed(0)} µs` : `${(microseconds / 1000).toFixed(1)} ms`;
}
