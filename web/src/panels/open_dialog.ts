// SPDX-License-Identifier: Apache-2.0
import { button, dialogHeader, element, linkButton } from "../dom.ts";
import type { Session } from "../session.ts";
import { text } from "../strings.ts";
import type { Commands } from "../wire/messages.ts";
import {
  chosenFiles,
  commonFolder,
  droppedFiles,
  kCompanions,
  type PathedFile,
  packedFiles,
  usefulFiles,
} from "./dropped_files.ts";

/// Time given to the server to announce an open assembly before the start page is shown [ms].
const kStartPageDelay = 250;

/// The dialog that opens assemblies, also shown as the start page: samples, recent files, files under the roots, an
/// upload. Files and folders dropped anywhere on the page are opened, too.
export class OpenDialog {
  readonly node: HTMLDialogElement;
  private readonly samples = element("div", { class: "cards", id: "samples" });
  private readonly recent = element("ul", { class: "rows", id: "recent" });
  private readonly roots = element("div", { class: "roots" });
  private readonly picker = element("input", {
    type: "file",
    class: "visually-hidden",
    id: "file-picker",
    multiple: true,
    "aria-label": text("open.choose"),
  });
  private readonly folderPicker = element("input", {
    type: "file",
    class: "visually-hidden",
    id: "folder-picker",
    webkitdirectory: true,
    "aria-label": text("open.folder"),
  });
  private dismissed = false;
  private waiting = false;
  /// True if the dialog opened because there was no assembly.
  private isStartPage = false;

  constructor(private readonly session: Session) {
    for (const picker of [this.picker, this.folderPicker])
      picker.onchange = () => {
        const files = chosenFiles(picker.files!);
        picker.value = "";
        void this.upload(files);
      };
    this.node = element(
      "dialog",
      { id: "open-dialog", "aria-label": text("open.title") },
      dialogHeader(text("open.title"), () => this.close()),
      element("p", { class: "lead" }, text("open.lead")),
      element("h2", {}, text("open.samples")),
      this.samples,
      element(
        "div",
        { class: "drop" },
        element("span", {}, text("open.drop")),
        button({ icon: "open", label: text("open.choose"), wide: true, press: () => this.picker.click() }),
        button({ icon: "open", label: text("open.folder"), wide: true, press: () => this.folderPicker.click() }),
        this.picker,
        this.folderPicker,
      ),
      element(
        "div",
        { class: "columns" },
        element("section", {}, element("h2", {}, text("open.recent")), this.recent),
        element("section", {}, element("h2", {}, text("open.roots")), this.roots),
      ),
    );
    this.node.oncancel = () => {
      this.dismissed = true;
    };
    this.listenForDrops();
    session.notifier.subscribe(() => this.update());
  }

  open(): void {
    this.isStartPage = false;
    if (!this.node.open) this.node.showModal();
    void this.refresh();
  }

  close(): void {
    this.dismissed = true;
    this.node.close();
  }

  /// Shows the start page while there is no assembly, and closes it when one is loaded.
  private update(): void {
    const { model, link, jobs } = this.session.store;
    const idle = () => link === "open" && !this.session.store.model && jobs.size === 0 && !this.dismissed;
    if (this.node.open && (jobs.size > 0 || (model && this.isStartPage))) this.node.close();
    if (model || !idle() || this.node.open || this.waiting) return;
    this.waiting = true;
    setTimeout(() => {
      this.waiting = false;
      if (!idle()) return;
      this.open();
      this.isStartPage = true;
    }, kStartPageDelay);
  }

  private async refresh(): Promise<void> {
    const [samples, recent] = await Promise.all([this.session.send("samples", {}), this.session.send("recent", {})]);
    this.samples.replaceChildren(
      ...(samples?.samples ?? []).map(({ name, description }) =>
        element(
          "button",
          { type: "button", class: "card", "data-sample": name, onclick: () => void this.load({ sample: name }) },
          element("strong", {}, name),
          element("span", {}, description),
        ),
      ),
    );
    const files = (recent?.recent ?? []).map(({ name, folder }, index) =>
      element(
        "li",
        {},
        linkButton(name, () => void this.load({ recent: index })),
        element("span", { class: "muted" }, folder),
      ),
    );
    this.recent.replaceChildren(
      ...(files.length > 0 ? files : [element("li", { class: "muted" }, text("open.recent.none"))]),
    );
    const { roots, extensions } = this.session.store;
    this.picker.accept = [...extensions, ...kCompanions, ".json"].join();
    this.roots.replaceChildren(...roots.map((name, root) => this.rootList(name, root)));
    if (roots.length === 0) this.roots.append(element("p", { class: "muted" }, text("open.roots.none")));
  }

  private rootList(name: string, root: number): HTMLElement {
    const list = element("ul", { class: "rows files" });
    const show = async (folder: string): Promise<void> => {
      const found = await this.session.send("files", { root, folder });
      const rows = (found?.entries ?? []).map((entry) => {
        const file = folder === "" ? entry.name : `${folder}/${entry.name}`;
        const press = () =>
          void (entry.kind === "folder"
            ? show(file)
            : entry.kind === "path"
              ? this.openPath(root, file)
              : this.load({ root, file }));
        return element("li", {}, linkButton(entry.kind === "folder" ? `${entry.name}/` : entry.name, press));
      });
      const parent = folder.split("/").slice(0, -1).join("/");
      const up = element(
        "li",
        {},
        linkButton(text("open.up"), () => void show(parent)),
      );
      const meshes = (found?.entries ?? []).filter(({ kind, name: file }) => kind === "assembly" && isMesh(file));
      const whole = element(
        "li",
        {},
        linkButton(
          text("open.whole", { count: meshes.length }),
          () => void this.load({ root, file: folder === "" ? "." : folder }),
        ),
      );
      list.replaceChildren(...(folder === "" ? [] : [up]), ...(meshes.length > 1 ? [whole] : []), ...rows);
    };
    void show("");
    return element("div", {}, element("h3", {}, name), list);
  }

  private async load(assembly: Commands["open"][0]): Promise<void> {
    if (await this.session.send("open", assembly)) this.close();
  }

  private async openPath(root: number, file: string): Promise<void> {
    if (await this.session.send("open_path", { root, file })) this.close();
  }

  /// Uploads and opens files of the user's machine: one, or several that are an assembly together.
  async upload(files: PathedFile[]): Promise<void> {
    const { extensions } = this.session.store;
    try {
      if (files.length === 1) {
        const { file } = files[0];
        await this.post(file.name.endsWith(".path.json") ? "guide" : "open", file.name, file);
      } else if (files.length > 1) {
        const useful = usefulFiles(files, extensions);
        if (useful.length === 0) return this.session.onNote("warning", text("open.nothing"));
        await this.post("open_files", commonFolder(useful), packedFiles(useful));
      }
      this.close();
    } catch (error) {
      this.session.onNote("warning", (error as Error).message);
    }
  }

  private async post(endpoint: string, name: string, body: Blob): Promise<void> {
    const address = `/api/${endpoint}?name=${encodeURIComponent(name)}`;
    await this.session.connection.request(address, { method: "POST", body });
  }

  private listenForDrops(): void {
    const updateOutline = (event: DragEvent): void => {
      event.preventDefault();
      document.body.classList.toggle("dropping", event.type === "dragover");
    };
    document.addEventListener("dragover", updateOutline);
    document.addEventListener("dragleave", updateOutline);
    document.addEventListener("drop", (event) => {
      updateOutline(event);
      if (event.dataTransfer) void droppedFiles(event.dataTransfer).then((files) => this.upload(files));
    });
  }
}

/// True for files of which a folder is an assembly.
function isMesh(file: string): boolean {
  return /\.(obj|stl|ply)$/i.test(file);
}
