// SPDX-License-Identifier: Apache-2.0
import { dialogHeader, element } from "../dom.ts";
import { type Help, kHelp } from "../help_texts.ts";
import { text } from "../strings.ts";

/// Makes the dialog that lists keys and gestures.
export function helpDialog(help: Help = kHelp): HTMLDialogElement {
  const groups = help.map(([title, rows]) =>
    element(
      "section",
      {},
      element("h2", {}, title),
      element(
        "dl",
        { class: "keys" },
        ...rows.flatMap(([keys, effect]) => [element("dt", {}, keys), element("dd", {}, effect)]),
      ),
    ),
  );
  const dialog = element("dialog", { id: "help-dialog", "aria-label": text("help") });
  dialog.append(
    dialogHeader(text("help"), () => dialog.close()),
    element("div", { class: "columns" }, ...groups),
  );
  return dialog;
}
