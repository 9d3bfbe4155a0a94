// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/instructions_pdf.h"

#include "dismantle/render/camera.h"

#include <algorithm>

namespace dismantle {

namespace {

// All positions and sizes in points.
constexpr double kBorder = 40;
constexpr double kGap = 12;
constexpr double kPictureShare = 0.545;  // of a step, fraction of the width inside the borders
constexpr double kOverviewShare = 0.4;   // fraction of the text width
constexpr double kCoverShare = 0.42;     // of the assembled product, fraction of the width inside the borders
constexpr double kHeadingWidth = 56;     // of the title block
constexpr double kNoteGap = 4;
constexpr double kFooter = 16;                        // above the page number
constexpr double kNumberWidth = 50;                   // of the item number beside a step's title
constexpr double kAxisLength = 20, kAxisBorder = 34;  // of the axes in a picture
constexpr double kBalloonRadius = 8.5, kAnchorRadius = 1.2;
constexpr TextStyle kTitle{20, true}, kHeading{12, true}, kSmallHeading{8.5, true}, kText{9}, kNumber{9, false, true};
constexpr Color kAxisColors[3] = {{0.8f, 0.15f, 0.15f}, {0.1f, 0.55f, 0.15f}, {0.15f, 0.3f, 0.8f}};

/// A column of the parts list. Positions and widths are for a width of kColumnsWidth inside the borders.
struct Column {
  const char* head;
  double x, width;
  bool right;
};
constexpr double kColumnsWidth = 515;
constexpr Column kColumns[] = {{"Item", 0, 30, true},
                               {"Name", 40, 215, false},
                               {"Count", 260, 40, true},
                               {"Size [mm]", 305, 115, true},
                               {"Steps", 430, kColumnsWidth - 430, false}};

/// Layout pass: text is measured first and then drawn.
enum class LayoutPass { Measure, Draw };

/// Fills pages from top to bottom.
class PdfWriter {
 public:
  PdfWriter(const WorkInstructions& instructions, const InstructionsPdfOptions& options)
      : instructions_(instructions),
        paper_(options.paper),
        sheet_({instructions.title, instructions.title_block.author, options.time}, options.paper) {
    const TitleBlock& block = instructions.title_block;
    footer_ = instructions.title;
    if (!block.number.empty()) footer_ = block.number + "   " + footer_;
    if (!block.revision.empty()) footer_ += "   Revision " + block.revision;
  }

  Result<std::string> write() {
    write_cover();
    for (std::size_t i = 0; i < instructions_.steps.size(); ++i) write_step(i);
    end_page();
    return sheet_.finish();
  }

 private:
  void end_page() {
    const double y = paper_.height - kBorder;
    sheet_.draw_text(footer_, kBorder, y, inside_ - kNumberWidth, kText);
    sheet_.draw_text(std::to_string(++page_), kBorder, y, inside_, kNumber);
  }
  void begin_page() {
    end_page();
    sheet_.next_page();
    y_ = kBorder;
  }
  /// Begins a new page if less than `height` is left on this one.
  void reserve(double height) {
    if (y_ > kBorder && y_ + height > bottom_) begin_page();
  }
  void write_text(const std::string& text, const TextStyle& style) {
    reserve(sheet_.text_height(text, inside_, style));
    y_ += sheet_.draw_text(text, kBorder, y_, inside_, style);
  }

  void write_cover() {
    write_text(instructions_.title, kTitle);
    y_ += kGap / 2;
    write_title_block();
    write_exploded();
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

  /// The assembled product, and what identifies the document beside it.
  void write_title_block() {
    const double picture = kCoverShare * inside_, x = kBorder + picture + kGap, width = inside_ - picture - kGap;
    double y = y_;
    for (const auto& [heading, text] : title_block_entries(instructions_.title_block)) {
      sheet_.draw_text(heading, x, y, kHeadingWidth, kSmallHeading);
      y += sheet_.draw_text(text, x + kHeadingWidth, y, width - kHeadingWidth, kText) + 3;
    }
    if (y > y_) y += kNoteGap;
    y += sheet_.draw_text(summary_text(instructions_), x, y, width, kText);
    y_ = std::max(y, y_ + sheet_.draw_image(instructions_.cover, kBorder, y_, picture)) + kGap;
  }

  void write_exploded() {
    const Image& picture = instructions_.exploded.picture;
    if (picture.width == 0) return;
    const double height = inside_ * picture.height / picture.width;
    reserve(height);
    sheet_.draw_image(picture, kBorder, y_, inside_);
    const auto at = [&](const PicturePoint& p) { return PicturePoint{kBorder + p.x * inside_, y_ + p.y * height}; };
    for (const Balloon& balloon : instructions_.exploded.balloons) {
      const PicturePoint from = at(balloon.place), to = at(balloon.anchor);
      sheet_.draw_line(from.x, from.y, to.x, to.y, 0.5);
    }
    for (const Balloon& balloon : instructions_.exploded.balloons) {
      const PicturePoint from = at(balloon.place), to = at(balloon.anchor);
      sheet_.draw_balloon("", to.x, to.y, kAnchorRadius);
      sheet_.draw_balloon(std::to_string(balloon.item + 1), from.x, from.y, kBalloonRadius);
    }
    y_ += height + kGap;
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
        height = std::max(height, sheet_.text_height(cells[k], scale_ * kColumns[k].width, kText));
      if (y_ + height > bottom_) {
        begin_page();
        write_header();
      }
      for (std::size_t k = 0; k < std::size(kColumns); ++k) draw_cell(kColumns[k], cells[k], kText);
      y_ += height + 2;
    }
  }
  void write_header() {
    for (const Column& column : kColumns) draw_cell(column, column.head, kSmallHeading);
    y_ += sheet_.text_height("Item", inside_, kSmallHeading) + 2;
    sheet_.draw_line(kBorder, y_, kBorder + inside_, y_, 0.7);
    y_ += 3;
  }
  void draw_cell(const Column& column, const std::string& text, TextStyle style) {
    style.right = column.right;
    sheet_.draw_text(text, kBorder + scale_ * column.x, y_, scale_ * column.width, style);
  }

  /// Lays out the text beside a step's picture, from `y` down. @return its height
  double write_step_text(const Instruction& step, double y, LayoutPass pass) {
    const double x = kBorder + picture_width_ + kGap, top = y;
    const auto add = [&](const std::string& text, const TextStyle& style) {
      y += pass == LayoutPass::Draw ? sheet_.draw_text(text, x, y, text_width_, style)
                                    : sheet_.text_height(text, text_width_, style);
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
      const double width = kOverviewShare * text_width_;
      y += 6;
      if (pass == LayoutPass::Draw) sheet_.draw_image(*step.overview, x, y, width);
      y += width * step.overview->height / step.overview->width;
    }
    return y - top;
  }

  /// The axes of the assembly, as the picture with its lower left corner at (x, y) shows them.
  void draw_axes(const Vec3& view, double x, double y) {
    if (view == Vec3{}) return;
    CameraFit fit;
    fit.direction = view;
    const Mat3 axes = camera_axes(fit_camera({}, fit));
    const double middle_x = x + kAxisBorder, middle_y = y - kAxisBorder;
    for (int k = 0; k < 3; ++k) {
      Vec3 unit;
      unit[k] = 1;
      const Vec3 seen = axes * unit;
      const double end_x = middle_x + kAxisLength * seen.x, end_y = middle_y - kAxisLength * seen.y;
      sheet_.draw_line(middle_x, middle_y, end_x, end_y, 1.2, kAxisColors[k]);
      const double beyond = (kAxisLength + 6) / kAxisLength;
      sheet_.draw_text(std::string(1, "XYZ"[k]), middle_x + beyond * (end_x - middle_x) - 3,
                       middle_y + beyond * (end_y - middle_y) - 5.5, 12, kSmallHeading);
    }
  }

  void write_step(std::size_t index) {
    const Instruction& step = instructions_.steps[index];
    const std::string title = std::to_string(index + 1) + "   " + step.title;
    const double head = 6 + sheet_.text_height(title, title_width_, kHeading) + 6;
    const double picture = picture_width_ * step.picture.height / step.picture.width;
    const double body = std::max(picture, write_step_text(step, 0, LayoutPass::Measure));
    reserve(head + body);
    sheet_.draw_line(kBorder, y_, kBorder + inside_, y_, 1.2);
    sheet_.draw_text(title, kBorder, y_ + 6, title_width_, kHeading);
    if (step.parts.size() == 1)
      sheet_.draw_text("item " + std::to_string(step.parts[0].item + 1), kBorder, y_ + 8, inside_, kNumber);
    y_ += head;
    draw_axes(step.view, kBorder, y_ + sheet_.draw_image(step.picture, kBorder, y_, picture_width_));
    write_step_text(step, y_, LayoutPass::Draw);
    y_ += body + kGap;
  }

  const WorkInstructions& instructions_;
  const PaperSize paper_;
  const double inside_ = paper_.width - 2 * kBorder;  // the borders
  const double bottom_ = paper_.height - kBorder - kFooter;
  const double scale_ = inside_ / kColumnsWidth;  // of the columns
  const double picture_width_ = kPictureShare * inside_, text_width_ = inside_ - picture_width_ - kGap;
  const double title_width_ = inside_ - kNumberWidth;  // of a step
  PdfSheet sheet_;
  std::string footer_;
  double y_ = kBorder;
  std::size_t page_ = 0;  // number of finished pages
};

}  // namespace

Result<std::string> instructions_pdf(const WorkInstructions& instructions, const InstructionsPdfOptions& options) {
  return PdfWriter(instructions, options).write();
}

}  // namespace dismantle
