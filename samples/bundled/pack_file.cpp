// SPDX-License-Identifier: Apache-2.0
// Build step: pack_file INPUT OUTPUT writes the input's size (8 bytes, little endian) and its zlib stream.
#include <zlib.h>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream input(argv[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(input), {}};
  if (!input.good() && !input.eof()) {
    std::fprintf(stderr, "pack_file: cannot read %s\n", argv[1]);
    return 1;
  }
  uLongf length = compressBound(static_cast<uLong>(text.size()));
  std::vector<Bytef> stream(length);
  if (compress2(stream.data(), &length, reinterpret_cast<const Bytef*>(text.data()), static_cast<uLong>(text.size()),
                Z_BEST_COMPRESSION) != Z_OK)
    return 1;
  std::ofstream output(argv[2], std::ios::binary);
  for (int i = 0; i < 8; ++i) output.put(static_cast<char>(static_cast<std::uint64_t>(text.size()) >> (8 * i) & 0xff));
  output.write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(length));
  return output.flush().good() ? 0 : 1;
}
