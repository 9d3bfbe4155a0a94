// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/result.h"
#include "dismantle/render/image.h"

#include <cstdint>
#include <memory>
#include <string>

namespace dismantle {

/// Style of a text.
struct TextStyle {
  double size = 9;     ///< [pt]
  bool bold = false;   ///< Bold instead of regular weight.
  bool right = false;  ///< Right-aligned.
};

/// Colour of text and lines.
inline constexpr Color kInk{0.1f, 0.13f, 0.18f};

/// The size of a page.
struct PaperSize {
  double width = 595;   ///< [pt]
  double height = 842;  ///< [pt]

  friend bool operator==(const PaperSize&, const PaperSize&) = default;
};
inline constexpr PaperSize kPaperA4{595, 842};      ///< 210 mm x 297 mm.
inline constexpr PaperSize kPaperLetter{612, 792};  ///< 8.5 in x 11 in.

/// The metadata of a PDF document.
struct PdfMetadata {
  std::string title;      ///< UTF-8.
  std::string author;     ///< UTF-8; empty: none.
  std::int64_t time = 0;  ///< Time of creation [s since 1970, UTC].
};

/// A PDF document drawn with cairo and Pango. Positions are in points (1/72 inch) from the upper left corner. Fonts are
/// embedded; characters that no font of the system has are drawn as U+FFFD.
class PdfSheet {
 public:
  /// Begins a document with one empty page.
  PdfSheet(const PdfMetadata& metadata, const PaperSize& paper);
  ~PdfSheet();

  /// Ends the page and begins the next one.
  void next_page();
  /// Height of a text wrapped to a width [pt]. UTF-8; invalid bytes appear as U+FFFD.
  double text_height(const std::string& text, double width, const TextStyle& style = {}) const;
  /// Draws a text wrapped to a width. @return its height [pt]
  double draw_text(const std::string& text, double x, double y, double width, const TextStyle& style = {});
  /// Draws an image with a frame. @return its height [pt]
  double draw_image(const Image& image, double x, double y, double width);
  /// Draws a line from (x0, y0) to (x1, y1). @param color of the line
  void draw_line(double x0, double y0, double x1, double y1, double line_width, const Color& color = kInk);
  /// Draws a filled circle with a text in its middle, as a mark on a picture.
  void draw_balloon(const std::string& text, double x, double y, double radius);
  /// Ends the document. @return the file's bytes; nothing can be drawn afterwards. Errors: Failed.
  Result<std::string> finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dismantle
