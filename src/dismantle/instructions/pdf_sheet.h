// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/render/image.h"

#include <memory>
#include <string>

namespace dismantle {

/// How a piece of text looks.
struct TextStyle {
  double size = 9;  ///< [pt]
  bool bold = false;
  bool right = false;  ///< Flush with the right border.
};

/// Pages of A4 paper that text and pictures are put on. Places are in points (1/72 inch) from the upper left corner.
class PdfSheet {
 public:
  static constexpr double kWidth = 595, kHeight = 842;  ///< [pt]

  /// @param title of the document
  explicit PdfSheet(const std::string& title);
  ~PdfSheet();

  /// Ends the page, and begins another one.
  void next_page();
  /// How high text is that is broken to a width [pt]. UTF-8; what is not shows as U+FFFD.
  double text_height(const std::string& text, double width, const TextStyle& style = {}) const;
  /// Puts text, broken to a width. @return its height [pt]
  double put_text(const std::string& text, double x, double y, double width, const TextStyle& style = {});
  /// Puts a picture in a frame. @return its height [pt]
  double put_picture(const Image& image, double x, double y, double width);
  void put_line(double x0, double y0, double x1, double y1, double line_width);
  /// The whole file; nothing can be put any more. Errors: Failed.
  Result<std::string> finish();

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace dismantle
