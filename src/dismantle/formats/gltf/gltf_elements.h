// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/gltf_document.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace dismantle {

/// Read access to the elements of an accessor, directly in the buffers' bytes.
class GltfElements {
 public:
  /// Checks all offsets and counts of the accessor against the bytes that exist. `buffers`: the bytes of each buffer
  /// of the document; they must outlive this. Errors: Unreadable if it reaches beyond its view or the view beyond its
  /// buffer, if sparse indices do not ascend, or if it has no view but more elements than the buffers have bytes.
  static Result<GltfElements> open(const GltfDocument& document, std::size_t accessor,
                                   const std::vector<std::string_view>& buffers, const std::string& file_name);

  /// Number of elements.
  std::size_t count() const { return count_; }
  /// Element `i` of a VEC3 accessor; normalised integers as glTF maps them to [-1, 1].
  Vec3 vec3(std::size_t i) const;
  /// Element `i` of a scalar accessor of whole numbers.
  std::uint32_t index(std::size_t i) const;

 private:
  /// An array of values at a fixed stride.
  struct Run {
    const char* first = nullptr;  // null: zeros
    std::size_t stride = 0;
    GltfScalar scalar = GltfScalar::Float32;
  };
  struct Claim;

  static bool find_run(const GltfDocument& document, const std::vector<std::string_view>& buffers, const Claim& claim,
                       Run& run);
  bool sparse_ascends() const;
  /// Where element `i` is stored: the base run or the sparse values, and the index there.
  std::pair<const Run*, std::size_t> locate(std::size_t i) const;
  double value(const Run& run, std::size_t element, std::size_t k) const;

  std::size_t count_ = 0, sparse_count_ = 0;
  bool normalized_ = false;
  Run base_, sparse_indices_, sparse_values_;
};

}  // namespace dismantle
