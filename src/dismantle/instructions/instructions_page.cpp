// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_page.h"

#include "dismantle/files/number_text.h"
#include "dismantle/render/camera.h"
#include "dismantle/report/html_text.h"

#include <initializer_list>
#include <string>
#include <string_view>

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

/// The rule of the paper follows it.
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
figure { position: relative; width: fit-content; margin: 0; } .cover figure { margin: 16px 0; } .cover figure img { margin: 0; } figure svg { position: absolute; inset: 0; width: 100%; height: 100%; }
svg text { font-size: 13px; font-weight: bold; text-anchor: middle; dominant-baseline: central; }
figure svg.axes { inset: auto auto 6px 6px; width: 76px; height: 76px; }
.block { width: auto; margin: 8px 0; } .block th { padding-right: 2em; } .assembled { width: 42%; }
@media print { body { max-width: none; padding: 0; font-size: 10pt; } .cover { break-after: page; } h2 { font-size: 14pt; } }
)";

std::string picture(const Image& image, const std::string& alternative, const char* style = "") {
  return "<img src=\"" + png_data_url(encode_png(image)) + "\" width=\"" + std::to_string(image.width) +
         "\" height=\"" + std::to_string(image.height) + "\" alt=\"" + html_escaped(alternative) + "\"" + style + "/>";
}

std::string number(double value) {
  return number_text(value, 6, 0.01);
}

/// A picture with a layer of lines and texts.
std::string figure(const std::string& image, const std::string& layer) {
  return "<figure>" + image + layer + "</figure>";
}

void append(std::string& text, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts) text += part;
}

/// Balloons over a picture and their leaders.
std::string balloon_layer(const ExplodedOverview& overview) {
  const double width = overview.picture.width, height = overview.picture.height;
  std::string lines, marks;
  for (const Balloon& balloon : overview.balloons) {
    const std::string x = number(balloon.place.x * width), y = number(balloon.place.y * height);
    const std::string to_x = number(balloon.anchor.x * width), to_y = number(balloon.anchor.y * height);
    const std::string item = std::to_string(balloon.item + 1);
    append(lines, {"<line x1=\"", x, "\" y1=\"", y, "\" x2=\"", to_x, "\" y2=\"", to_y,
                   "\" stroke=\"#1c2430\"/><circle cx=\"", to_x, "\" cy=\"", to_y, "\" r=\"2\"/>"});
    append(marks, {"<circle cx=\"", x, "\" cy=\"", y, "\" r=\"14\" fill=\"#fff\" stroke=\"#1c2430\"/><text x=\"", x,
                   "\" y=\"", y, "\">", item, "</text>"});
  }
  return "<svg viewBox=\"0 0 " + number(width) + " " + number(height) + "\" aria-hidden=\"true\">" + lines + marks +
         "</svg>";
}

/// The axes of the assembly as a picture with this viewing direction shows them.
std::string axes_layer(const Vec3& view) {
  if (view == Vec3{}) return {};
  constexpr double kMiddle = 38, kLength = 24, kLetter = 32;
  constexpr const char* kColors[3] = {"#c62828", "#1b7a2a", "#2850c8"};
  CameraFit fit;
  fit.direction = view;
  const Mat3 axes = camera_axes(fit_camera({}, fit));
  std::string svg =
      "<svg class=\"axes\" viewBox=\"0 0 76 76\" "
      "aria-hidden=\"true\">";
  for (int k = 0; k < 3; ++k) {
    Vec3 unit;
    unit[k] = 1;
    const Vec3 seen = axes * unit;
    svg += "<line x1=\"38\" y1=\"38\" x2=\"" + number(kMiddle + kLength * seen.x) + "\" y2=\"" +
           number(kMiddle - kLength * seen.y) + "\" stroke-width=\"2\" stroke=\"" + kColors[k] + "\"/><text x=\"" +
           number(kMiddle + kLetter * seen.x) + "\" y=\"" + number(kMiddle - kLetter * seen.y) + "\" fill=\"" +
           kColors[k] + "\">" + "XYZ"[k] + "</text>";
  }
  return svg + "</svg>";
}

std::string title_block(const TitleBlock& block) {
  std::string rows;
  for (const auto& [heading, text] : title_block_entries(block))
    rows += "<tr><th>" + heading + "</th><td>" + html_escaped(text) + "</td></tr>";
  return rows.empty() ? rows : "<table class=\"block\"><tbody>" + rows + "</tbody></table>\n";
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
                     html_escaped(summary_text(instructions)) + "</p>\n" + title_block(instructions.title_block) +
                     picture(instructions.cover, "The assembly", " class=\"assembled\"") + "\n";
  if (instructions.exploded.picture.width > 0)
    html += figure(picture(instructions.exploded.picture, "Exploded view; the numbers are those of the parts list"),
                   balloon_layer(instructions.exploded)) +
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
                     figure(picture(step.picture, "Step " + number + ": " + step.title), axes_layer(step.view)) +
                     "</div>\n<div><h3>Parts</h3><ul>";
  for (const CountedPart& part : step.parts) html += "<li>" + html_escaped(part_text(instructions, part)) + "</li>";
  html += "</ul>\n" + notes(step);
  if (step.overview) html += picture(*step.overview, "Overview", " class=\"overview\"");
  return html + "</div></div></section>\n";
}

}  // namespace

std::string instructions_page(const WorkInstructions& instructions, const PaperSize& paper) {
  std::string html = std::string(kStart) + "<title>" + html_escaped(instructions.title) + "</title>\n<style>" + kStyle +
                     "@page { size: " + (paper == kPaperLetter ? "letter" : "A4") +
                     "; margin: 14mm; }\n</style>\n</head>\n<body>\n" + cover(instructions);
  for (std::size_t i = 0; i < instructions.steps.size(); ++i) html += step_section(instructions, i);
  return html + "<footer>" + html_escaped(kInstructionsFooter) + "</footer>\n</body>\n</html>\n";
}

}  // namespace dismantle
