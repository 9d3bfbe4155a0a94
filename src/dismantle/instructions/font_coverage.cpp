// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/font_coverage.h"

#include "dismantle/instructions/pango_text.h"

#include <map>

namespace dismantle {

namespace {

constexpr const char* kReplacement = "\uFFFD";

}  // namespace

struct FontCoverage::Impl {
  Owned<PangoFontMap> fonts{pango_cairo_font_map_new()};
  Owned<PangoContext> context{pango_font_map_create_context(fonts.get())};
  Owned<PangoLayout> layout{pango_layout_new(context.get())};
  std::map<std::string, bool, std::less<>> known;  // characters that were asked for, and whether a font has them

  Impl() {
    const Owned<PangoFontDescription> font(pango_font_description_from_string(kFontFamily));
    pango_layout_set_font_description(layout.get(), font.get());
  }

  bool has_all(const std::string& text) const {
    pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
    return pango_layout_get_unknown_glyphs_count(layout.get()) == 0;
  }

  bool has(const std::string& character) {
    const auto found = known.find(character);
    return found != known.end() ? found->second : known.emplace(character, has_all(character)).first->second;
  }

  /// Calls `visit(character, known)` for each character of a valid text.
  template <class F>
  void for_each(const std::string& valid, const F& visit) {
    for (const char* at = valid.c_str(); *at != '\0'; at = g_utf8_next_char(at)) {
      const std::string character(at, static_cast<std::size_t>(g_utf8_next_char(at) - at));
      visit(character, has(character));
    }
  }
};

FontCoverage::FontCoverage() : impl_(std::make_unique<Impl>()) {}
FontCoverage::~FontCoverage() = default;
FontCoverage::FontCoverage(FontCoverage&&) noexcept = default;
FontCoverage& FontCoverage::operator=(FontCoverage&&) noexcept = default;

std::string FontCoverage::missing(const std::string& text) const {
  const std::string valid = valid_utf8(text);
  std::string found;
  if (impl_->has_all(valid)) return found;
  impl_->for_each(valid, [&](const std::string& character, bool known) {
    if (!known && found.find(character) == std::string::npos) found += character;
  });
  return found;
}

std::string FontCoverage::drawable(const std::string& text) const {
  std::string valid = valid_utf8(text);
  if (impl_->has_all(valid)) return valid;
  std::string drawn;
  impl_->for_each(valid, [&](const std::string& character, bool known) { drawn += known ? character : kReplacement; });
  return drawn;
}

}  // namespace dismantle
