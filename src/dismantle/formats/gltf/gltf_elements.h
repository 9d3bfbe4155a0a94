// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/formats/gltf/gltf_document.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace dismantle {

/// The elements of an accessor, read straight from the buffers' bytes; nothing is copied.
class GltfElements {
 public:
  /// Compares everything that the accessor claims with the bytes that there are. `buffers`: the bytes of each buffer
  /// of the document; they must outlive this. Errors: Unreadable where it reaches beyond a view or a view beyond its
  /// buffer, where sparse indices do not ascend, or where it has no bytes at all but more elements than the buffers
  /// have bytes.
  static Result<GltfElements> open(const GltfDocument& document, std::size_t accessor,
                                   const std::vector<std::string_view>& buffers, const std::string& file_name);

  std::size_t count() const { return count_; }
  /// Element `i` of a VEC3 accessor; normalised integers as glTF maps them to [-1, 1].
  Vec3 vec3(std::size_t i) const;
  /// Element `i` of a scalar accessor of whole numbers.
  std::uint32_t index(std::size_t i) const;

 private:
  /// Values at a fixed stride.
  struct Run {
    const char* first = nullptr;  // null: zeros
    std::size_t stride = 0;
    GltfScalar scalar = GltfScalar::Float32;
  };
  struct Claim;

  static bool find_run(const GltfDocument& document, const std::vector<std::string_view>& buffers, const Claim& claim,
                       Run& run);
  bool sparse_ascends() const;
  /// The place of element `i`: in the base run or in the sparse values.
  std::pair<const Run*, std::size_t> locate(std::size_t i) const;
  double value(const Run& run, std::size_t element, std::size_t k) const;

  std::size_t count_ = 0, sparse_count_ = 0;
  bool normalized_ = false;
  Run base_, sparse_indices_, sparse_values_;
};

}  // namespace dismantle
