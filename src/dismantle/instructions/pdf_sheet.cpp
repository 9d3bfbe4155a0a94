// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/pdf_sheet.h"

#include "dismantle/instructions/font_coverage.h"
#include "dismantle/instructions/pango_text.h"
#include "dismantle/math/angle.h"

#include <cairo-pdf.h>

#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
/// fontconfig never frees its configuration, which LeakSanitizer would report.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}
#endif

namespace dismantle {

namespace {

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// A time as cairo wants it: "2026-11-25T22:10:00Z".
std::string time_text(std::int64_t time) {
  const auto seconds = static_cast<std::time_t>(time);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

struct PdfSheet::Impl {
  std::string file;
  Owned<cairo_surface_t> surface;
  Owned<cairo_t> cairo;
  Owned<PangoFontMap> fonts{pango_cairo_font_map_new()};
  Owned<PangoContext> context{pango_font_map_create_context(fonts.get())};
  FontCoverage coverage;

  Owned<PangoLayout> layout(const std::string& text, double width, const TextStyle& style) const {
    Owned<PangoLayout> made(pango_layout_new(context.get()));
    const Owned<PangoFontDescription> font(pango_font_description_from_string(kFontFamily));
    pango_font_description_set_absolute_size(font.get(), style.size * PANGO_SCALE);
    if (style.bold) pango_font_description_set_weight(font.get(), PANGO_WEIGHT_BOLD);
    pango_layout_set_font_description(made.get(), font.get());
    pango_layout_set_width(made.get(), static_cast<int>(std::lround(width * PANGO_SCALE)));
    pango_layout_set_wrap(made.get(), PANGO_WRAP_WORD_CHAR);
    if (style.right) pango_layout_set_alignment(made.get(), PANGO_ALIGN_RIGHT);
    const std::string valid = coverage.drawable(text);
    pango_layout_set_text(made.get(), valid.data(), static_cast<int>(valid.size()));
    return made;
  }
};

PdfSheet::PdfSheet(const PdfMetadata& metadata, const PaperSize& paper) : impl_(std::make_unique<Impl>()) {
  impl_->surface.reset(cairo_pdf_surface_create_for_stream(append, &impl_->file, paper.width, paper.height));
  const auto set = [&](cairo_pdf_metadata_t entry, const std::string& text) {
    const std::string valid = valid_utf8(text);
    cairo_pdf_surface_set_metadata(impl_->surface.get(), entry, valid.c_str());
  };
  set(CAIRO_PDF_METADATA_TITLE, metadata.title);
  if (!metadata.author.empty()) set(CAIRO_PDF_METADATA_AUTHOR, metadata.author);
  set(CAIRO_PDF_METADATA_CREATOR, "dismantle");
  set(CAIRO_PDF_METADATA_CREATE_DATE, time_text(metadata.time));
  impl_->cairo.reset(cairo_create(impl_->surface.get()));
}

PdfSheet::~PdfSheet() = default;

void PdfSheet::next_page() {
  cairo_show_page(impl_->cairo.get());
}

double PdfSheet::text_height(const std::string& text, double width, const TextStyle& style) const {
  int height = 0;
  pango_layout_get_size(impl_->layout(text, width, style).get(), nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

double PdfSheet::draw_text(const std::string& text, double x, double y, double width, const TextStyle& style) {
  const Owned<PangoLayout> layout = impl_->layout(text, width, style);
  cairo_set_source_rgb(impl_->cairo.get(), kInk.r, kInk.g, kInk.b);
  cairo_move_to(impl_->cairo.get(), x, y);
  pango_cairo_show_layout(impl_->cairo.get(), layout.get());
  int height = 0;
  pango_layout_get_size(layout.get(), nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

double PdfSheet::draw_image(const Image& image, double x, double y, double width) {
  const double scale = width / image.width, height = image.height * scale;
  const Owned<cairo_surface_t> picture(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  unsigned char* const bytes = cairo_image_surface_get_data(picture.get());
  if (bytes == nullptr) return height;  // finish() reports the error
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(picture.get()));
  cairo_surface_flush(picture.get());
  for (int row = 0; row < image.height; ++row) {
    auto* const out = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::size_t>(row) * stride);
    for (int column = 0; column < image.width; ++column) {
      const Pixel& p = image.at(column, row);
      out[column] = static_cast<std::uint32_t>(p.r) << 16 | static_cast<std::uint32_t>(p.g) << 8 | p.b;
    }
  }
  cairo_surface_mark_dirty(picture.get());

  cairo_t* const cairo = impl_->cairo.get();
  cairo_save(cairo);
  cairo_translate(cairo, x, y);
  cairo_scale(cairo, scale, scale);
  cairo_set_source_surface(cairo, picture.get(), 0, 0);
  cairo_paint(cairo);
  cairo_restore(cairo);
  cairo_set_source_rgb(cairo, 0.79, 0.82, 0.85);
  cairo_set_line_width(cairo, 0.5);
  cairo_rectangle(cairo, x, y, width, height);
  cairo_stroke(cairo);
  return height;
}

void PdfSheet::draw_balloon(const std::string& text, double x, double y, double radius) {
  cairo_t* const cairo = impl_->cairo.get();
  cairo_new_path(cairo);
  cairo_arc(cairo, x, y, radius, 0, kTurn);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_fill_preserve(cairo);
  cairo_set_source_rgb(cairo, kInk.r, kInk.g, kInk.b);
  cairo_set_line_width(cairo, 0.7);
  cairo_stroke(cairo);
  const Owned<PangoLayout> layout = impl_->layout(text, 4 * radius, {1.15 * radius, true});
  pango_layout_set_alignment(layout.get(), PANGO_ALIGN_CENTER);
  int height = 0;
  pango_layout_get_size(layout.get(), nullptr, &height);
  cairo_move_to(cairo, x - 2 * radius, y - 0.5 * height / PANGO_SCALE);
  pango_cairo_show_layout(cairo, layout.get());
}

void PdfSheet::draw_line(double x0, double y0, double x1, double y1, double line_width, const Color& color) {
  cairo_t* const cairo = impl_->cairo.get();
  cairo_set_source_rgb(cairo, color.r, color.g, color.b);
  cairo_set_line_width(cairo, line_width);
  cairo_move_to(cairo, x0, y0);
  cairo_line_to(cairo, x1, y1);
  cairo_stroke(cairo);
}

Result<std::string> PdfSheet::finish() {
  cairo_show_page(impl_->cairo.get());
  const cairo_status_t drawn = cairo_status(impl_->cairo.get());
  cairo_surface_finish(impl_->surface.get());
  const cairo_status_t status = drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_status(impl_->surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    return Error{ErrorKind::Failed, std::string("the PDF could not be written (") + cairo_status_to_string(status) +
                                        "); write an .html instead"};
  return std::move(impl_->file);
}

}  // namespace dismantle
