// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace dismantle {

template <class T>
std::string bytes_from(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A binary glTF of these parts, unchecked.
inline std::string glb_of(std::string json, std::string_view binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto size = [](std::size_t n) { return bytes_from(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)}); };
  return "glTF" + size(2) + size(28 + json.size() + binary.size()) + size(json.size()) + "JSON" + json +
         size(binary.size()) + std::string("BIN\0", 4) + std::string(binary);
}

/// A tetrahedron in metres: four positions (48 bytes), then twelve indices of 16 bit (24 bytes).
inline std::string tetrahedron_bytes() {
  return bytes_from(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         bytes_from(std::vector<std::uint16_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

/// The JSON of a file whose binary part is tetrahedron_bytes(), mesh 0 being the tetrahedron; `nodes` is the JSON of
/// the node list, `more` of further members (each with a comma before it).
inline std::string tetrahedron_json(const std::string& nodes, const std::string& more = "",
                                    const std::string& buffer = R"({"byteLength": 72})") {
  return R"({"asset": {"version": "2.0"}, "buffers": [)" + buffer + R"(],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "meshes": [{"name": "tetra", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "nodes": [)" +
         nodes + "]" + more + "}";
}

}  // namespace dismantle
