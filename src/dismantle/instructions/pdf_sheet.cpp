// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/pdf_sheet.h"

#include <cairo-pdf.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <cstdint>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
/// What fontconfig keeps of its configuration counts as leaked.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}
#endif

namespace dismantle {

namespace {

/// A PDF has a time of making; the same input gives the same bytes, so it is always this one.
constexpr const char* kNoTime = "2000-01-01T00:00:00Z";

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  void operator()(PangoFontMap* fonts) const { g_object_unref(fonts); }
  void operator()(PangoContext* context) const { g_object_unref(context); }
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
  void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

std::string valid_utf8(const std::string& text) {
  gchar* made = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  std::string valid(made);
  g_free(made);
  return valid;
}

}  // namespace

struct PdfSheet::Body {
  std::string file;
  Owned<cairo_surface_t> surface;
  Owned<cairo_t> cairo;
  Owned<PangoFontMap> fonts{pango_cairo_font_map_new()};
  Owned<PangoContext> context{pango_font_map_create_context(fonts.get())};

  Owned<PangoLayout> layout(const std::string& text, double width, const TextStyle& style) const {
    Owned<PangoLayout> made(pango_layout_new(context.get()));
    const Owned<PangoFontDescription> font(pango_font_description_from_string("Sans"));
    pango_font_description_set_absolute_size(font.get(), style.size * PANGO_SCALE);
    if (style.bold) pango_font_description_set_weight(font.get(), PANGO_WEIGHT_BOLD);
    pango_layout_set_font_description(made.get(), font.get());
    pango_layout_set_width(made.get(), static_cast<int>(std::lround(width * PANGO_SCALE)));
    pango_layout_set_wrap(made.get(), PANGO_WRAP_WORD_CHAR);
    if (style.right) pango_layout_set_alignment(made.get(), PANGO_ALIGN_RIGHT);
    const std::string valid = valid_utf8(text);
    pango_layout_set_text(made.get(), valid.data(), static_cast<int>(valid.size()));
    return made;
  }
};

PdfSheet::PdfSheet(const std::string& title) : body_(std::make_unique<Body>()) {
  body_->surface.reset(cairo_pdf_surface_create_for_stream(append, &body_->file, kWidth, kHeight));
  cairo_pdf_surface_set_metadata(body_->surface.get(), CAIRO_PDF_METADATA_TITLE, valid_utf8(title).c_str());
  cairo_pdf_surface_set_metadata(body_->surface.get(), CAIRO_PDF_METADATA_CREATOR, "dismantle");
  cairo_pdf_surface_set_metadata(body_->surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kNoTime);
  body_->cairo.reset(cairo_create(body_->surface.get()));
}

PdfSheet::~PdfSheet() = default;

void PdfSheet::next_page() {
  cairo_show_page(body_->cairo.get());
}

double PdfSheet::text_height(const std::string& text, double width, const TextStyle& style) const {
  int height = 0;
  pango_layout_get_size(body_->layout(text, width, style).get(), nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

double PdfSheet::put_text(const std::string& text, double x, double y, double width, const TextStyle& style) {
  const Owned<PangoLayout> layout = body_->layout(text, width, style);
  cairo_set_source_rgb(body_->cairo.get(), 0.1, 0.13, 0.18);
  cairo_move_to(body_->cairo.get(), x, y);
  pango_cairo_show_layout(body_->cairo.get(), layout.get());
  int height = 0;
  pango_layout_get_size(layout.get(), nullptr, &height);
  return static_cast<double>(height) / PANGO_SCALE;
}

double PdfSheet::put_picture(const Image& image, double x, double y, double width) {
  const double scale = width / image.width, height = image.height * scale;
  const Owned<cairo_surface_t> picture(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height));
  unsigned char* const bytes = cairo_image_surface_get_data(picture.get());
  if (bytes == nullptr) return height;  // finish() tells
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

  cairo_t* const cairo = body_->cairo.get();
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

void PdfSheet::put_line(double x0, double y0, double x1, double y1, double line_width) {
  cairo_t* const cairo = body_->cairo.get();
  cairo_set_source_rgb(cairo, 0.1, 0.13, 0.18);
  cairo_set_line_width(cairo, line_width);
  cairo_move_to(cairo, x0, y0);
  cairo_line_to(cairo, x1, y1);
  cairo_stroke(cairo);
}

Result<std::string> PdfSheet::finish() {
  cairo_show_page(body_->cairo.get());
  const cairo_status_t drawn = cairo_status(body_->cairo.get());
  cairo_surface_finish(body_->surface.get());
  const cairo_status_t status = drawn != CAIRO_STATUS_SUCCESS ? drawn : cairo_surface_status(body_->surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    return Error{ErrorKind::Failed, std::string("the PDF could not be made (") + cairo_status_to_string(status) +
                                        "); write an .html instead"};
  return std::move(body_->file);
}

}  // namespace dismantle
