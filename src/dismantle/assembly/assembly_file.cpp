// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/assembly_file.h"

#include "dismantle/assembly/assembly_bytes.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>

namespace dismantle {

namespace {

static_assert(std::endian::native == std::endian::little, ".dasm files are little-endian");

constexpr char kMagic[8] = {'d', 'i', 's', 'm', 'a', 'n', 't', 'l'};
constexpr std::uint32_t kVersion = 1;
constexpr double kRotationError = 1e-6;  // largest deviation of a rotation's matrix from an orthogonal one

void write_motion_bytes(const Motion& motion, ByteWriter& out) {
  out.value(static_cast<std::uint8_t>(motion.response));
  out.value<std::uint64_t>(motion.moves.size());
  for (const MotionMove& move : motion.moves) {
    out.value<std::uint64_t>(move.components.size());
    for (const std::string& name : move.components) out.text(name);
    out.value<std::uint64_t>(move.targets.size());
    for (const Frame& frame : move.targets) {
      out.value(frame.time);
      out.value(frame.pose.position);
      out.value(frame.pose.rotation);
    }
  }
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A rigid motion's matrix, up to rounding in other programs.
bool is_rigid(const RigidTransform& t) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (!(std::abs(dot(t.rotation.row[i], t.rotation.row[j]) - (i == j ? 1 : 0)) <= kRotationError)) return false;
  return determinant(t.rotation) > 0 && is_finite(t.translation);
}

std::optional<Frame> read_frame(ByteReader& in) {
  Frame frame;
  frame.time = in.value<double>();
  frame.pose.position = in.value<Vec3>();
  const auto rotation = in.value<Quat>();
  const double length = std::sqrt(dot(rotation, rotation));
  if (!in.ok() || !(std::abs(length - 1) <= kRotationError) || !is_finite(frame.pose.position) ||
      !std::isfinite(frame.time))
    return std::nullopt;
  frame.pose.rotation = rotation;
  return frame;
}

std::optional<Motion> read_motion_bytes(ByteReader& in, const Assembly& assembly) {
  Motion motion;
  const auto response = in.value<std::uint8_t>();
  if (response > static_cast<std::uint8_t>(ResponseKind::Slide)) return std::nullopt;
  motion.response = static_cast<ResponseKind>(response);
  motion.moves.resize(in.count(2 * sizeof(std::uint64_t)));
  for (MotionMove& move : motion.moves) {
    move.components.resize(in.count(sizeof(std::uint64_t)));
    for (std::string& name : move.components) {
      name = in.text();
      if (!assembly.find(name)) return std::nullopt;
    }
    move.targets.resize(in.count(8 * sizeof(double)));
    for (Frame& target : move.targets) {
      const std::optional<Frame> frame = read_frame(in);
      if (!frame) return std::nullopt;
      target = *frame;
    }
  }
  return in.ok() ? std::optional<Motion>(std::move(motion)) : std::nullopt;
}

/// Validates poses and coordinates. @return a description of the first fault; null if there is none
const char* fault_of(const Assembly& assembly) {
  for (const Component& component : assembly.components) {
    if (!is_rigid(component.assembly_from_mesh)) return "a component's pose is no rigid motion";
    for (const Vec3& vertex : component.mesh->vertices)
      if (!is_finite(vertex)) return "a coordinate is not a number";
  }
  return nullptr;
}

Error malformed_file(const std::string& file_name, const std::string& why) {
  return {ErrorKind::Unreadable,
          file_name + " cannot be read as DASM (" + why + "); write it again with dismantle convert"};
}

}  // namespace

std::string assembly_file_bytes(const Assembly& assembly, const Motion* motion) {
  std::string bytes;
  const ByteSink append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  ByteWriter out(append);
  append(kMagic, sizeof kMagic);
  out.value(kVersion);
  std::string body;
  write_assembly_bytes(
      assembly, [&body](const void* data, std::size_t size) { body.append(static_cast<const char*>(data), size); });
  out.value<std::uint64_t>(body.size());
  bytes += body;
  out.value<std::uint8_t>(motion != nullptr ? 1 : 0);
  if (motion != nullptr) write_motion_bytes(*motion, out);
  return bytes;
}

Result<AssemblyFile> parse_assembly_file(Span<const std::byte> bytes, const std::string& file_name) {
  if (bytes.size() < sizeof kMagic || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    return malformed_file(file_name, "it does not begin as one");
  ByteReader in(bytes.subspan(sizeof kMagic, bytes.size() - sizeof kMagic));
  const auto version = in.value<std::uint32_t>();
  if (in.ok() && version != kVersion)
    return malformed_file(file_name, "its version is " + std::to_string(version) +
                                         ", and this dismantle reads version " + std::to_string(kVersion));
  const std::size_t size = in.count(1);
  if (!in.ok()) return malformed_file(file_name, "it is cut off");
  const std::size_t begin = bytes.size() - in.left();
  std::optional<Assembly> assembly = assembly_from_bytes(bytes.subspan(begin, size));
  if (!assembly) return malformed_file(file_name, "its assembly is damaged");
  if (const char* fault = fault_of(*assembly)) return malformed_file(file_name, fault);
  ByteReader rest(bytes.subspan(begin + size, bytes.size() - begin - size));
  AssemblyFile file{std::move(*assembly), std::nullopt};
  if (rest.value<std::uint8_t>() != 0) {
    file.motion = read_motion_bytes(rest, file.assembly);
    if (!file.motion) return malformed_file(file_name, "its motion is damaged");
  }
  if (!rest.ok() || !rest.at_end()) return malformed_file(file_name, "it is cut off, or too long");
  return file;
}

Result<AssemblyFile> read_assembly_file(const std::filesystem::path& file, std::uint64_t limit_bytes) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) return malformed_file(file.string(), error.message());
  if (size > limit_bytes) return malformed_file(file.string(), "it is too large");
  std::ifstream in(file, std::ios::binary);
  std::vector<char> bytes(size);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
    return malformed_file(file.string(), "the system cannot read it");
  return parse_assembly_file({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()},
                             file.filename().string());
}

}  // namespace dismantle
