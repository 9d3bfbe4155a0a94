// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/path_file.h"
#include "dismantle/loading/write_assembly.h"
#include "dismantle/session/session_path.h"
#include "tests/faults/killed_command.h"
#include "tests/planner/plan_scenes.h"

#include <stdexcept>

namespace dismantle::faults {

namespace fs = std::filesystem;

namespace {

void demand(const Result<Done>& written) {
  if (!written) throw std::runtime_error(written.error().message);
}

/// Writes a stack of boxes in a tube, and a path that takes them out.
void write_stack(const fs::path& folder, int count) {
  const Assembly stack = scenes::stack_in_tube(count);
  demand(write_assembly(folder / "stack.dasm", stack));
  Path path = empty_path(stack, PairStates{0.01, {}});
  path.assembly_file = "stack.dasm";
  for (int k = count - 1; k >= 0; --k) {
    const std::string box = "box " + std::to_string(k);
    path.moves.push_back({"take out " + box, {box}, {{0, {}}, {1, {{0, 0, 8.0 * count}, {}}}}});
    path.removed.push_back(box);
  }
  demand(write_path(folder / "stack.path.json", path));
}

}  // namespace

std::vector<FaultCommand> fault_commands(const fs::path& folder, const std::string& kind) {
  fs::create_directories(folder);
  std::vector<FaultCommand> commands;
  if (kind == "import") {
    fs::copy_file(fs::path(DISMANTLE_SOURCE_DIR) / "samples/tooling.step", folder / "tooling.step",
                  fs::copy_options::overwrite_existing);
    commands = {{kind, {"convert", "tooling.step", "-o", "out/tooling.dasm"}, {}, {}}};
  } else if (kind == "plan") {
    demand(write_assembly(folder / "product.dasm", scenes::stations(25)));
    commands = {{kind, {"plan", "product.dasm", "-o", "out/product.path.json", "--graph", "out/product.svg"}, {}, {}}};
  } else if (kind == "export") {
    write_stack(folder, 4);
    for (const char* file : {"out/a.glb", "out/a.html", "out/a.pdf", "out/a.csv"})
      commands.push_back({kind, {"export", "stack.dasm", "stack.path.json", "-o", file}, {}, {}});
  } else if (kind == "batch") {
    fs::create_directories(folder / "products");
    demand(write_assembly(folder / "products/first.dasm", scenes::stations(15)));
    demand(write_assembly(folder / "products/second.dasm", scenes::stack_in_tube(4)));
    commands = {{kind,
                 {"batch", "products", "-o", "out", "--workers", "2"},
                 {"first.dasm/", "batch.", "timing."},
                 {"timing.json", "timing.tsv"}}};
  } else {
    throw std::runtime_error("there is no kind " + kind);
  }
  return commands;
}

}  // namespace dismantle::faults
