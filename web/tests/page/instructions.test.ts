// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { violationsOf } from "../support/accessibility.ts";
import { kSlide, useMicroscope, viewer } from "../support/scene.ts";

useMicroscope({ view: "1" });

const preview = () => viewer.page.frameLocator("#instructions-preview-dialog iframe");
const status = () => viewer.page.locator("#instructions-status").innerText();

test("without moves there are no instructions to make", async () => {
  await viewer.page.click("#export");
  for (const id of ["preview", "pdf", "html"])
    assert.equal(await viewer.page.isDisabled(`#instructions-${id}`), true, id);
  await viewer.press("Escape");
});

test("the preview shows the page with its styles, and its title block", async () => {
  await viewer.takeOut(kSlide);
  await viewer.takeOut("foot");
  await viewer.page.click("#export");
  assert.equal(await viewer.page.getAttribute("#instructions-product", "placeholder"), "microscope");
  await viewer.page.fill("#instructions-product", "School microscope");
  await viewer.page.fill("#instructions-number", "DOC-17");
  await viewer.page.fill("#instructions-revision", "B");
  await viewer.page.fill("#instructions-author", "A. Fitter");
  await viewer.page.click("#instructions-preview");
  await preview().locator("h1").waitFor();
  assert.equal(await preview().locator("h1").first().innerText(), "Disassembly of School microscope");
  const words = await preview().locator("body").innerText();
  for (const word of ["DOC-17", "A. Fitter", kSlide]) assert.ok(words.includes(word), word);
  assert.equal(await preview().locator(".step").count(), 2);
  const look = await preview()
    .locator(".step")
    .first()
    .evaluate((step) => ({
      border: getComputedStyle(step).borderTopWidth,
      width: step.querySelector("img")!.naturalWidth,
    }));
  assert.deepEqual(look, { border: "2px", width: 960 });
  assert.deepEqual(await violationsOf(viewer.page), []);
});

test("the previewed page is saved as it is shown", async () => {
  const { name, bytes } = await viewer.saved("#preview-html");
  assert.equal(name, "microscope-instructions.html");
  assert.match(bytes.toString(), /^<!DOCTYPE html>[\s\S]*Disassembly of School microscope/);
});

test("the preview is printed as it is shown", async () => {
  const printed = await viewer.page.evaluate(() => {
    const frame = document.querySelector<HTMLIFrameElement>("#instructions-preview-dialog iframe")!;
    let title = "";
    frame.contentWindow!.print = () => {
      title = frame.contentDocument!.querySelector("h1")!.innerText;
    };
    document.querySelector<HTMLButtonElement>("#preview-print")!.click();
    return title;
  });
  assert.equal(printed, "Disassembly of School microscope");
});

test("the PDF is made from the preview, too, on the chosen paper", async () => {
  const a4 = await viewer.saved("#preview-pdf");
  assert.equal(a4.name, "microscope.pdf");
  assert.equal(a4.bytes.toString("latin1", 0, 5), "%PDF-");
  assert.match(a4.bytes.toString("latin1"), /MediaBox \[ 0 0 595 842 \]/);
  await viewer.page.keyboard.press("Escape");
  await viewer.page.selectOption("#instructions-paper", "letter");
  assert.match((await viewer.saved("#instructions-pdf")).bytes.toString("latin1"), /MediaBox \[ 0 0 612 792 \]/);
  assert.match(await status(), /Saved microscope\.pdf/);
});

test("reversed, they are for the assembly", async () => {
  await viewer.page.check("#export-reverse");
  const { bytes } = await viewer.saved("#instructions-html");
  assert.match(bytes.toString(), /<title>Assembly of School microscope/);
  await viewer.page.uncheck("#export-reverse");
});

test("making them shows its progress and can be cancelled", async () => {
  await viewer.page.click("#instructions-pdf");
  await viewer.page.click("#instructions-cancel");
  await viewer.page.locator("#instructions-status", { hasText: "Cancelled" }).waitFor();
  await viewer.idle();
  assert.equal(await viewer.page.isVisible("#instructions-cancel"), false);
  assert.equal(await viewer.page.isDisabled("#instructions-pdf"), false);
});

test("the page had no errors", () => {
  assert.deepEqual(viewer.problems, []);
});
