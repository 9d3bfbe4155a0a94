// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace dismantle {

/// One picture element, sRGB.
struct Pixel {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// A picture: rows from top to bottom. Shape [height][width].
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  /// @pre 0 <= x < width, 0 <= y < height
  const Pixel& at(int x, int y) const {
    DISMANTLE_EXPECT(x >= 0 && x < width && y >= 0 && y < height);
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  friend bool operator==(const Image&, const Image&) = default;
};

/// The picture as the bytes of a PNG file (8-bit RGB). Same picture, same bytes. @pre width and height positive
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes the picture as a PNG file, whole or not at all. Errors: Failed.
Result<Done> write_png(const Image& image, const std::filesystem::path& file);

}  // namespace dismantle
