// SPDX-License-Identifier: Apache-2.0
import { kPalettes } from "./scene/palette.ts";
import type { Viewport } from "./scene/viewport.ts";

type Theme = "light" | "dark";

const kKey = "dismantle.theme";

/// Dark or light: as the user chose, else as the system has it.
export class ThemeSwitch {
  private theme: Theme = "light";

  constructor(private readonly viewport: Viewport) {
    this.show(startTheme());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.show(startTheme()));
  }

  toggle(): void {
    this.show(this.theme === "light" ? "dark" : "light");
    keep(this.theme);
  }

  private show(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.viewport.setPalette(kPalettes[theme]);
  }
}

function startTheme(): Theme {
  const kept = keptTheme();
  if (kept === "light" || kept === "dark") return kept;
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/// A page that was opened as a file may have no storage.
function keptTheme(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

function keep(theme: Theme): void {
  try {
    localStorage.setItem(kKey, theme);
  } catch {
    // The choice is for this visit only.
  }
}
