// SPDX-License-Identifier: Apache-2.0
#include <dismantle/exec/executor.h>
#include <dismantle/io/load_assembly.h>

#include <cstdio>

// consumer FILE: reads an assembly and prints its components; exit code 1 where it cannot.
int main(int argc, char** argv) {
  if (argc != 2) return 1;
  const dismantle::Result<dismantle::Assembly> assembly = dismantle::load_assembly(argv[1]);
  if (!assembly) {
    std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
    return 1;
  }
  const dismantle::Executor threads(dismantle::ExecutorKind::Threads, 2);
  threads.for_each(assembly->components.size(), [&](std::size_t i) {
    const dismantle::Component& component = assembly->components[i];
    std::printf("%s: %zu triangles\n", component.name.c_str(), component.mesh->faces.size());
  });
  return assembly->components.size() == 1 && dismantle::triangle_count(*assembly) == 4 ? 0 : 1;
}
