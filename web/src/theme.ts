// SPDX-License-Identifier: Apache-2.0
import { kPalettes } from "./scene/palette.ts";
import type { Viewport } from "./scene/viewport.ts";

type Theme = "light" | "dark";

const kKey = "dismantle.theme";

/// Dark or light theme: the user's choice, otherwise the system's setting.
export class ThemeSwitch {
  private theme: Theme = "light";

  constructor(private readonly viewport: Viewport) {
    this.show(startTheme());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.show(startTheme()));
  }

  toggle(): void {
    this.show(this.theme === "light" ? "dark" : "light");
    storeTheme(this.theme);
  }

  private show(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.viewport.setPalette(kPalettes[theme]);
  }
}

function startTheme(): Theme {
  const stored = storedTheme();
  if (stored === "light" || stored === "dark") return stored;
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

/// The stored choice. Pages opened as files may have no storage.
function storedTheme(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

function storeTheme(theme: Theme): void {
  try {
    localStorage.setItem(kKey, theme);
  } catch {
    // Without storage the choice lasts until the page is closed.
  }
}
