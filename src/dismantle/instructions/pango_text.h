// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>
#include <pango/pangocairo.h>

#include <memory>
#include <string>

namespace dismantle {

/// The family that texts are set in; fontconfig finds fallbacks for characters that it lacks.
inline constexpr const char* kFontFamily = "Sans";

/// Releases objects of cairo and Pango.
struct Release {
  ///@{ One object.
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
  void operator()(PangoFontMap* fonts) const { g_object_unref(fonts); }
  void operator()(PangoContext* context) const { g_object_unref(context); }
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
  void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
  ///@}
};
/// An object of cairo or Pango that is owned.
template <class T>
using Owned = std::unique_ptr<T, Release>;

/// The text with U+FFFD in place of bytes that are not UTF-8.
std::string valid_utf8(const std::string& text);

}  // namespace dismantle
