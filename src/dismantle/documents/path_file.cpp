// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"

#include "dismantle/documents/frame_json.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/files/json_node.h"
#include "dismantle/files/read_file.h"
#include "dismantle/formats/import/mesh_source.h"

#include <limits>
#include <unordered_set>

namespace dismantle {

namespace {

/// Reads a Path from a parsed document.
class PathReader {
 public:
  explicit PathReader(const std::string& file_name) : in_(file_name) {}

  Result<Path> read(const nlohmann::json& document) {
    const JsonNode root{&document, nullptr, {}, 0};
    Path path;
    path.version = in_.expect_format(root, "dismantle-path", kPathVersion);
    read_assembly(root, path);
    path.tolerance = length(in_.member(root, "tolerance_mm"));
    read_pairs(in_.optional_member(root, "pairs"), path);
    read_moves(in_.member(root, "moves"), path);
    const JsonNode removed = in_.optional_member(root, "removed");
    if (in_.ok() && removed.json != nullptr) {
      path.removed = in_.texts(removed);
      expect_known(removed, path.removed);
    }
    if (!in_.ok()) return *in_.error();
    return path;
  }

 private:
  void read_assembly(const JsonNode& root, Path& path) {
    const JsonNode assembly = in_.member(root, "assembly");
    path.assembly_file = in_.text(in_.member(assembly, "file"));
    path.assembly_sha256 = in_.text(in_.member(assembly, "sha256"));
    path.components = read_component_names(in_, in_.member(assembly, "components"));
    known_.insert(path.components.begin(), path.components.end());
  }

  void read_pairs(const JsonNode& pairs, Path& path) {
    if (!in_.ok() || pairs.json == nullptr) return;
    const std::size_t count = in_.size(pairs);
    for (std::size_t i = 0; i < count && in_.ok(); ++i) {
      const PathPair read = pair(pairs.at(i), path.version);
      // Depth between triangles says nothing about that of solids.
      if (path.version > 1) path.pairs.push_back(read);
    }
  }

  PathPair pair(const JsonNode& node, int version) {
    PathPair pair;
    const JsonNode a = in_.member(node, "a"), b = in_.member(node, "b");
    pair.a = known(a);
    pair.b = known(b);
    if (in_.ok() && pair.a == pair.b) in_.fail(b, "the same component as a");
    const JsonNode state = in_.member(node, "state");
    const std::string name = in_.text(state);
    if (version == 1) {
      if (in_.ok() && name != "fit" && name != "embedded")
        in_.fail(state, in_quotes(name) + " is neither \"fit\" nor \"embedded\"");
      return pair;
    }
    read_state(state, name, pair);
    pair.initial_depth = length(in_.member(node, "initial_depth_mm"));
    const JsonNode allowed = in_.member(node, "allowed_depth_mm");
    if (pair.state != PathPairState::Free) {
      pair.allowed_depth = length(allowed);
    } else {
      pair.allowed_depth = std::numeric_limits<double>::infinity();
      if (in_.ok() && !allowed.json->is_null()) in_.fail(allowed, "not null, though the pair is free");
    }
    return pair;
  }

  void read_state(const JsonNode& node, const std::string& name, PathPair& pair) {
    for (const PathPairState state : {PathPairState::Overlapping, PathPairState::Declared, PathPairState::Free}) {
      if (name != name_of(state)) continue;
      pair.state = state;
      return;
    }
    if (in_.ok()) in_.fail(node, in_quotes(name) + " is none of \"overlapping\", \"declared\" and \"free\"");
  }

  void read_moves(const JsonNode& moves, Path& path) {
    const std::size_t count = in_.size(moves);
    for (std::size_t i = 0; i < count && in_.ok(); ++i) {
      const JsonNode node = moves.at(i);
      Move move;
      if (const JsonNode label = in_.optional_member(node, "label"); label.json != nullptr)
        move.label = in_.text(label);
      const JsonNode components = in_.member(node, "components");
      move.components = read_component_names(in_, components);
      expect_known(components, move.components);
      move.frames = read_frames(in_, in_.member(node, "frames"));
      path.moves.push_back(std::move(move));
    }
  }

  double length(const JsonNode& node) {
    const double value = in_.number(node);
    if (in_.ok() && value < 0) in_.fail(node, "negative");
    return value;
  }

  std::string known(const JsonNode& node) {
    std::string name = in_.text(node);
    if (in_.ok() && known_.count(name) == 0) in_.fail(node, in_quotes(name) + " is not in assembly.components");
    return name;
  }

  void expect_known(const JsonNode& array, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < names.size() && in_.ok(); ++i) known(array.at(i));
  }

  JsonReader in_;
  std::unordered_set<std::string> known_;
};

JsonValue pair_json(const PathPair& pair) {
  const bool free = pair.state == PathPairState::Free;
  return {{"a", pair.a},
          {"b", pair.b},
          {"state", name_of(pair.state)},
          {"initial_depth_mm", pair.initial_depth},
          {"allowed_depth_mm", free ? JsonValue() : JsonValue(pair.allowed_depth)}};
}

std::string move_text(const Move& move) {
  std::vector<std::string> frames;
  for (const Frame& frame : move.frames) frames.push_back(json_line(frame_json(frame)));
  return "{\"label\": " + json_line(move.label) + ", \"components\": " + json_line(move.components) +
         ",\n     \"frames\": [" + json_lines(frames, 7) + "]}";
}

}  // namespace

Result<Path> parse_path(std::string_view text, const std::string& file_name) {
  const Result<nlohmann::json> document = parse_json(text, file_name);
  if (!document) return document.error();
  return PathReader(file_name).read(*document);
}

Result<Path> read_path(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, kLargestJsonFile);
  if (!text) return text.error();
  return parse_path(*text, file.filename().string());
}

std::string path_text(const Path& path) {
  std::vector<std::string> pairs, moves;
  for (const PathPair& pair : path.pairs) pairs.push_back(json_line(pair_json(pair)));
  for (const Move& move : path.moves) moves.push_back(move_text(move));
  return "{\n  \"format\": \"dismantle-path\", \"version\": " + std::to_string(path.version) +
         ",\n  \"assembly\": {\"file\": " + json_line(path.assembly_file) +
         ", \"sha256\": " + json_line(path.assembly_sha256) + ",\n    \"components\": " + json_line(path.components) +
         "},\n  \"tolerance_mm\": " + json_line(path.tolerance) + ",\n  \"pairs\": [" + json_lines(pairs, 4) +
         "],\n  \"moves\": [" + json_lines(moves, 4) + "],\n  \"removed\": " + json_line(path.removed) + "\n}\n";
}

Result<Done> write_path(const std::filesystem::path& file, const Path& path) {
  return write_file(file, path_text(path));
}

Result<Done> check_names(const Path& path, const Assembly& assembly) {
  std::unordered_set<std::string_view> known;
  for (const Component& component : assembly.components) known.insert(component.name);
  for (const std::string& name : path.components)
    if (known.count(name) == 0)
      return Error{ErrorKind::Unreadable, "the path does not fit the assembly (it names " + in_quotes(name) +
                                              ", which is not a component of " + assembly.source_file +
                                              "); load the assembly that it was made with"};
  return Done{};
}

}  // namespace dismantle
