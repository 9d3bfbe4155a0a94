// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_page.h"

#include "dismantle/instructions/motion_text.h"
#include "dismantle/report/html_text.h"

namespace dismantle {

namespace {

constexpr const char* kStart = R"(<!DOCTYPE html>
<html lang="en" xmlns="http://www.w3.org/1999/xhtml">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="generator" content="dismantle"/>
)";

constexpr const char* kStyle = R"(
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1100px; padding: 24px; background: #ffffff; color: #1c2430;
  font: 16px/1.4 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 28px; margin: 0 0 8px; } h2 { font-size: 20px; margin: 24px 0 8px; } h3 { font-size: 14px; margin: 10px 0 2px; }
p, ul { margin: 0 0 6px; } ul { padding-left: 1.2em; }
img { display: block; max-width: 100%; height: auto; border: 1px solid #c9d0d8; }
.cover img { margin: 16px 0; }
table { border-collapse: collapse; width: 100%; }
th, td { padding: 4px 8px; border-bottom: 1px solid #c9d0d8; text-align: left; vertical-align: top; }
td.n, th.n { text-align: right; white-space: nowrap; }
.step { border-top: 2px solid #1c2430; padding: 10px 0 20px; break-inside: avoid; }
.step h2 { margin: 0 0 8px; } .step h2 b { display: inline-block; min-width: 2em; }
.columns { display: grid; grid-template-columns: 3fr 2fr; gap: 16px; }
.caution { border-left: 5px solid #a86500; padding-left: 8px; }
.overview { width: 55%; margin-top: 10px; }
footer { margin-top: 24px; color: #5c6675; font-size: 13px; }
@media (max-width: 700px) { .columns { grid-template-columns: 1fr; } }
@page { size: A4; margin: 14mm; }
@media print { body { max-width: none; padding: 0; font-size: 10pt; } .cover { break-after: page; } h2 { font-size: 14pt; } }
)";

std::string picture(const Image& image, const std::string& alternative, const char* style = "") {
  return "<img src=\"" + png_data_url(encode_png(image)) + "\" width=\"" + std::to_string(image.width) +
         "\" height=\"" + std::to_string(image.height) + "\" alt=\"" + html_escaped(alternative) + "\"" + style + "/>";
}

std::string list(const std::vector<std::string>& texts) {
  std::string html = "<ul>";
  for (const std::string& text : texts) html += "<li>" + html_escaped(text) + "</li>";
  return html + "</ul>\n";
}

std::string parts_table(const WorkInstructions& instructions) {
  std::string html =
      "<h2>Parts</h2>\n<table><thead><tr><th class=\"n\">Item</th><th>Name</th><th class=\"n\">Count</th>"
      "<th class=\"n\">Size [mm]</th><th>Steps</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < instructions.parts.size(); ++i) {
    const PartsLine& line = instructions.parts[i];
    std::string steps;
    for (const std::size_t step : line.steps) {
      const std::string number = std::to_string(step);
      if (!steps.empty()) steps += ", ";
      steps += "<a href=\"#step-" + number;
      steps += "\">" + number;
      steps += "</a>";
    }
    html += "<tr><td class=\"n\">" + std::to_string(i + 1) + "</td><td>" + html_escaped(part_name_text(line)) +
            "</td><td class=\"n\">" + std::to_string(line.count) + "</td><td class=\"n\">" + size_text(line.size) +
            "</td><td>" + (steps.empty() ? "base" : steps) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string cover(const WorkInstructions& instructions) {
  std::string html = "<section class=\"cover\"><h1>" + html_escaped(instructions.title) + "</h1>\n<p>" +
                     html_escaped(summary_text(instructions)) + "</p>\n" + picture(instructions.cover, "The assembly") +
                     "\n";
  if (!instructions.tools.empty()) html += "<h2>Tools</h2>\n" + list(instructions.tools);
  return html + parts_table(instructions) + "</section>\n";
}

std::string notes(const Instruction& step) {
  std::string html;
  for (std::size_t i = 0; i < step.notes.size();) {
    const InstructionNote::Kind kind = step.notes[i].kind;
    std::vector<std::string> texts;
    for (; i < step.notes.size() && step.notes[i].kind == kind; ++i) texts.push_back(step.notes[i].text);
    const bool warns = kind == InstructionNote::Kind::Warning;
    html += std::string(warns ? "<div class=\"caution\">" : "<div>") + "<h3>" + heading_of(kind) + "</h3>" +
            (texts.size() == 1 ? "<p>" + html_escaped(texts[0]) + "</p>\n" : list(texts)) + "</div>\n";
  }
  return html;
}

std::string step_section(const WorkInstructions& instructions, std::size_t index) {
  const Instruction& step = instructions.steps[index];
  const std::string number = std::to_string(index + 1);
  std::string html = "<section class=\"step\" id=\"step-" + number + "\"><h2><b>" + number + "</b> " +
                     html_escaped(step.title) + "</h2>\n<div class=\"columns\"><div>" +
                     picture(step.picture, "Step " + number + ": " + step.title) + "</div>\n<div><h3>Parts</h3><ul>";
  for (const CountedPart& part : step.parts) html += "<li>" + html_escaped(part_text(instructions, part)) + "</li>";
  html += "</ul>\n" + notes(step);
  if (step.overview) html += picture(*step.overview, "Overview", " class=\"overview\"");
  return html + "</div></div></section>\n";
}

}  // namespace

std::string instructions_page(const WorkInstructions& instructions) {
  std::string html = std::string(kStart) + "<title>" + html_escaped(instructions.title) + "</title>\n<style>" + kStyle +
                     "</style>\n</head>\n<body>\n" + cover(instructions);
  for (std::size_t i = 0; i < instructions.steps.size(); ++i) html += step_section(instructions, i);
  return html + "<footer>" + html_escaped(kInstructionsFooter) + "</footer>\n</body>\n</html>\n";
}

}  // namespace dismantle
