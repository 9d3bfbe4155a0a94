// SPDX-License-Identifier: Apache-2.0
import { button, element, saveAs, setText } from "../dom.ts";
import type { Session } from "../session.ts";
import { jobText, type TextKey, text } from "../strings.ts";
import type { InstructionsFormat, Source } from "../wire/messages.ts";
import { InstructionsPreview } from "./instructions_preview.ts";

/// The texts of the title block.
const kFields = ["product", "number", "revision", "author", "date"] as const;
const kPapers = ["a4", "letter"] as const;
const kEndings: Record<InstructionsFormat, string> = { html: "-instructions.html", pdf: ".pdf" };

/// The part of the export dialog that makes work instructions: paper, title block, preview, files.
export class InstructionsPart {
  readonly node: HTMLElement;
  readonly preview: InstructionsPreview;
  private readonly paper = element(
    "select",
    { id: "instructions-paper" },
    ...kPapers.map((paper) => element("option", { value: paper }, text(`instructions.${paper}`))),
  );
  private readonly fields = kFields.map((name) => element("input", { type: "text", id: `instructions-${name}` }));
  private readonly status = element("p", { role: "status", id: "instructions-status", class: "muted" });
  private readonly buttons: HTMLButtonElement[];
  private readonly cancelButton: HTMLButtonElement;
  private job: number | null = null;

  /// @param source of the path; @param isReversed true for assembly instead of disassembly
  constructor(
    private readonly session: Session,
    private readonly source: () => Source,
    private readonly isReversed: () => boolean,
  ) {
    this.preview = new InstructionsPreview({
      saveHtml: (page) => this.save(page, "html"),
      savePdf: () => void this.makeFile("pdf"),
    });
    const tool = (id: string, label: TextKey, press: () => void, name: "eye" | "save") =>
      button({ icon: name, label: text(label), wide: true, id: `instructions-${id}`, press });
    this.buttons = [
      tool("preview", "instructions.preview", () => void this.showPreview(), "eye"),
      tool("pdf", "instructions.pdf", () => void this.makeFile("pdf"), "save"),
      tool("html", "instructions.html", () => void this.makeFile("html"), "save"),
    ];
    this.cancelButton = button({
      icon: "close",
      label: text("job.cancel"),
      wide: true,
      id: "instructions-cancel",
      press: () => void (this.job !== null && session.send("cancel", { job: this.job })),
    });
    this.node = element(
      "section",
      { class: "instructions", "aria-label": text("instructions") },
      element("h2", {}, text("instructions")),
      element(
        "div",
        { class: "fields" },
        field("instructions.paper", this.paper),
        ...this.fields.map((input, i) => field(`instructions.${kFields[i]}`, input)),
      ),
      element("div", { class: "instructions-tools" }, ...this.buttons, this.cancelButton),
      this.status,
    );
    session.notifier.subscribe(() => this.update());
  }

  /// Forgets the last message. Call when the dialog opens.
  reset(): void {
    setText(this.status, "");
    this.fields[0].placeholder = this.session.store.model?.product ?? "";
    this.fields[4].placeholder = text("instructions.today");
  }

  private async showPreview(): Promise<void> {
    const page = await this.make("html");
    if (page) this.preview.show(await page.text());
  }

  private async makeFile(format: InstructionsFormat): Promise<void> {
    const file = await this.make(format);
    if (file) this.save(file, format);
  }

  private save(file: Blob, format: InstructionsFormat): void {
    const name = `${this.session.fileStem}${kEndings[format]}`;
    saveAs(file, name);
    this.say(text("export.saved", { name }));
  }

  /// Has the server make a file. @return null if that failed or was cancelled
  private async make(format: InstructionsFormat): Promise<Blob | null> {
    if (this.job !== null) return null;
    const { session } = this;
    const titles = Object.fromEntries(kFields.map((name, i) => [name, this.fields[i].value.trim()]));
    const paper = this.paper.value as (typeof kPapers)[number];
    try {
      const members = { format, paper, source: this.source(), reverse: this.isReversed(), ...titles };
      this.job = (await session.connection.command("instructions", members)).job;
      session.notifier.notify();
      const { status, error } = await session.jobs.endOf(this.job);
      if (status !== "done") {
        this.say(status === "cancelled" ? text("job.cancelled") : (error ?? ""));
        return null;
      }
      this.say("");
      return await (await session.connection.request("/api/instructions")).blob();
    } catch (error) {
      this.say((error as Error).message);
      return null;
    } finally {
      this.job = null;
      session.notifier.notify();
    }
  }

  private say(message: string): void {
    setText(this.status, message);
    this.preview.say(message);
  }

  private update(): void {
    const { store } = this.session;
    const none = this.session.movesOf(this.source()).length === 0;
    for (const node of this.buttons) node.disabled = none || !store.control || store.jobs.size > 0;
    this.preview.busy = store.jobs.size > 0;
    this.cancelButton.hidden = this.job === null;
    const job = this.job === null ? undefined : store.jobs.get(this.job);
    if (job) this.say(jobText(job));
  }
}

function field(label: TextKey, input: HTMLInputElement | HTMLSelectElement): HTMLElement {
  return element("label", {}, element("span", {}, text(label)), input);
}
