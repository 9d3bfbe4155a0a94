// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { button, element, setText } from "../dom.ts";
import { freeOf, type Session } from "../session.ts";
import { directionText, jobText, text } from "../strings.ts";
import { sizeText } from "../units.ts";

/// Units of files, and the sizes beyond which the unit is probably wrong [mm].
const kUnits = ["mm", "cm", "m", "um", "in", "ft"];
const kLeastSize = 1;
const kMostSize = 20_000;
/// Free directions named in the notice of a blocked drag.
const kMaxDirections = 3;
/// Number of toasts shown at a time; how long each stays, in total and in addition for a character [ms].
const kMaxToasts = 4;
const kToastTime = 4000;
const kToastTimePerCharacter = 60;

/// A notice in the banner, with an optional button.
export interface Notice {
  key: string;
  message: string;
  action?: { label: string; press: () => void };
  choice?: { label: string; options: readonly string[]; value: string; pick: (option: string) => void };
}

/// Notices over the 3D view: everything that makes the view differ from the real state, questions to the user, and
/// progress of jobs.
export class Banner {
  readonly node = element("div", { id: "banners", role: "status" });
  private rows = new Map<string, Row>();
  private keptSize = -1; // number of the model whose size was accepted

  constructor(protected readonly session: Session) {
    session.notifier.subscribe(() => this.update());
  }

  /// Notices that change their message keep their elements: a button that was replaced between the press and the
  /// release of the mouse would not be clicked.
  private update(): void {
    const rows = new Map<string, Row>();
    for (const notice of this.notices()) {
      const { key, message, action, choice } = notice;
      const identity = JSON.stringify([key, action?.label, choice]);
      const row = this.rows.get(identity) ?? makeRow(notice);
      row.notice = notice;
      setText(row.message, message);
      rows.set(identity, row);
    }
    const nodes = [...rows.values()].map(({ node }) => node);
    if (nodes.length !== this.rows.size || nodes.some((node, i) => node !== this.node.children[i]))
      this.node.replaceChildren(...nodes);
    this.rows = rows;
  }

  protected notices(): Notice[] {
    const { store } = this.session;
    const { state } = store;
    const send = (command: "restore" | "take_control" | "resume" | "stop") => () => void this.session.send(command, {});
    const notices: Notice[] = [];
    const jobs = [...store.jobs.values()];
    for (const event of jobs) {
      const { job } = event;
      const press = () => void this.session.send("cancel", { job });
      notices.push({ key: "job", message: jobText(event), action: { label: text("job.cancel"), press } });
    }
    if (store.link === "lost") notices.push({ key: "lost", message: text("banner.lost") });
    if (!state) return notices;
    if (!store.control)
      notices.push({
        key: "watching",
        message: text("banner.watching"),
        action: { label: text("banner.take"), press: send("take_control") },
      });
    if (state.resumable)
      notices.push({
        key: "resume",
        message: text("banner.resume"),
        action: { label: text("banner.resume.do"), press: send("resume") },
      });
    if (state.playback) {
      const { blocked } = state.playback;
      const message = blocked
        ? text("timeline.blocked", { name: this.session.nameOf(blocked.by) })
        : text(store.exploding ? "banner.exploded" : "banner.playback");
      notices.push({
        key: store.exploding ? "exploded" : "playback",
        message,
        action: store.control
          ? { label: text(store.exploding ? "explode.exit" : "timeline.stop"), press: send("stop") }
          : undefined,
      });
    }
    if (state.isolated)
      notices.push({
        key: "isolated",
        message: text("banner.isolated"),
        action: { label: text("restore"), press: send("restore") },
      });
    else this.addHidden(notices);
    this.addSize(notices);
    if (store.quickExplode > 0) notices.push({ key: "approximate", message: text("banner.quick") });
    if (store.planes.length > 0) notices.push({ key: "section", message: text("banner.section") });
    this.addStuck(notices);
    this.addWasStuck(notices);
    return notices;
  }

  /// Asks whether the unit is right where the assembly is larger or smaller than assemblies are.
  private addSize(notices: Notice[]): void {
    const { model, control } = this.session.store;
    if (!model || model.number === this.keptSize) return;
    const size = this.session.modelBox.getSize(new Vector3());
    const longest = Math.max(size.x, size.y, size.z);
    if (longest <= 0 || (longest >= kLeastSize && longest <= kMostSize)) return;
    notices.push({
      key: "size",
      message: text("banner.size", { size: sizeText(longest), units: model.units }),
      choice: control
        ? {
            label: text("banner.size.units"),
            options: kUnits.includes(model.units) ? kUnits : [model.units, ...kUnits],
            value: model.units,
            pick: (units) => void this.session.send("open_again", { units }),
          }
        : undefined,
      action: {
        label: text("banner.size.keep"),
        press: () => {
          this.keptSize = model.number;
          this.update();
        },
      },
    });
  }

  private addHidden(notices: Notice[]): void {
    if (!this.session.hasHidden) return;
    const press = () => this.session.showAll();
    notices.push({ key: "hidden", message: text("banner.hidden"), action: { label: text("restore"), press } });
  }

  private addStuck(notices: Notice[]): void {
    const { blocking, state } = this.session.store;
    if (blocking.size === 0 || !state?.hand) return;
    const name = this.session.namesOf([...blocking], 1);
    const found = this.session.directionsOf(state.hand.components);
    const free = freeOf(found).map(({ direction }) => directionText(direction));
    const directions = free.slice(0, kMaxDirections).join(" ");
    const message = free.length > 0 ? text("stuck.free", { name, directions }) : text("stuck", { name });
    notices.push({ key: "stuck", message: found ? `${message}. ${text("stuck.path")}` : message });
  }

  /// Offers to find a path for a set that was released while blocked.
  private addWasStuck(notices: Notice[]): void {
    const { stuck, state, jobs } = this.session.store;
    if (!stuck || !state || !this.session.idle || state.search || jobs.size > 0) return;
    const names = { name: this.session.nameOf(stuck.components[0]), by: this.session.namesOf(stuck.blocking, 1) };
    notices.push({
      key: "was-stuck",
      message: text("stuck.was", names),
      action: { label: text("findPath"), press: () => void this.session.findPath() },
    });
  }
}

/// The elements of a notice.
interface Row {
  node: HTMLElement;
  message: HTMLElement;
  notice: Notice;
}

function makeRow(notice: Notice): Row {
  const { key, action, choice } = notice;
  const row: Row = { node: element("div", { class: "banner", "data-banner": key }), message: element("span"), notice };
  row.node.append(row.message);
  if (choice) row.node.append(chooser(choice));
  if (action) row.node.append(button({ label: action.label, wide: true, press: () => row.notice.action?.press() }));
  return row;
}

function chooser(choice: NonNullable<Notice["choice"]>): HTMLElement {
  const options = choice.options.map((option) => element("option", { value: option }, option));
  const select = element("select", { "aria-label": choice.label, title: choice.label }, ...options);
  select.value = choice.value;
  select.onchange = () => choice.pick(select.value);
  return select;
}

/// Short-lived messages, announced by screen readers.
export class Toasts {
  readonly node = element("div", { id: "toasts", role: "log", "aria-live": "polite" });

  /// Shows a message for a few seconds.
  show(level: "note" | "warning", message: string): void {
    const toast = element("div", { class: `toast ${level}` }, element("span", {}, message));
    toast.append(button({ icon: "close", label: text("close"), class: "tiny", press: () => toast.remove() }));
    this.node.append(toast);
    while (this.node.childElementCount > kMaxToasts) this.node.firstElementChild!.remove();
    setTimeout(() => toast.remove(), kToastTime + kToastTimePerCharacter * message.length);
  }
}
