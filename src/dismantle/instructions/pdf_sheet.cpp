// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/pdf_sheet.h"

#include <cairo-pdf.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <cstdint>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
/// fontconfig never frees its configuration, which LeakSanitizer would report.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}
#endif

namespace dismantle {

namespace {

/// A constant creation time, so that the same input gives the same bytes.
constexpr const char* kCreationTime = "2000-01-01T00:00:00Z";

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

struct PdfSheet::Impl {
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

PdfSheet::PdfSheet(const std::string& title) : impl_(std::make_unique<Impl>()) {
  impl_->surface.reset(cairo_pdf_surface_create_for_stream(append, &impl_->file, kWidth, kHeight));
  cairo_pdf_surface_set_metadata(impl_->surface.get(), CAIRO_PDF_METADATA_TITLE, valid_utf8(title).c_str());
  cairo_pdf_surface_set_metadata(impl_->surface.get(), CAIRO_PDF_METADATA_CREATOR, "dismantle");
  cairo_pdf_surface_set_metadata(impl_->surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kCreationTime);
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
  cairo_set_source_rgb(impl_->cairo.get(), 0.1, 0.13, 0.18);
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

void PdfSheet::draw_line(double x0, double y0, double x1, double y1, double line_width) {
  cairo_t* const cairo = impl_->cairo.get();
  cairo_set_source_rgb(cairo, 0.1, 0.13, 0.18);
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
