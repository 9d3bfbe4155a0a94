// SPDX-License-Identifier: Apache-2.0
// Random small scenes and motions into the engine, with the audit as oracle: no path is deeper than it may be.
// Four bytes make a solid, the next four a target of the component that they name.
#include "dismantle/audit/audit_path.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/session/play_motion.h"
#include "fuzz/fuzz_input.h"
#include "tests/support/meshes.h"

#include <chrono>
#include <cmath>

namespace {

using namespace dismantle;

constexpr std::size_t kRecord = 4, kMostTargets = 6;
constexpr double kDeepest = 0.05;  // [mm]

/// A box, cylinder, tube or thin plate whose sizes and place are multiples of 0.5 mm: faces that touch, lie in one
/// plane, and fit without clearance are common.
Component solid(std::size_t index, const std::uint8_t* b) {
  const double size = 1 + (b[0] % 8) * 0.5;
  const Vec3 at{(b[1] % 20) * 0.5, (b[2] % 20) * 0.5, (b[3] % 20) * 0.5};
  TriangleMesh mesh;
  switch (b[0] / 8 % 4) {
    case 0:
      mesh = scenes::box(at, at + Vec3{size, size, size});
      break;
    case 1:
      mesh = scenes::tube(size, 0, 0, 2 * size, 6 + b[0] / 32 * 6);
      break;
    case 2:
      mesh = scenes::tube(size + 0.5, size, 0, size, 6 + b[0] / 32 * 6);
      break;
    default:
      mesh = scenes::box(at, at + Vec3{size, size, 0.02});
  }
  if (b[0] / 8 % 4 == 1 || b[0] / 8 % 4 == 2)
    for (Vec3& p : mesh.vertices) p = p + at;
  return scenes::component("part" + std::to_string(index), std::move(mesh));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 + 3 * kRecord) return 0;
  const std::size_t count = 2 + data[0] % 3;
  const auto response = static_cast<ResponseKind>(data[0] / 4 % 3);
  const std::uint8_t* record = data + 1;
  const std::uint8_t* const end = data + size;
  std::vector<Component> components;
  for (std::size_t i = 0; i < count && record + kRecord <= end; ++i, record += kRecord)
    components.push_back(solid(i, record));
  const Assembly assembly = scenes::assembly(std::move(components));
  const Result<PairStates> states = classify_pairs(assembly, {});
  fuzz::require(states.ok(), "pairs that can be classified");

  for (const ComponentPair& pair : states->pairs)
    if (pair.depth > kDeepest) return 0;  // bounding the depth of pairs that overlap takes seconds a step

  Motion motion;
  motion.response = response;
  std::vector<Pose> poses(assembly.components.size());
  for (std::size_t i = 0; i < kMostTargets && record + kRecord <= end; ++i, record += kRecord) {
    const std::size_t moving = record[0] % assembly.components.size();
    const auto move = [](std::uint8_t byte) { return (byte - 128) / 32.0; };
    Pose& pose = poses[moving];
    MotionMove step;
    step.components = {assembly.components[moving].name};
    step.targets.push_back({0, pose});
    pose.position = pose.position + Vec3{move(record[1]), move(record[2]), move(record[3])};
    if (record[0] >= 128) pose.rotation = pose.rotation * quat_about({0, 0, 1}, (record[0] - 192) / 64.0);
    step.targets.push_back({0.1, pose});
    motion.moves.push_back(std::move(step));
  }
  if (motion.moves.empty()) return 0;
  CertificateOptions engine_options;
  engine_options.depth_tests = 100'000;
  if (motion.moves.size() % 2 == 0) engine_options.node_pairs = 1;  // sweeps are cut where they may be
  CertificateEngine engine(assembly, *states, engine_options);
  const Result<PlayedMotion> played = play_motion(assembly, *states, motion, engine);
  if (!played) {
    fuzz::require_sentence(played.error());
    return 0;
  }
  AuditOptions options;  // what a short audit has found counts
  const auto start = std::chrono::steady_clock::now();
  options.progress = [start](std::string_view, double) {
    return std::chrono::steady_clock::now() - start < std::chrono::seconds(2);
  };
  const AuditReport report = audit_path(assembly, played->path, options);
  for (const AuditViolation& violation : report.violations) fuzz::require(false, violation.message.c_str());
  return 0;
}
