// SPDX-License-Identifier: Apache-2.0
// Sends commands of a client in control, one per line, to a session of a block in front of a wall. Always, the session
// stays sound and the block outside the wall.
#include "apps/server/workbench.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/own_folder.h"
#include "tests/support/meshes.h"

#include <nlohmann/json.hpp>

#include <chrono>

namespace {

using namespace dismantle;
using namespace dismantle::server;

Model block_and_wall() {
  Model model;
  model.number = 1;
  model.name = "block";
  model.assembly = std::make_shared<const Assembly>(
      scenes::assembly({scenes::component("block", scenes::box({0, 0, 0}, {10, 10, 10})),
                        scenes::component("wall", scenes::box({20.5, -50, -50}, {21, 50, 50}))}));
  model.glb = std::make_shared<const std::string>("");
  PairStates states;
  states.tolerance = 0.01;
  model.session = std::make_unique<Session>(*model.assembly, states);
  return model;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::OwnFolder folder;  // commands may save files
  static const Roots roots = Roots::create({folder.path()}).value();
  const auto refuse = [](const auto&) -> Result<std::uint32_t> {
    return Error{ErrorKind::Usage, "nothing is searched here (a fuzz target); do not ask"};
  };
  Workbench workbench(roots, std::nullopt, refuse, refuse);
  workbench.set_model(block_and_wall());
  Workbench::Clock::time_point now{};
  std::string_view text = fuzz::text_of(data, size);
  for (int lines = 0; !text.empty() && lines < 32; ++lines) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const Json command = Json::parse(line, nullptr, false);
    if (!command.is_object() || !command.contains("command") || !command["command"].is_string()) continue;  // as Hub
    const Result<Json> reply = workbench.execute(command);
    if (!reply) fuzz::require_sentence(reply.error());
    const std::uint32_t grip = reply && reply->contains("grip") ? (*reply)["grip"].get<std::uint32_t>() : 0;
    if (workbench.is_dragging()) workbench.set_input(TargetMessage{grip, 1, {{30, 0, 0}, {}}});
    for (int i = 0; i < 3 && workbench.needs_step(); ++i) workbench.step(now += std::chrono::milliseconds(20));
    workbench.take_state();
    for (const Pose& pose : workbench.model()->session->poses()) {
      fuzz::require(is_finite(pose.position), "finite poses");
      fuzz::require(std::abs(dot(pose.rotation, pose.rotation) - 1) < 1e-6, "unit rotations");
    }
    const Pose block = workbench.model()->session->poses()[0], wall = workbench.model()->session->poses()[1];
    const bool is_before = block.rotation == Quat{} && wall == Pose{} && std::abs(block.position.y) < 40 &&
                           std::abs(block.position.z) < 40 && block.position.x + 10 < 21 + 1e-9;
    if (is_before)
      fuzz::require(block.position.x + 10 <= 20.5 + 0.0101, "the block no deeper in the wall than allowed");
  }
  return 0;
}
