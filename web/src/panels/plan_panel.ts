// SPDX-License-Identifier: Apache-2.0
import { button, element, linkButton, panelHeader, relabel, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { alongText, countText, text } from "../strings.ts";
import { type Commands, kPreferences, type Preference, type Search } from "../wire/messages.ts";

/// A longer search takes so many times the effort of the one before.
const kLonger = 4;
/// Largest effort of the command `plan`.
const kMaxEffort = 1000;

/// Plans the disassembly of everything or of the selection. The sequence becomes the guide; what blocks the remaining
/// components is listed.
export class PlanPanel {
  readonly node = element("section", {
    id: "plan-panel",
    class: "side-panel",
    "aria-label": text("plan"),
    hidden: true,
  });
  private readonly everything = choice("plan-all", true);
  private readonly selected = choice("plan-selection", false);
  private readonly selectedLabel = element("span");
  private readonly fixedLabel = element("span", { id: "plan-fixed" });
  private readonly fixButton: HTMLButtonElement;
  private readonly findButton: HTMLButtonElement;
  private readonly summary = element("p", { id: "plan-found", role: "status" });
  private readonly longer = element("p", { id: "plan-longer", hidden: true });
  private readonly longerButton = linkButton(text("plan.longer"), () => void this.searchLonger());
  private readonly reasons = element("ul", { class: "rows", id: "plan-reasons" });
  private fixed: number[] = [];
  private preferred: Preference[] = []; // in the order in which they were ticked
  private readonly weights = new Map<Preference, HTMLInputElement>();
  private requested: Commands["plan"][0] | null = null; // the plan that this page asked for last
  private shownModel = -1;
  private shownSearch: Search | null = null;

  constructor(private readonly session: Session) {
    this.fixButton = button({ label: text("plan.fix"), id: "plan-fix", press: () => this.toggleFixed() });
    this.findButton = button({
      icon: "route",
      label: text("plan.find"),
      wide: true,
      id: "plan-find",
      class: "primary",
      press: () => void this.requestPlan(),
    });
    this.longer.append(text("plan.longer.hint"), " ", this.longerButton);
    this.node.append(
      panelHeader(text("plan"), () => this.toggle()),
      element("label", {}, this.everything, element("span", {}, text("plan.all"))),
      element("label", {}, this.selected, this.selectedLabel),
      element("div", { class: "plan-fixed" }, this.fixedLabel, this.fixButton),
      element(
        "fieldset",
        {},
        element("legend", {}, text("plan.prefer")),
        ...kPreferences.map((p) => this.preference(p)),
      ),
      this.findButton,
      this.summary,
      this.longer,
      this.reasons,
    );
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    this.node.hidden = !this.node.hidden;
    this.session.notifier.notify();
  }

  get opened(): boolean {
    return !this.node.hidden;
  }

  private async requestPlan(): Promise<void> {
    const targets = this.selected.checked ? this.session.store.selection : [];
    this.requested = { targets: [...targets], fixed: [...this.fixed], prefer: this.preferences() };
    await this.session.send("plan", this.requested);
  }

  /// Plans the same again, and searches longer for sliding and sampled paths.
  private async searchLonger(): Promise<void> {
    if (!this.requested || !this.shownSearch) return;
    await this.session.send("plan", { ...this.requested, effort: kLonger * this.shownSearch.effort });
  }

  private preference(preference: Preference): HTMLElement {
    const name = text(`plan.prefer.${preference}`);
    const box = element("input", { type: "checkbox", id: `plan-prefer-${preference}` });
    const weight = element("input", {
      type: "number",
      step: "any",
      min: "0",
      id: `plan-weight-${preference}`,
      "aria-label": text("plan.weight", { name }),
      title: text("plan.weight.hint"),
      hidden: true,
    });
    this.weights.set(preference, weight);
    box.addEventListener("change", () => {
      this.preferred = this.preferred.filter((p) => p !== preference);
      if (box.checked) this.preferred.push(preference);
      weight.hidden = !box.checked;
    });
    return element("div", { class: "plan-prefer" }, element("label", {}, box, element("span", {}, name)), weight);
  }

  /// The preferences that are ticked, with the weights that are given.
  private preferences(): string[] {
    return this.preferred.map((p) => {
      const weight = this.weights.get(p)?.valueAsNumber ?? Number.NaN;
      return weight > 0 ? `${p}=${weight}` : p;
    });
  }

  private toggleFixed(): void {
    const { selection } = this.session.store;
    this.fixed = this.fixed.length > 0 ? [] : [...selection];
    this.session.notifier.notify();
  }

  private update(): void {
    const { state, model, selection, control, jobs } = this.session.store;
    if (model && model.number !== this.shownModel) {
      [this.fixed, this.requested, this.shownModel] = [[], null, model.number];
    }
    if (!this.opened) return;
    this.selected.disabled = selection.length === 0;
    if (this.selected.disabled) this.everything.checked = true;
    setText(this.selectedLabel, selection.length > 0 ? this.session.namesOf(selection) : text("plan.selection"));
    setText(
      this.fixedLabel,
      this.fixed.length > 0
        ? text("plan.fixed", { names: this.session.namesOf(this.fixed) })
        : text("plan.fixed.largest"),
    );
    relabel(this.fixButton, text(this.fixed.length > 0 ? "plan.unfix" : "plan.fix"));
    this.fixButton.disabled = this.fixed.length === 0 && selection.length === 0;
    this.findButton.disabled = this.longerButton.disabled = !control || !state || jobs.size > 0;
    this.showSearch(state?.search?.kind === "plan" ? state.search : null);
  }

  private showSearch(search: Search | null): void {
    if (search === this.shownSearch) return;
    this.shownSearch = search;
    const key = !search
      ? ""
      : search.cancelled
        ? "plan.cancelled"
        : search.complete
          ? "plan.complete"
          : search.out_of_time
            ? "plan.ended"
            : "plan.partly";
    const seconds = search && (search.seconds < 10 ? search.seconds.toFixed(1) : search.seconds.toFixed(0));
    setText(this.summary, key === "" ? "" : text(key, { steps: countText(search!.steps, "step"), seconds: seconds! }));
    this.longer.hidden = !this.requested || !search?.effort_spent || kLonger * search.effort > kMaxEffort;
    this.reasons.replaceChildren(
      ...(search?.reasons ?? []).map(({ component, direction, blockers }) => {
        const name = this.session.nameOf(component);
        const names = this.session.namesOf(blockers.map((blocker) => blocker.component));
        const line = text("reason.line", { name, along: alongText(direction), names });
        return element(
          "li",
          {},
          linkButton(line, () => this.session.select([component])),
        );
      }),
    );
  }
}

function choice(id: string, checked: boolean): HTMLInputElement {
  return element("input", { type: "radio", name: "plan-what", id, checked });
}
