// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_assembly.h"

#include "dismantle/simplify/simplify_mesh.h"

#include <algorithm>
#include <memory>
#include <unordered_map>

namespace dismantle {

namespace {

// Rounds of giving the others what components could not go down to, at most.
constexpr int kShareRounds = 4;
// A total this much above the target is good enough.
constexpr double kGoodEnough = 1.01;

/// A mesh, how often it occurs, and what becomes of it.
struct SharedMesh {
  std::shared_ptr<const TriangleMesh> original;
  std::size_t instances = 0;
  std::size_t target = 0;
  bool stuck = false;  // its result has more triangles than its target
  TriangleMesh result;
  DistanceBounds error;
};

/// The meshes of an assembly, each once, and which one each component has.
struct MeshTable {
  std::vector<SharedMesh> meshes;
  std::vector<std::size_t> of_component;
};

MeshTable collect_meshes(const Assembly& assembly) {
  MeshTable table;
  std::unordered_map<const TriangleMesh*, std::size_t> place;
  for (const Component& c : assembly.components) {
    const auto [found, is_new] = place.try_emplace(c.mesh.get(), table.meshes.size());
    if (is_new) table.meshes.push_back({c.mesh, 0, 0, false, {}, {}});
    ++table.meshes[found->second].instances;
    table.of_component.push_back(found->second);
  }
  return table;
}

std::size_t least_count(const SharedMesh& m, std::size_t minimum) {
  return std::min(minimum, m.original->faces.size());
}

/// Sets the targets: what is left after the stuck meshes and those at their minimum, by share of the triangles.
void share_budget(std::vector<SharedMesh>& meshes, std::size_t total, std::size_t minimum) {
  std::vector<SharedMesh*> open;
  auto left = static_cast<double>(total);
  for (SharedMesh& m : meshes) {
    if (m.stuck) left -= static_cast<double>(m.instances * m.result.faces.size());
    if (!m.stuck) open.push_back(&m);
  }
  for (bool changed = true; changed;) {
    changed = false;
    double triangles = 0;
    for (const SharedMesh* m : open) triangles += static_cast<double>(m->instances * m->original->faces.size());
    const double ratio = std::clamp(triangles > 0 ? left / triangles : 0, 0.0, 1.0);
    std::vector<SharedMesh*> still_open;
    for (SharedMesh* m : open) {
      m->target = static_cast<std::size_t>(ratio * static_cast<double>(m->original->faces.size()));
      if (m->target >= least_count(*m, minimum)) {
        still_open.push_back(m);
        continue;
      }
      m->target = least_count(*m, minimum);
      left -= static_cast<double>(m->instances * m->target);
      changed = true;
    }
    open = std::move(still_open);
  }
}

/// Runs one round over the meshes that are not stuck.
void simplify_meshes(std::vector<SharedMesh>& meshes, const SimplifyOptions& options) {
  options.executor.for_each_heavy(meshes.size(), [&](std::size_t i) {
    SharedMesh& m = meshes[i];
    if (m.stuck) return;
    m.result = simplify_mesh(*m.original, m.target);
    m.stuck = m.result.faces.size() > m.target + m.target / 50 + 2;
  });
}

/// Measures every changed mesh; false where it was cancelled.
bool measure_errors(std::vector<SharedMesh>& meshes, const SimplifyOptions& options) {
  std::size_t total = 1, done = 0;
  for (const SharedMesh& m : meshes) total += m.original->faces.size();
  HausdorffOptions hausdorff;
  hausdorff.executor = options.executor;
  for (SharedMesh& m : meshes) {
    const double fraction = static_cast<double>(done) / static_cast<double>(total);
    if (!report_progress(options.progress, "measuring the simplification", fraction)) return false;
    if (m.result.faces.size() < m.original->faces.size())
      m.error = hausdorff_distance(*m.original, m.result, hausdorff);
    done += m.original->faces.size();
  }
  return report_progress(options.progress, "measuring the simplification", 1);
}

std::size_t total_triangles(const std::vector<SharedMesh>& meshes) {
  std::size_t total = 0;
  for (const SharedMesh& m : meshes) total += m.instances * m.result.faces.size();
  return total;
}

SimplifiedAssembly assemble(const Assembly& assembly, const MeshTable& table) {
  std::vector<std::shared_ptr<const TriangleMesh>> shared;
  std::vector<MeshFaults> faults;
  for (const SharedMesh& m : table.meshes) {
    const bool unchanged = m.result.faces.size() == m.original->faces.size();
    shared.push_back(unchanged ? m.original : std::make_shared<const TriangleMesh>(m.result));
    faults.push_back(clean_mesh(*shared.back()).faults);
  }

  SimplifiedAssembly result{assembly, {}};
  double largest_error = 0;
  for (std::size_t i = 0; i < assembly.components.size(); ++i) {
    const std::size_t m = table.of_component[i];
    Component& c = result.assembly.components[i];
    result.components.push_back({c.mesh->faces.size(), shared[m]->faces.size(), table.meshes[m].error});
    largest_error = std::max(largest_error, table.meshes[m].error.upper);
    if (c.mesh == shared[m]) continue;
    const MeshFaults as_read = c.faults;
    c.mesh = shared[m];
    c.faults = faults[m];
    c.faults.welded_vertices = as_read.welded_vertices;
    c.faults.degenerate_faces = as_read.degenerate_faces;
  }
  result.assembly.simplification_error += largest_error;
  return result;
}

}  // namespace

Result<SimplifiedAssembly> simplify_assembly(const Assembly& assembly, std::size_t target_triangles,
                                             const SimplifyOptions& options) {
  const Error cancelled{ErrorKind::Failed, "the assembly is not simplified (cancelled); run it again to have it whole"};
  MeshTable table = collect_meshes(assembly);
  const auto enough = static_cast<std::size_t>(kGoodEnough * static_cast<double>(target_triangles));
  for (int round = 0; round < kShareRounds; ++round) {
    if (!report_progress(options.progress, "simplifying", static_cast<double>(round) / kShareRounds)) return cancelled;
    share_budget(table.meshes, target_triangles, options.minimum_triangles);
    simplify_meshes(table.meshes, options);
    if (total_triangles(table.meshes) <= enough) break;
  }
  if (!measure_errors(table.meshes, options)) return cancelled;
  return assemble(assembly, table);
}

}  // namespace dismantle
