// SPDX-License-Identifier: Apache-2.0
import { button, dialogHeader, element, saveAs, setText } from "../dom.ts";
import { endOf } from "../moves.ts";
import { VideoRecorder, videoFormat } from "../scene/video_recorder.ts";
import type { Session } from "../session.ts";
import { type TextKey, text } from "../strings.ts";
import type { Source } from "../wire/messages.ts";
import { guideTitle } from "./guide_panel.ts";
import { InstructionsPart } from "./instructions_part.ts";

/// A file that the server exports (docs/wire.md), and the ending of its name.
interface Format {
  file: string;
  ending: string;
  label: TextKey;
  /// True if the file cannot be made without moves.
  needsMoves: boolean;
  /// True if the file can describe the assembly instead of the disassembly.
  reversible: boolean;
}

const kFormats: Format[] = [
  { file: "page.html", ending: ".html", label: "export.html", needsMoves: false, reversible: true },
  { file: "animation.glb", ending: ".glb", label: "export.glb", needsMoves: false, reversible: true },
  { file: "path.json", ending: ".path.json", label: "export.path", needsMoves: true, reversible: true },
  { file: "moves.csv", ending: "-moves.csv", label: "export.moves", needsMoves: true, reversible: true },
  { file: "bom.csv", ending: "-bom.csv", label: "export.bomCsv", needsMoves: false, reversible: false },
  { file: "bom.json", ending: "-bom.json", label: "export.bomJson", needsMoves: false, reversible: false },
];

/// Interval at which the end of a recorded playback is polled [ms], and the number of polls until it counts as not
/// started.
const kPollInterval = 50;
const kMaxPolls = 200;

/// The dialog that exports the assembly and its moves as files, as work instructions, or the playback as a video.
export class ExportDialog {
  readonly node = element("dialog", { id: "export-dialog", "aria-label": text("export") });
  private readonly reverse = element("input", { type: "checkbox", id: "export-reverse" });
  private readonly status = element("p", { role: "status", id: "export-status", class: "muted" });
  private readonly buttons = kFormats.map((format) => ({ format, button: this.formatButton(format) }));
  private readonly videoButton: HTMLButtonElement;
  private readonly instructions: InstructionsPart;
  private recording = false;
  private readonly sources = element(
    "select",
    { id: "export-source" },
    element("option", { value: "recording" }, text("export.source.recording")),
    element("option", { value: "guide" }),
  );
  private readonly sourceField = element("label", { class: "check" }, text("export.source"), this.sources);

  constructor(private readonly session: Session) {
    const imageButton = button({
      icon: "camera",
      label: text("export.png"),
      wide: true,
      id: "export-png",
      press: () => void session.viewport.screenshot().then((blob) => this.save(blob, ".png")),
    });
    this.videoButton = button({
      icon: "play",
      label: text("export.video"),
      wide: true,
      id: "export-video",
      press: () => void this.recordVideo(),
    });
    this.instructions = new InstructionsPart(
      session,
      () => this.source,
      () => this.reverse.checked && !this.reverse.disabled,
    );
    this.sources.addEventListener("change", () => this.update());
    this.node.append(
      dialogHeader(text("export"), () => this.node.close()),
      this.sourceField,
      element("label", { class: "check" }, this.reverse, element("span", {}, text("export.reverse"))),
      element(
        "div",
        { class: "exports" },
        ...this.buttons.map(({ button: node }) => node),
        imageButton,
        this.videoButton,
      ),
      this.status,
      this.instructions.node,
    );
    session.notifier.subscribe(() => this.update());
  }

  /// The dialog that previews work instructions.
  get preview(): HTMLElement {
    return this.instructions.preview.node;
  }

  open(): void {
    setText(this.status, "");
    this.sources.value = this.session.store.state?.playback?.source ?? "recording";
    this.instructions.reset();
    this.update();
    this.node.showModal();
  }

  private formatButton(format: Format): HTMLButtonElement {
    return button({
      icon: "save",
      label: text(format.label),
      wide: true,
      id: `export-${format.file.replace(".", "-")}`,
      press: () => void this.fetch(format),
    });
  }

  private get source(): Source {
    const { state } = this.session.store;
    if (!state?.guide) return "recording";
    return state.moves.length === 0 || this.sources.value === "guide" ? "guide" : "recording";
  }

  private async fetch({ file, ending, reversible }: Format): Promise<void> {
    const query = new URLSearchParams({ source: this.source });
    if (this.reverse.checked && !this.reverse.disabled && reversible) query.set("reverse", "1");
    setText(this.status, text("export.making"));
    try {
      const response = await this.session.connection.request(`/api/export/${file}?${query}`);
      this.save(await response.blob(), ending);
    } catch (error) {
      setText(this.status, (error as Error).message);
    }
  }

  /// Plays all moves once and records the view as a video.
  private async recordVideo(): Promise<void> {
    const { session } = this;
    const source = this.source;
    const moves = session.movesOf(source);
    const last = moves.at(-1);
    if (!last || this.recording) return;
    const back = this.reverse.checked;
    const end = endOf(last);
    this.recording = true;
    this.node.close();
    try {
      await session.connection.command("seek", { time: back ? end : 0, source });
      const recorder = new VideoRecorder(session.viewport);
      await session.connection.command("play", { speed: back ? -1 : 1, source });
      await this.playbackEnds(back ? 0 : end);
      this.save(await recorder.stop(), videoFormat()!.startsWith("video/mp4") ? ".mp4" : ".webm");
    } catch (error) {
      session.onNote("warning", (error as Error).message);
    } finally {
      this.recording = false;
    }
  }

  /// Resolves when the playback has ended. The reply to "play" may arrive before the state that says so: playback has
  /// ended once it was seen playing, or is at `end`.
  private playbackEnds(end: number): Promise<void> {
    const { store } = this.session;
    let begun = false;
    let polls = 0;
    return new Promise((resolve) => {
      const poll = (): void => {
        const playback = store.state?.playback;
        begun ||= playback?.playing === true;
        const over = begun ? !playback?.playing : playback?.time === end || ++polls === kMaxPolls;
        if (over) resolve();
        else setTimeout(poll, kPollInterval);
      };
      poll();
    });
  }

  private save(content: Blob, ending: string): void {
    const name = `${this.session.fileStem}${ending}`;
    saveAs(content, name);
    const message = text("export.saved", { name });
    if (this.node.open) setText(this.status, message);
    else this.session.onNote("note", message);
  }

  private update(): void {
    const { state, control } = this.session.store;
    this.sourceField.hidden = !state?.guide || state.moves.length === 0;
    setText(this.sources.options[1], guideTitle(state?.guide?.name ?? ""));
    const none = this.session.movesOf(this.source).length === 0;
    for (const { format, button: node } of this.buttons) node.disabled = !state || (format.needsMoves && none);
    this.reverse.disabled = none;
    const busy = state?.hand != null || state?.automatic != null;
    this.videoButton.disabled = none || !control || busy || this.recording || videoFormat() === undefined;
  }
}
