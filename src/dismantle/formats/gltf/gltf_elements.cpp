// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/gltf/gltf_elements.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace dismantle {

namespace {

template <class T>
T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // glTF is little endian, as is every machine that this is built for
  return value;
}

std::uint32_t load_whole(const char* bytes, GltfScalar scalar) {
  switch (scalar) {
    case GltfScalar::UInt8:
      return load<std::uint8_t>(bytes);
    case GltfScalar::UInt16:
      return load<std::uint16_t>(bytes);
    case GltfScalar::UInt32:
      return load<std::uint32_t>(bytes);
    default:
      return Id<VertexTag>::kInvalid;  // signed or broken: no index
  }
}

double load_value(const char* bytes, GltfScalar scalar, bool normalized) {
  switch (scalar) {
    case GltfScalar::Float32:
      return load<float>(bytes);
    case GltfScalar::Int8:
      return normalized ? std::max(load<std::int8_t>(bytes) / 127.0, -1.0) : load<std::int8_t>(bytes);
    case GltfScalar::Int16:
      return normalized ? std::max(load<std::int16_t>(bytes) / 32767.0, -1.0) : load<std::int16_t>(bytes);
    case GltfScalar::UInt8:
      return normalized ? load<std::uint8_t>(bytes) / 255.0 : load<std::uint8_t>(bytes);
    case GltfScalar::UInt16:
      return normalized ? load<std::uint16_t>(bytes) / 65535.0 : load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

}  // namespace

/// Elements that an accessor declares within a view.
struct GltfElements::Claim {
  std::size_t view, offset, count, element_size;
  GltfScalar scalar;
};

bool GltfElements::find_run(const GltfDocument& document, const std::vector<std::string_view>& buffers,
                            const Claim& claim, Run& run) {
  const GltfView& view = document.views[claim.view];
  const std::string_view buffer = buffers[view.buffer];
  if (view.offset > buffer.size() || view.length > buffer.size() - view.offset) return false;
  run.scalar = claim.scalar;
  run.stride = view.stride > 0 ? view.stride : claim.element_size;
  run.first = buffer.data() + view.offset;
  if (claim.count == 0) return true;
  if (run.stride < claim.element_size || claim.offset > view.length) return false;
  const std::size_t room = view.length - claim.offset;
  if (room < claim.element_size || claim.count - 1 > (room - claim.element_size) / run.stride) return false;
  run.first += claim.offset;
  return true;
}

Result<GltfElements> GltfElements::open(const GltfDocument& document, std::size_t accessor,
                                        const std::vector<std::string_view>& buffers, const std::string& file_name) {
  const auto fail = [&](const std::string& why) {
    return Error{ErrorKind::Unreadable, file_name + " cannot be used (accessor " + std::to_string(accessor) + " " +
                                            why + "); it is cut off or broken, export it again"};
  };
  const GltfAccessor& a = document.accessors[accessor];
  const std::size_t element_size = static_cast<std::size_t>(a.width) * byte_size(a.scalar);
  GltfElements elements;
  elements.count_ = a.count;
  elements.normalized_ = a.normalized;
  if (a.view) {
    if (!find_run(document, buffers, {*a.view, a.offset, a.count, element_size, a.scalar}, elements.base_))
      return fail("reaches beyond its bytes");
  } else {
    std::size_t bytes = 0;
    for (const std::string_view buffer : buffers) bytes += buffer.size();
    if (a.count > bytes) return fail("has no bytes for what it claims");
  }
  if (!a.sparse) return elements;

  const GltfSparse& s = *a.sparse;
  elements.sparse_count_ = s.count;
  if (!find_run(document, buffers, {s.index_view, s.index_offset, s.count, byte_size(s.index_scalar), s.index_scalar},
                elements.sparse_indices_) ||
      !find_run(document, buffers, {s.value_view, s.value_offset, s.count, element_size, a.scalar},
                elements.sparse_values_))
    return fail("has sparse values beyond their bytes");
  if (!elements.sparse_ascends()) return fail("has sparse indices out of order");
  return elements;
}

bool GltfElements::sparse_ascends() const {
  std::uint64_t least = 0;
  for (std::size_t i = 0; i < sparse_count_; ++i) {
    const std::uint32_t at = load_whole(sparse_indices_.first + i * sparse_indices_.stride, sparse_indices_.scalar);
    if (at < least || at >= count_) return false;
    least = std::uint64_t{at} + 1;
  }
  return true;
}

std::pair<const GltfElements::Run*, std::size_t> GltfElements::locate(std::size_t i) const {
  std::size_t low = 0, high = sparse_count_;  // the first sparse index that is not below i
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const std::uint32_t at =
        load_whole(sparse_indices_.first + middle * sparse_indices_.stride, sparse_indices_.scalar);
    if (at == i) return {&sparse_values_, middle};
    (at < i ? low : high) = at < i ? middle + 1 : middle;
  }
  return {&base_, i};
}

double GltfElements::value(const Run& run, std::size_t element, std::size_t k) const {
  if (run.first == nullptr) return 0;
  return load_value(run.first + element * run.stride + k * byte_size(run.scalar), run.scalar, normalized_);
}

Vec3 GltfElements::vec3(std::size_t i) const {
  DISMANTLE_EXPECT(i < count_);
  const auto [run, element] = locate(i);
  return {value(*run, element, 0), value(*run, element, 1), value(*run, element, 2)};
}

std::uint32_t GltfElements::index(std::size_t i) const {
  DISMANTLE_EXPECT(i < count_);
  const auto [run, element] = locate(i);
  if (run->first == nullptr) return 0;
  return load_whole(run->first + element * run->stride, run->scalar);
}

}  // namespace dismantle
