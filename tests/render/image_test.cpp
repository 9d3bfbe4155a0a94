// SPDX-License-Identifier: Apache-2.0
#include "dismantle/render/image.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace dismantle {
namespace {

Image decode_png(const std::vector<std::uint8_t>& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) return image;
  header.format = PNG_FORMAT_RGB;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.pixels.resize(static_cast<std::size_t>(header.width) * header.height);
  png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr);
  return image;
}

Image random_image(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    const std::uint32_t bits = static_cast<std::uint32_t>(random());
    image.pixels.push_back(
        {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits >> 16)});
  }
  return image;
}

TEST(EncodePng, DecodesBackToTheSamePixels) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 3), std::pair(64, 129)}) {
    const Image image = random_image(width, height, 42);
    EXPECT_EQ(decode_png(encode_png(image)), image) << width << " x " << height;
  }
}

TEST(WritePng, WritesTheEncodedBytes) {
  const Image image = random_image(9, 5, 7);
  const auto file = std::filesystem::temp_directory_path() / "dismantle_image_test.png";
  ASSERT_TRUE(write_png(image, file).ok());
  std::ifstream stream(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(bytes, encode_png(image));
  std::filesystem::remove(file);
}

TEST(WritePng, ReportsAMissingFolder) {
  const Result<Done> result = write_png(random_image(2, 2, 1), "/nowhere/at/all/picture.png");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::Failed);
  EXPECT_NE(result.error().message.find("/nowhere/at/all/picture.png"), std::string::npos);
}

}  // namespace
}  // namespace dismantle
