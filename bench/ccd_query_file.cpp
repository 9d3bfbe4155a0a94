// SPDX-License-Identifier: Apache-2.0
#include "bench/ccd_query_file.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

namespace dismantle {

namespace {

static_assert(std::endian::native == std::endian::little, "query sets are read as little-endian memory");

constexpr char kMagic[8] = {'C', 'C', 'D', 'Q', '1', '\0', '\0', '\0'};
constexpr std::size_t kHeaderBytes = 32;
constexpr std::size_t kQueryBytes = 24 * sizeof(double);

struct Header {
  char magic[8];
  std::uint32_t count;
  std::uint32_t type;
  char zero[16];
};
static_assert(sizeof(Header) == kHeaderBytes);

Error unreadable(const std::filesystem::path& file, const std::string& why, const std::string& advice) {
  return {ErrorKind::Unreadable, "cannot read " + file.string() + " (" + why + "); " + advice};
}

/// The eight points of a query: four at t = 0, the same four at t = 1.
struct Points {
  Vec3 at_t0[4], at_t1[4];
};
static_assert(sizeof(Points) == kQueryBytes);

bool all_finite(const Points& p) {
  for (int i = 0; i < 4; ++i)
    if (!is_finite(p.at_t0[i]) || !is_finite(p.at_t1[i])) return false;
  return true;
}

void add_query(CcdQueryFile& queries, const Points& p, bool vertex_face) {
  const Vec3 *s = p.at_t0, *e = p.at_t1;
  if (vertex_face) {
    queries.vertex_face.push_back({s[0], e[0], {s[1], s[2], s[3]}, {e[1], e[2], e[3]}});
  } else {
    queries.edge_edge.push_back({{s[0], s[1]}, {e[0], e[1]}, {s[2], s[3]}, {e[2], e[3]}});
  }
}

}  // namespace

Result<CcdQueryFile> read_ccdq(const std::filesystem::path& file) {
  std::error_code no_size;
  const std::uintmax_t size = std::filesystem::file_size(file, no_size);
  std::ifstream in(file, std::ios::binary);
  if (no_size || !in) return unreadable(file, "it is missing or not readable", "check the name");
  Header header;
  if (size < kHeaderBytes || !in.read(reinterpret_cast<char*>(&header), kHeaderBytes) ||
      std::memcmp(header.magic, kMagic, sizeof kMagic) != 0)
    return unreadable(file, "it does not begin with CCDQ1", "give a .ccdq query set");
  if (header.type > 1)
    return unreadable(file, "unknown query type " + std::to_string(header.type),
                      "use 0 (vertex-face) or 1 (edge-edge)");
  for (const char c : header.zero)
    if (c != 0) return unreadable(file, "reserved header bytes are not zero", "write the file as version 1");
  const std::uintmax_t expected = kHeaderBytes + std::uintmax_t{header.count} * (kQueryBytes + 1);
  if (size != expected)
    return unreadable(file,
                      std::to_string(header.count) + " queries need " + std::to_string(expected) + " bytes, it has " +
                          std::to_string(size),
                      "get a complete copy");

  CcdQueryFile queries;
  for (std::uint32_t i = 0; i < header.count; ++i) {
    Points points;
    if (!in.read(reinterpret_cast<char*>(&points), kQueryBytes))
      return unreadable(file, "reading stopped before the end", "check the disk");
    if (!all_finite(points))
      return unreadable(file, "query " + std::to_string(i) + " has a coordinate that is not finite", "remove it");
    add_query(queries, points, header.type == 0);
  }
  queries.truth.resize(header.count);
  if (!in.read(reinterpret_cast<char*>(queries.truth.data()), header.count))
    return unreadable(file, "reading stopped before the end", "check the disk");
  for (std::uint32_t i = 0; i < header.count; ++i)
    if (queries.truth[i] > CcdTruth::Unknown)
      return unreadable(file, "query " + std::to_string(i) + " has a truth that is not 0, 1 or 2", "correct it");
  return queries;
}

}  // namespace dismantle
