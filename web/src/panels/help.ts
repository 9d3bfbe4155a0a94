// SPDX-License-Identifier: Apache-2.0
import { button, element } from "../dom.ts";
import { type Help, kHelp, text } from "../strings.ts";

export function helpDialog(help: Help = kHelp): HTMLDialogElement {
  const groups = help.map(([title, rows]) =>
    element(
      "section",
      {},
      element("h2", {}, title),
      element(
        "dl",
        { class: "keys" },
        ...rows.flatMap(([keys, does]) => [element("dt", {}, keys), element("dd", {}, does)]),
      ),
    ),
  );
  const dialog = element("dialog", { id: "help-dialog", "aria-label": text("help.title") });
  dialog.append(
    element(
      "header",
      {},
      element("h1", {}, text("help.title")),
      button({ icon: "close", label: text("help.close"), press: () => dialog.close() }),
    ),
    element("div", { class: "columns" }, ...groups),
  );
  return dialog;
}
