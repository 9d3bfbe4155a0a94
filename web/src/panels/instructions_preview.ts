// SPDX-License-Identifier: Apache-2.0
import { button, dialogHeader, element, setText } from "../dom.ts";
import { text } from "../strings.ts";

/// What the buttons of the preview do.
interface PreviewActions {
  saveHtml: (page: Blob) => void;
  savePdf: () => void;
}

/// A dialog that shows work instructions as they are saved and printed.
export class InstructionsPreview {
  readonly node = element("dialog", { id: "instructions-preview-dialog", "aria-label": text("instructions") });
  private readonly frame = element("iframe", { title: text("instructions") });
  private readonly status = element("span", { role: "status", class: "muted" });
  private readonly pdfButton: HTMLButtonElement;
  private html = "";

  constructor(actions: PreviewActions) {
    this.pdfButton = button({
      icon: "save",
      label: text("instructions.pdf"),
      wide: true,
      id: "preview-pdf",
      press: actions.savePdf,
    });
    this.node.append(
      dialogHeader(text("instructions"), () => this.node.close()),
      this.frame,
      element(
        "div",
        { class: "instructions-tools" },
        this.pdfButton,
        button({
          icon: "save",
          label: text("instructions.html"),
          wide: true,
          id: "preview-html",
          press: () => actions.saveHtml(new Blob([this.html], { type: "text/html" })),
        }),
        button({
          icon: "share",
          label: text("instructions.print"),
          wide: true,
          id: "preview-print",
          press: () => this.frame.contentWindow?.print(),
        }),
        this.status,
      ),
    );
  }

  set busy(busy: boolean) {
    this.pdfButton.disabled = busy;
  }

  say(message: string): void {
    setText(this.status, message);
  }

  /// Shows a page of work instructions.
  show(html: string): void {
    this.html = html;
    this.frame.onload = () => this.fill();
    this.frame.srcdoc = "<!DOCTYPE html>";
    this.node.showModal();
  }

  /// Shows the page's content in the frame. The frame has the policy of this page, which forbids the styles in the
  /// page's text: they are adopted as a style sheet.
  private fill(): void {
    const { contentDocument: shown, contentWindow } = this.frame;
    if (!shown || !contentWindow) return;
    const styles: string[] = [];
    const plain = this.html.replace(/<style>([\s\S]*?)<\/style>/g, (_, style: string) => {
      styles.push(style);
      return "";
    });
    const { body, title } = new DOMParser().parseFromString(plain, "text/html");
    const sheet = new (contentWindow as Window & typeof globalThis).CSSStyleSheet();
    sheet.replaceSync(styles.join("\n"));
    shown.adoptedStyleSheets = [sheet];
    shown.title = title;
    shown.body.replaceChildren(...[...body.childNodes].map((node) => shown.importNode(node, true)));
  }
}
