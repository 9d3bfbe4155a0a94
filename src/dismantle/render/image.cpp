// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/image.h"

#include "dismantle/files/atomic_file.h"

#include <png.h>

#include <string_view>

namespace dismantle {

std::vector<std::uint8_t> encode_png(const Image& image) {
  DISMANTLE_EXPECT(image.width > 0 && image.height > 0);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;

  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::uint8_t> bytes(size);
  const int written = png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
  DISMANTLE_ENSURE(written != 0);
  bytes.resize(written != 0 ? size : 0);
  return bytes;
}

Result<Done> write_png(const Image& image, const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  return write_file(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace dismantle
