// SPDX-License-Identifier: Apache-2.0
// Many candidate motions from one state: in which directions can this component be removed?
//   candidate_motions ASSEMBLY COMPONENT [MM]     length of each motion; without: the size of the component
#include "dismantle/candidates/motion_batch.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"

#include <cstdio>
#include <cstdlib>

using namespace dismantle;

namespace {

/// The 26 directions to the faces, edges and corners of a cube.
std::vector<Vec3> cube_directions() {
  std::vector<Vec3> directions;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          directions.push_back(
              normalized(Vec3{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
  return directions;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: candidate_motions ASSEMBLY COMPONENT [MM]\n");
    return 2;
  }
  const Result<Assembly> assembly = load_assembly(argv[1]);
  if (!assembly) {
    std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
    return 3;
  }
  const std::optional<ComponentId> component = assembly->find(argv[2]);
  if (!component) {
    std::fprintf(stderr, "there is no component '%s'\n", argv[2]);
    return 2;
  }

  const PairStates states = classify_pairs(*assembly, {}).value();
  const ChosenMotionBatch chosen = make_motion_batch(*assembly, states, Executor(), DeviceChoice::Auto);
  chosen.batch->set_state(std::vector<Pose>(assembly->components.size()), {&*component, 1});

  // One target for each candidate, which is one screw from the assembled pose. Nothing moves.
  const double distance = argc == 4 ? std::atof(argv[3]) : diagonal(assembled_bounds((*assembly)[*component]));
  const std::vector<Vec3> directions = cube_directions();
  std::vector<Pose> targets;
  for (const Vec3& direction : directions) targets.push_back({distance * direction, {}});
  const std::vector<FirstContact> found = chosen.batch->screw_contacts(targets);

  for (std::size_t k = 0; k < found.size(); ++k) {
    std::printf("(%5.2f, %5.2f, %5.2f): ", directions[k].x, directions[k].y, directions[k].z);
    if (found[k].free) {
      std::printf("free for %.1f mm\n", distance);
    } else {
      std::printf("meets '%s' after %.3f mm\n", (*assembly)[found[k].fixed].name.c_str(), found[k].toi * distance);
    }
  }
  return 0;
}
