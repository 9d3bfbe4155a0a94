// SPDX-License-Identifier: Apache-2.0
// The loop of a host program (a viewer, a haptic device, a game): a component is grabbed and follows the hand's
// targets, sliding along what is in its way.
//   host_loop ASSEMBLY COMPONENT [X Y Z]     the direction of the pull; without: upwards
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/engine/classify_pairs.h"
#include "dismantle/loading/load_assembly.h"

#include <cstdio>
#include <cstdlib>
#include <set>

using namespace dismantle;

int main(int argc, char** argv) {
  if (argc != 3 && argc != 6) {
    std::fprintf(stderr, "usage: host_loop ASSEMBLY COMPONENT [X Y Z]\n");
    return 2;
  }

  // Load: anything that docs/formats.md calls an assembly. The user's mistakes come back as one sentence.
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
  Vec3 direction{0, 0, 1};
  if (argc == 6) direction = normalized(Vec3{std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5])});

  // The state of every pair in the assembled state, and so its allowed depth; then an engine that enforces it.
  const PairStates states = classify_pairs(*assembly, {}).value();
  CertificateEngine engine(*assembly, states);

  // Grab the component. Several would move as one rigid body.
  engine.grab({&*component, 1});

  // One step a target. The hand's target may lie inside a solid; the component's pose never does.
  const double way = 1.5 * diagonal(assembled_bounds((*assembly)[*component]));
  const int steps = 100;
  int reached = 0;
  double slowest = 0;
  for (int k = 1; k <= steps; ++k) {
    const Pose target{(way * k / steps) * direction, {}};
    const StepResult step = engine.step(target, ResponseKind::Slide);
    reached += step.reached ? 1 : 0;
    slowest = std::max(slowest, step.cost.ms);
    if (k % 20 != 0) continue;

    // Data for drawing: the pose of the component, the components that it touches, and the contact points.
    std::set<std::string> touched;
    for (const ContactPoint& contact : step.contact_points) touched.insert((*assembly)[contact.fixed].name);
    std::printf("step %3d: at (%.3f, %.3f, %.3f) mm, %zu contact points", k, step.pose.position.x, step.pose.position.y,
                step.pose.position.z, step.contact_points.size());
    for (const std::string& name : touched) std::printf(" '%s'", name.c_str());
    std::printf("\n");
  }
  std::printf("reached %d of %d targets, %.3f ms the slowest step\n", reached, steps, slowest);

  // Undo: any recorded state can be put back without a test.
  engine.jump(std::vector<Pose>(assembly->components.size()));
  std::printf("put back: %s\n", engine.poses()[component->value] == Pose{} ? "yes" : "no");
  return 0;
}
