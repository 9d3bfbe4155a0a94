// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace dismantle {

/// A pixel in sRGB.
struct Pixel {
  std::uint8_t r = 0;  ///< Red, 0 to 255.
  std::uint8_t g = 0;  ///< Green, 0 to 255.
  std::uint8_t b = 0;  ///< Blue, 0 to 255.
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// A raster image.
struct Image {
  int width = 0;              ///< [pixels]
  int height = 0;             ///< [pixels]
  std::vector<Pixel> pixels;  ///< Rows from top to bottom, shape [height][width].

  /// The pixel in column x of row y. @pre 0 <= x < width, 0 <= y < height
  const Pixel& at(int x, int y) const {
    DISMANTLE_EXPECT(x >= 0 && x < width && y >= 0 && y < height);
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
  friend bool operator==(const Image&, const Image&) = default;
};

/// Encodes an image as PNG (8-bit RGB). Deterministic. @pre width and height positive
std::vector<std::uint8_t> encode_png(const Image& image);

/// Writes an image as a PNG file, atomically. Errors: Failed.
Result<Done> write_png(const Image& image, const std::filesystem::path& file);

}  // namespace dismantle
