// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_pdf.h"

#include "dismantle/instructions/pdf_sheet.h"

#include <algorithm>

namespace dismantle {

namespace {

// All positions and sizes in points.
constexpr double kBorder = 40;
constexpr double kInside = PdfSheet::kWidth - 2 * kBorder;
constexpr double kBottom = PdfSheet::kHeight - kBorder - 16;  // above the page number
constexpr double kPictureWidth = 280, kGap = 12, kTextWidth = kInside - kPictureWidth - kGap;
constexpr double kOverviewShare = 0.4;  // fraction of the text width
constexpr double kNoteGap = 4;
constexpr double kTitleWidth = kInside - 50;  // leaves room for the item number
constexpr TextStyle kTitle{20, true}, kHeading{12, true}, kSmallHeading{8.5, true}, kText{9}, kNumber{9, false, true};

/// A column of the parts list.
struct Column {
  const char* head;
  double x, width;
  bool right;
};
constexpr Column kColumns[] = {{"Item", 0, 30, true},
                               {"Name", 40, 215, false},
                               {"Count", 260, 40, true},
                               {"Size [mm]", 305, 115, true},
                               {"Steps", 430, kInside - 430, false}};

/// Layout pass: text is measured first and then drawn.
enum class LayoutPass { Measure, Draw };

/// Fills pages from top to bottom.
class PdfWriter {
 public:
  explicit PdfWriter(const WorkInstructions& instructions) : instructions_(instructions), sheet_(instructions.title) {}

  Result<std::string> write() {
    write_cover();
    for (std::size_t i = 0; i < instructions_.steps.size(); ++i) write_step(i);
    end_page();
    return sheet_.finish();
  }

 private:
  void end_page() {
    const double y = PdfSheet::kHeight - kBorder;
    sheet_.draw_text(instructions_.title, kBorder, y, kInside, kText);
    sheet_.draw_text(std::to_string(++page_), kBorder, y, kInside, kNumber);
  }
  void begin_page() {
    end_page();
    sheet_.next_page();
    y_ = kBorder;
  }
  /// Begins a new page if less than `height` is left on this one.
  void reserve(double height) {
    if (y_ > kBorder && y_ + height > kBottom) begin_page();
  }
  void write_text(const std::string& text, const TextStyle& style) {
    reserve(sheet_.text_height(text, kInside, style));
    y_ += sheet_.draw_text(text, kBorder, y_, kInside, style);
  }

  void write_cover() {
    write_text(instructions_.title, kTitle);
    y_ += kGap / 2;
    write_text(summary_text(instructions_), kText);
    y_ += kGap;
    y_ += sheet_.draw_image(instructions_.cover, kBorder, y_, kInside) + kGap;
    if (!instructions_.tools.empty()) {
      write_text("Tools", kHeading);
      for (const std::string& tool : instructions_.tools) write_text(tool, kText);
      y_ += kGap;
    }
    write_parts();
    y_ += kGap / 2;
    write_text(kInstructionsFooter, kText);
    if (page_ == 0)
      begin_page();
    else
      y_ += kGap;
  }

  void write_parts() {
    write_text("Parts", kHeading);
    write_header();
    for (std::size_t i = 0; i < instructions_.parts.size(); ++i) {
      const PartsLine& line = instructions_.parts[i];
      std::string steps;
      for (const std::size_t step : line.steps) steps += (steps.empty() ? "" : ", ") + std::to_string(step);
      const std::string cells[] = {std::to_string(i + 1), part_name_text(line), std::to_string(line.count),
                                   size_text(line.size), steps.empty() ? "base" : steps};
      double height = 0;
      for (std::size_t k = 0; k < std::size(kColumns); ++k)
        height = std::max(height, sheet_.text_height(cells[k], kColumns[k].width, kText));
      if (y_ + height > kBottom) {
        begin_page();
        write_header();
      }
      for (std::size_t k = 0; k < std::size(kColumns); ++k) draw_cell(kColumns[k], cells[k], kText);
      y_ += height + 2;
    }
  }
  void write_header() {
    for (const Column& column : kColumns) draw_cell(column, column.head, kSmallHeading);
    y_ += sheet_.text_height("Item", kInside, kSmallHeading) + 2;
    sheet_.draw_line(kBorder, y_, kBorder + kInside, y_, 0.7);
    y_ += 3;
  }
  void draw_cell(const Column& column, const std::string& text, TextStyle style) {
    style.right = column.right;
    sheet_.draw_text(text, kBorder + column.x, y_, column.width, style);
  }

  /// Lays out the text beside a step's picture, from `y` down. @return its height
  double write_step_text(const Instruction& step, double y, LayoutPass pass) {
    const double x = kBorder + kPictureWidth + kGap, top = y;
    const auto add = [&](const std::string& text, const TextStyle& style) {
      y += pass == LayoutPass::Draw ? sheet_.draw_text(text, x, y, kTextWidth, style)
                                    : sheet_.text_height(text, kTextWidth, style);
    };
    if (step.parts.size() > 1) {
      add("Parts", kSmallHeading);
      for (const CountedPart& part : step.parts) add(part_text(instructions_, part), kText);
      y += kNoteGap;
    }
    for (std::size_t i = 0; i < step.notes.size(); ++i) {
      const InstructionNote& note = step.notes[i];
      if (i == 0 || step.notes[i - 1].kind != note.kind) {
        if (i > 0) y += kNoteGap;
        add(heading_of(note.kind), kSmallHeading);
      }
      add((note.kind == InstructionNote::Kind::Warning ? "\u26a0 " : "") + note.text, kText);
    }
    if (step.overview) {
      const double width = kOverviewShare * kTextWidth;
      y += 6;
      if (pass == LayoutPass::Draw) sheet_.draw_image(*step.overview, x, y, width);
      y += width * step.overview->height / step.overview->width;
    }
    return y - top;
  }

  void write_step(std::size_t index) {
    const Instruction& step = instructions_.steps[index];
    const std::string title = std::to_string(index + 1) + "   " + step.title;
    const double head = 6 + sheet_.text_height(title, kTitleWidth, kHeading) + 6;
    const double picture = kPictureWidth * step.picture.height / step.picture.width;
    const double body = std::max(picture, write_step_text(step, 0, LayoutPass::Measure));
    reserve(head + body);
    sheet_.draw_line(kBorder, y_, kBorder + kInside, y_, 1.2);
    sheet_.draw_text(title, kBorder, y_ + 6, kTitleWidth, kHeading);
    if (step.parts.size() == 1)
      sheet_.draw_text("item " + std::to_string(step.parts[0].item + 1), kBorder, y_ + 8, kInside, kNumber);
    y_ += head;
    sheet_.draw_image(step.picture, kBorder, y_, kPictureWidth);
    write_step_text(step, y_, LayoutPass::Draw);
    y_ += body + kGap;
  }

  const WorkInstructions& instructions_;
  PdfSheet sheet_;
  double y_ = kBorder;
  std::size_t page_ = 0;  // number of finished pages
};

}  // namespace

Result<std::string> instructions_pdf(const WorkInstructions& instructions) {
  return PdfWriter(instructions).write();
}

}  // namespace dismantle
