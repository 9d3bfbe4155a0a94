// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dismantle {

/// A binary glTF, read without any of the code that wrote it, and its violations of glTF 2.0.
class CheckedGlb {
  using Json = nlohmann::json;

 public:
  explicit CheckedGlb(std::string bytes) : bytes_(std::move(bytes)) {
    if (!open()) return;
    check_nodes();
    for (std::size_t i = 0; i < list("bufferViews").size(); ++i) check_view(i);
    for (std::size_t i = 0; i < list("accessors").size(); ++i) check_accessor(i);
    if (!faults_.empty()) return;  // what follows reads them
    for (const Json& mesh : list("meshes"))
      for (const Json& primitive : mesh["primitives"]) check_primitive(primitive);
    for (const Json& animation : list("animations")) check_animation(animation);
  }

  const std::vector<std::string>& faults() const { return faults_; }
  const Json& json() const { return json_; }

  /// The values of an accessor of floats, `width` an element.
  std::vector<float> floats(std::size_t accessor) const {
    const Json& a = list("accessors")[accessor];
    std::vector<float> values(a["count"].get<std::size_t>() * width_of(a));
    std::memcpy(values.data(), data(a), values.size() * sizeof(float));
    return values;
  }

  /// The node of a component, by its name.
  std::size_t node_of(const std::string& component) const {
    for (std::size_t i = 0; i < list("nodes").size(); ++i)
      if (list("nodes")[i].value("extras", Json::object()).value("component", "") == component) return i;
    return list("nodes").size();
  }

  /// The times and values of an animation channel's keys; empty if there is no such channel.
  std::pair<std::vector<float>, std::vector<float>> keys(const Json& animation, std::size_t node,
                                                         const std::string& path) const {
    for (const Json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node || channel["target"]["path"] != path) continue;
      const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      return {floats(sampler["input"]), floats(sampler["output"])};
    }
    return {};
  }

 private:
  void expect(bool holds, const std::string& fault) {
    if (!holds) faults_.push_back(fault);
  }

  std::uint32_t u32(std::size_t at) const {
    std::uint32_t value = 0;
    if (at + 4 <= bytes_.size()) std::memcpy(&value, bytes_.data() + at, 4);
    return value;
  }

  bool open() {
    const std::size_t json_length = u32(12);
    expect(bytes_.compare(0, 4, "glTF") == 0 && u32(4) == 2, "is no binary glTF 2");
    expect(u32(8) == bytes_.size(), "tells another length than it has");
    expect(bytes_.compare(16, 4, "JSON") == 0 && json_length % 4 == 0 && 20 + json_length <= bytes_.size(),
           "has no chunk of JSON");
    if (!faults_.empty()) return false;
    json_ = Json::parse(bytes_.substr(20, json_length), nullptr, false);
    expect(json_.is_object() && json_["asset"]["version"] == "2.0", "has no JSON of glTF 2.0");
    for (const auto& [name, value] : json_.items())
      expect(!value.is_array() || !value.empty(), name + " is an empty list");
    binary_begin_ = 28 + json_length;
    if (json_.contains("buffers")) {
      const std::size_t chunk = u32(20 + json_length), length = json_["buffers"][0]["byteLength"];
      expect(bytes_.compare(24 + json_length, 4, std::string("BIN\0", 4)) == 0 && chunk % 4 == 0 &&
                 binary_begin_ + chunk == bytes_.size() && length <= chunk && length + 3 >= chunk,
             "has a binary chunk of another length");
    }
    return faults_.empty();
  }

  const Json& list(const char* name) const {
    static const Json kNone = Json::array();
    const auto found = json_.find(name);
    return found == json_.end() ? kNone : *found;
  }

  void check_nodes() {
    std::vector<int> parents(list("nodes").size(), 0);
    for (const Json& node : list("nodes")) {
      for (const std::size_t child : node.value("children", std::vector<std::size_t>{}))
        child < parents.size() ? void(++parents[child]) : expect(false, "a node has a child that is not there");
      expect(!node.contains("mesh") || node["mesh"] < list("meshes").size(), "a node has a mesh that is not there");
      if (node.contains("rotation"))
        expect_unit(node["rotation"].get<std::vector<double>>(), 1e-6, "a node's rotation");
    }
    for (const std::size_t root : json_["scenes"][0]["nodes"]) expect(parents[root] == 0, "a root is a child");
    expect(std::all_of(parents.begin(), parents.end(), [](int n) { return n <= 1; }), "a node has two parents");
  }

  void check_view(std::size_t index) {
    const Json& view = list("bufferViews")[index];
    const std::size_t begin = view.value("byteOffset", std::size_t{0}), length = view["byteLength"];
    expect(length > 0 && begin % 4 == 0 && begin + length <= json_["buffers"][0]["byteLength"].get<std::size_t>(),
           "view " + std::to_string(index) + " is not within the buffer");
  }

  static std::size_t width_of(const Json& accessor) {
    return std::map<std::string, std::size_t>{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}}.at(accessor["type"]);
  }
  static std::size_t bytes_of(const Json& accessor) {
    return std::map<int, std::size_t>{{5126, 4}, {5125, 4}, {5123, 2}}.at(accessor["componentType"]);
  }
  const char* data(const Json& accessor) const {
    const Json& view = list("bufferViews")[accessor["bufferView"].get<std::size_t>()];
    return bytes_.data() + binary_begin_ + view.value("byteOffset", std::size_t{0});
  }

  void check_accessor(std::size_t index) {
    const Json& a = list("accessors")[index];
    const std::string name = "accessor " + std::to_string(index);
    const std::size_t count = a["count"], size = count * width_of(a) * bytes_of(a);
    if (a["bufferView"] >= list("bufferViews").size()) return expect(false, name + " has a view that is not there");
    const std::size_t length = list("bufferViews")[a["bufferView"].get<std::size_t>()]["byteLength"];
    expect(count > 0 && size <= length && size + 4 > length, name + " is not as long as its view");
    if (a["componentType"] != 5126) return;
    const std::vector<float> values = floats(index);
    expect(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }),
           name + " has a number that is not finite");
    if (!a.contains("min")) return;
    for (std::size_t k = 0; k < width_of(a); ++k) {
      float minimum = values[k], maximum = values[k];
      for (std::size_t i = k; i < values.size(); i += width_of(a)) {
        minimum = std::min(minimum, values[i]);
        maximum = std::max(maximum, values[i]);
      }
      expect(a["min"][k].get<float>() == minimum && a["max"][k].get<float>() == maximum, name + " has wrong bounds");
    }
  }

  void check_primitive(const Json& primitive) {
    const std::size_t positions = primitive["attributes"]["POSITION"], indices = primitive["indices"];
    const Json &p = list("accessors")[positions], &i = list("accessors")[indices];
    expect(p.contains("min") && p["type"] == "VEC3" && p["componentType"] == 5126, "positions are no such thing");
    expect(i["count"].get<std::size_t>() % 3 == 0 && i["type"] == "SCALAR", "indices make no triangles");
    const bool is_short = i["componentType"] == 5123;
    const std::size_t vertices = p["count"];
    for (std::size_t k = 0; k < i["count"]; ++k) {
      std::uint32_t value = 0;
      std::memcpy(&value, data(i) + k * (is_short ? 2 : 4), is_short ? 2 : 4);
      if (value >= vertices) return expect(false, "an index is beyond the positions");
    }
    expect(primitive["material"] < list("materials").size(), "a primitive has a material that is not there");
  }

  void check_animation(const Json& animation) {
    const std::string name = "animation " + animation.value("name", "");
    expect(!animation["channels"].empty() && !animation["samplers"].empty(), name + " is empty");
    std::set<std::pair<std::size_t, std::string>> targets;
    for (const Json& channel : animation["channels"]) {
      const std::size_t node = channel["target"]["node"];
      expect(node < list("nodes").size() && !list("nodes")[node].contains("matrix"), name + " moves no such node");
      expect(targets.emplace(node, channel["target"]["path"]).second, name + " moves a node twice");
      const bool turns = channel["target"]["path"] == "rotation";
      check_sampler(animation["samplers"].at(channel["sampler"].get<std::size_t>()), turns ? "VEC4" : "VEC3", name);
    }
  }

  void check_sampler(const Json& sampler, const std::string& type, const std::string& name) {
    const Json &input = list("accessors")[sampler["input"].get<std::size_t>()],
               &output = list("accessors")[sampler["output"].get<std::size_t>()];
    expect(input["type"] == "SCALAR" && input["componentType"] == 5126 && input.contains("min"),
           name + " has times that are none");
    expect(output["type"] == type && output["componentType"] == 5126 && output["count"] == input["count"],
           name + " has values that do not go with its times");
    const std::vector<float> times = floats(sampler["input"]);
    expect(times[0] >= 0, name + " begins before time");
    for (std::size_t i = 1; i < times.size(); ++i)
      if (!(times[i] > times[i - 1])) return expect(false, name + " has times that do not ascend");
    if (type != "VEC4") return;
    const std::vector<float> turns = floats(sampler["output"]);
    for (std::size_t i = 0; i < turns.size(); i += 4)
      expect_unit({turns.begin() + static_cast<long>(i), turns.begin() + static_cast<long>(i + 4)}, 1e-6, name);
  }

  void expect_unit(const std::vector<double>& q, double tolerance, const std::string& what) {
    double squared = 0;
    for (const double part : q) squared += part * part;
    expect(std::abs(squared - 1) < tolerance, what + " is no unit quaternion");
  }

  std::string bytes_;
  Json json_;
  std::size_t binary_begin_ = 0;
  std::vector<std::string> faults_;
};

}  // namespace dismantle
