// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"

#include "dismantle/documents/frame_json.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/files/json_node.h"
#include "dismantle/files/read_file.h"
#include "dismantle/formats/import/mesh_source.h"

#include <unordered_set>

namespace dismantle {

namespace {

ResponseKind read_response(JsonReader& in, const JsonNode& node) {
  if (!in.ok() || node.json == nullptr) return ResponseKind::Slide;
  const std::string name = in.text(node);
  for (const ResponseKind kind : {ResponseKind::Stop, ResponseKind::Touch, ResponseKind::Slide})
    if (name == name_of(kind)) return kind;
  in.fail(node, in_quotes(name) + " is none of \"stop\", \"touch\" and \"slide\"");
  return ResponseKind::Slide;
}

}  // namespace

Result<Motion> parse_motion(std::string_view text, const std::string& file_name) {
  const Result<nlohmann::json> document = parse_json(text, file_name);
  if (!document) return document.error();
  JsonReader in(file_name);
  const JsonNode root{&*document, nullptr, {}, 0};
  in.expect_format(root, "dismantle-motion");
  Motion motion;
  motion.response = read_response(in, in.optional_member(root, "response"));
  const JsonNode moves = in.member(root, "moves");
  const std::size_t count = in.size(moves);
  for (std::size_t i = 0; i < count && in.ok(); ++i) {
    const JsonNode node = moves.at(i);
    MotionMove move;
    move.components = read_component_names(in, in.member(node, "components"));
    move.targets = read_frames(in, in.member(node, "targets"));
    motion.moves.push_back(std::move(move));
  }
  if (!in.ok()) return *in.error();
  return motion;
}

Result<Motion> read_motion(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, kLargestJsonFile);
  if (!text) return text.error();
  return parse_motion(*text, file.filename().string());
}

std::string motion_text(const Motion& motion) {
  std::vector<std::string> moves;
  for (const MotionMove& move : motion.moves) {
    std::vector<std::string> targets;
    for (const Frame& target : move.targets) targets.push_back(json_line(frame_json(target)));
    moves.push_back("{\"components\": " + json_line(move.components) + ",\n     \"targets\": [" +
                    json_lines(targets, 7) + "]}");
  }
  return "{\n  \"format\": \"dismantle-motion\", \"version\": 1,\n  \"response\": " +
         json_line(name_of(motion.response)) + ",\n  \"moves\": [" + json_lines(moves, 4) + "]\n}\n";
}

Result<Done> write_motion(const std::filesystem::path& file, const Motion& motion) {
  return write_file(file, motion_text(motion));
}

Result<Done> check_names(const Motion& motion, const Assembly& assembly) {
  std::unordered_set<std::string_view> known;
  for (const Component& component : assembly.components) known.insert(component.name);
  for (std::size_t i = 0; i < motion.moves.size(); ++i)
    for (const std::string& name : motion.moves[i].components)
      if (known.count(name) == 0)
        return Error{ErrorKind::Unreadable, "the motion does not fit the assembly (moves[" + std::to_string(i) +
                                                "].components: " + in_quotes(name) + " is not a component of " +
                                                assembly.source_file + "); take the names that `dismantle info` lists"};
  return Done{};
}

}  // namespace dismantle
