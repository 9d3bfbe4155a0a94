// SPDX-License-Identifier: Apache-2.0
import { button, element, relabel, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { directionText, text } from "../strings.ts";
import { kPreferences, type Preference, type Search } from "../wire/messages.ts";

/// Has the planner find how everything comes apart, or how the selection gets out; what it finds becomes the guide, and of
/// what stays it says why.
export class PlanPanel {
  readonly node = element("section", { id: "plan-panel", class: "floating", "aria-label": text("plan"), hidden: true });
  private readonly all = choice("plan-all", true);
  private readonly some = choice("plan-selection", false);
  private readonly someWords = element("span");
  private readonly fixedWords = element("span", { id: "plan-fixed" });
  private readonly fix: HTMLButtonElement;
  private readonly find: HTMLButtonElement;
  private readonly found = element("p", { id: "plan-found", role: "status" });
  private readonly reasons = element("ul", { class: "rows", id: "plan-reasons" });
  private fixed: number[] = [];
  private preferred: Preference[] = []; // in the order in which they were ticked
  private shownModel = -1;
  private shownSearch: Search | null = null;

  constructor(private readonly session: Session) {
    this.fix = button({ label: text("plan.fix"), id: "plan-fix", press: () => this.toggleFixed() });
    this.find = button({
      icon: "route",
      label: text("plan.find"),
      wide: true,
      id: "plan-find",
      class: "primary",
      press: () => void this.ask(),
    });
    this.node.append(
      element("label", {}, this.all, element("span", {}, text("plan.all"))),
      element("label", {}, this.some, this.someWords),
      element("div", { class: "plan-fixed" }, this.fixedWords, this.fix),
      element(
        "fieldset",
        {},
        element("legend", {}, text("plan.prefer")),
        ...kPreferences.map((p) => this.preference(p)),
      ),
      this.find,
      this.found,
      this.reasons,
    );
    session.notifier.subscribe(() => this.update());
  }

  toggle(): void {
    this.node.hidden = !this.node.hidden;
    if (!this.node.hidden) this.some.checked = this.session.store.selection.length > 0;
    if (!this.some.checked) this.all.checked = true;
    this.session.notifier.notify();
  }

  get opened(): boolean {
    return !this.node.hidden;
  }

  private async ask(): Promise<void> {
    const targets = this.some.checked ? this.session.store.selection : [];
    await this.session.ask("plan", { targets, fixed: this.fixed, prefer: this.preferred });
  }

  private preference(preference: Preference): HTMLElement {
    const box = element("input", { type: "checkbox", id: `plan-prefer-${preference}` });
    box.addEventListener("change", () => {
      this.preferred = this.preferred.filter((p) => p !== preference);
      if (box.checked) this.preferred.push(preference);
    });
    return element("label", {}, box, element("span", {}, text(`plan.prefer.${preference}`)));
  }

  private toggleFixed(): void {
    const { selection } = this.session.store;
    this.fixed = this.fixed.length > 0 ? [] : [...selection];
    this.session.notifier.notify();
  }

  private update(): void {
    const { state, model, selection, control, jobs } = this.session.store;
    if (model && model.number !== this.shownModel) [this.fixed, this.shownModel] = [[], model.number];
    if (!this.opened) return;
    this.some.disabled = selection.length === 0;
    if (this.some.disabled) this.all.checked = true;
    setText(this.someWords, selection.length > 0 ? this.session.namesOf(selection) : text("plan.selection"));
    setText(
      this.fixedWords,
      this.fixed.length > 0
        ? text("plan.fixed", { names: this.session.namesOf(this.fixed) })
        : text("plan.fixed.largest"),
    );
    relabel(this.fix, text(this.fixed.length > 0 ? "plan.unfix" : "plan.fix"));
    this.fix.disabled = this.fixed.length === 0 && selection.length === 0;
    this.find.disabled = !control || !state || jobs.size > 0;
    this.showFound(state?.search?.kind === "plan" ? state.search : null);
  }

  private showFound(search: Search | null): void {
    if (search === this.shownSearch) return;
    this.shownSearch = search;
    const key = !search ? "" : search.complete ? "plan.complete" : search.out_of_time ? "plan.ended" : "plan.partly";
    const seconds = search && (search.seconds < 10 ? search.seconds.toFixed(1) : search.seconds.toFixed(0));
    setText(this.found, key === "" ? "" : text(key, { steps: search!.steps, seconds: seconds! }));
    this.reasons.replaceChildren(
      ...(search?.reasons ?? []).map(({ component, direction, blockers }) => {
        const press = () => this.session.select([component]);
        const name = this.session.nameOf(component);
        const names = this.session.namesOf(blockers.map((blocker) => blocker.component));
        const words = text("reason.line", { name, direction: directionText(direction), names });
        const link = element("button", { type: "button", class: "link-button", onclick: press }, words);
        return element("li", {}, link);
      }),
    );
  }
}

function choice(id: string, checked: boolean): HTMLInputElement {
  return element("input", { type: "radio", name: "plan-what", id, checked });
}
