// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/render/image.h"

#include <memory>
#include <string>

namespace dismantle {

/// Style of a text.
struct TextStyle {
  double size = 9;     ///< [pt]
  bool bold = false;   ///< Bold instead of regular weight.
  bool right = false;  ///< Right-aligned.
};

/// A PDF document with A4 pages, drawn with cairo and Pango. Positions are in points (1/72 inch) from the upper left
/// corner.
class PdfSheet {
 public:
  static constexpr double kWidth = 595;   ///< [pt]
  static constexpr double kHeight = 842;  ///< [pt]

  /// Begins a document with one empty page. @param title of the document
  explicit PdfSheet(const std::string& title);
  ~PdfSheet();

  /// Ends the page and begins the next one.
  void next_page();
  /// Height of a text wrapped to a width [pt]. UTF-8; invalid bytes appear as U+FFFD.
  double text_height(const std::string& text, double width, const TextStyle& style = {}) const;
  /// Draws a text wrapped to a width. @return its height [pt]
  double draw_text(const std::string& text, double x, double y, double width, const TextStyle& style = {});
  /// Draws an image with a frame. @return its height [pt]
  double draw_image(const Image& image, double x, double y, double width);
  /// Draws a line from (x0, y0) to (x1, y1).
  void draw_line(double x0, double y0, double x1, double y1, double line_width);
  /// Ends the document. @return the file's bytes; nothing can be drawn afterwards. Errors: Failed.
  Result<std::string> finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
