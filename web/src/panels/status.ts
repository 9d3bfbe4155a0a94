// SPDX-License-Identifier: Apache-2.0
import { element, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { lengthText, text } from "../strings.ts";

const kMetricsEvery = 1000;

/// The line at the bottom: what the pointer is on, how near things are, what a step costs, and on what.
export class StatusLine {
  readonly node: HTMLElement;
  private readonly parts = {
    subject: element("span", { class: "subject" }),
    hint: element("span", { class: "hint" }),
    clearance: element("span", { id: "status-clearance" }),
    step: element("span", { id: "status-step" }),
    rate: element("span"),
    picture: element("span", { id: "status-picture" }),
    device: element("span", { id: "status-device" }),
    tolerance: element("span", { id: "status-tolerance" }),
    triangles: element("span"),
    clients: element("span"),
    link: element("span", { class: "link", id: "status-link" }),
  };
  private asked = false;

  constructor(private readonly session: Session) {
    this.node = element("footer", { id: "status", "aria-label": text("status.label") }, ...Object.values(this.parts));
    session.notifier.subscribe(() => this.update());
    setInterval(() => {
      this.askMetrics();
      this.showPicture();
    }, kMetricsEvery);
  }

  /// Only while something is going on: an idle page asks for nothing.
  private askMetrics(): void {
    const { link, state, metrics } = this.session.store;
    if (this.asked || link !== "open" || !state || (metrics && state.moving.length === 0)) return;
    this.asked = true;
    this.session.connection
      .command("metrics", {})
      .then(
        (answer) =>
          this.session.change(() => {
            this.session.store.metrics = answer;
          }),
        () => {},
      )
      .finally(() => {
        this.asked = false;
      });
  }

  private showPicture(): void {
    const { calls, milliseconds } = this.session.viewport.cost;
    const time = milliseconds.toFixed(1);
    setText(this.parts.picture, this.session.store.model ? text("status.picture", { calls, time }) : "");
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
    setText(this.parts.rate, frame ? text("status.rate", { rate: frame.stepsPerSecond.toFixed(0) }) : "");
    setText(this.parts.device, metrics ? metrics.device.toUpperCase() : "");
    setText(this.parts.tolerance, model ? text("status.tolerance", { value: lengthText(model.tolerance) }) : "");
    setText(
      this.parts.triangles,
      model ? text("status.triangles", { count: model.triangles.toLocaleString("en") }) : "",
    );
    setText(this.parts.clients, store.clients > 1 ? text("status.watchers", { count: store.clients }) : "");
    setText(this.parts.link, text(`status.${link}`));
    this.parts.link.dataset.link = link;
  }
}

export function clearanceText(clearance: number): string {
  return clearance === 0 ? text("clearance.contact") : lengthText(clearance);
}

function stepText(microseconds: number): string {
  return microseconds < 1000 ? `${microseconds.toFixed(0)} µs` : `${(microseconds / 1000).toFixed(1)} ms`;
}
