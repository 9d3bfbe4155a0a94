// SPDX-License-Identifier: Apache-2.0
import { button, element, saveAs, setText } from "../dom.ts";
import { FilmRecorder, videoFormat } from "../scene/film_recorder.ts";
import type { Session } from "../session.ts";
import { type TextKey, text } from "../strings.ts";
import type { Source } from "../wire/messages.ts";

/// A file that the server makes (docs/wire.md), and what its name ends in here.
interface Format {
  file: string;
  ending: string;
  label: TextKey;
  /// Of moves: there is none without them. Of components: the same in both directions.
  of: "moves" | "both" | "components";
}

const kFormats: Format[] = [
  { file: "page.html", ending: ".html", label: "export.html", of: "both" },
  { file: "animation.glb", ending: ".glb", label: "export.glb", of: "both" },
  { file: "path.json", ending: ".path.json", label: "export.path", of: "moves" },
  { file: "moves.csv", ending: "-moves.csv", label: "export.moves", of: "moves" },
  { file: "bom.csv", ending: "-bom.csv", label: "export.billCsv", of: "components" },
  { file: "bom.json", ending: "-bom.json", label: "export.billJson", of: "components" },
];

/// How often a film asks whether the playback is over [ms], and how often before it has begun.
const kLookEvery = 50;
const kMostLooks = 200;

/// What is open and what was done with it, as files for others; and a film of the playback.
export class ExportDialog {
  readonly node = element("dialog", { id: "export-dialog", "aria-label": text("export") });
  private readonly reverse = element("input", { type: "checkbox", id: "export-reverse" });
  private readonly words = element("p", { role: "status", id: "export-status", class: "muted" });
  private readonly buttons = kFormats.map((format) => ({ format, button: this.formatButton(format) }));
  private readonly film: HTMLButtonElement;
  private filming = false;

  constructor(private readonly session: Session) {
    const picture = button({
      icon: "camera",
      label: text("export.png"),
      wide: true,
      id: "export-png",
      press: () => void session.viewport.screenshot().then((blob) => this.save(blob, ".png")),
    });
    this.film = button({
      icon: "play",
      label: text("export.video"),
      wide: true,
      id: "export-video",
      press: () => void this.makeFilm(),
    });
    this.node.append(
      element(
        "header",
        {},
        element("h1", {}, text("export")),
        button({ icon: "close", label: text("help.close"), press: () => this.node.close() }),
      ),
      element("label", { class: "check" }, this.reverse, element("span", {}, text("export.reverse"))),
      element("div", { class: "exports" }, ...this.buttons.map(({ button: made }) => made), picture, this.film),
      this.words,
    );
    session.notifier.subscribe(() => this.update());
  }

  open(): void {
    setText(this.words, "");
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
    return state?.playback?.source ?? (state?.moves.length === 0 && state.guide ? "guide" : "recording");
  }

  private async fetch({ file, ending, of }: Format): Promise<void> {
    const query = new URLSearchParams({ source: this.source });
    if (this.reverse.checked && !this.reverse.disabled && of !== "components") query.set("reverse", "1");
    setText(this.words, text("export.making"));
    try {
      const answer = await this.session.connection.request(`/api/export/${file}?${query}`);
      this.save(await answer.blob(), ending);
    } catch (error) {
      setText(this.words, (error as Error).message);
    }
  }

  /// Plays everything once and keeps what is drawn.
  private async makeFilm(): Promise<void> {
    const { session } = this;
    const source = this.source;
    const moves = session.movesOf(source);
    const last = moves.at(-1);
    if (!last || this.filming) return;
    const back = this.reverse.checked;
    const end = last.start + last.duration;
    this.filming = true;
    this.node.close();
    try {
      await session.connection.command("seek", { time: back ? end : 0, source });
      const recorder = new FilmRecorder(session.viewport);
      await session.connection.command("play", { speed: back ? -1 : 1, source });
      await this.playbackEnds(back ? 0 : end);
      this.save(await recorder.stop(), videoFormat()!.startsWith("video/mp4") ? ".mp4" : ".webm");
    } catch (error) {
      session.onNote("warning", (error as Error).message);
    } finally {
      this.filming = false;
    }
  }

  /// The answer to "play" may come before the state that says so: it ends once it has been seen to play, or is at `end`.
  private playbackEnds(end: number): Promise<void> {
    const { store } = this.session;
    let begun = false;
    let patience = kMostLooks;
    return new Promise((resolve) => {
      const look = (): void => {
        const playback = store.state?.playback;
        begun ||= playback?.playing === true;
        const over = begun ? !playback?.playing : playback?.time === end || --patience === 0;
        if (over) resolve();
        else setTimeout(look, kLookEvery);
      };
      look();
    });
  }

  private save(content: Blob, ending: string): void {
    const name = `${(this.session.store.model?.name ?? "assembly").replace(/\.\w+$/, "")}${ending}`;
    saveAs(content, name);
    const words = text("export.saved", { name });
    if (this.node.open) setText(this.words, words);
    else this.session.onNote("note", words);
  }

  private update(): void {
    const { state, control } = this.session.store;
    const none = this.session.movesOf(this.source).length === 0;
    for (const { format, button: made } of this.buttons) made.disabled = !state || (format.of === "moves" && none);
    this.reverse.disabled = none;
    const busy = state?.hand != null || state?.automatic != null;
    this.film.disabled = none || !control || busy || this.filming || videoFormat() === undefined;
  }
}
