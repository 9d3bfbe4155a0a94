// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_assembly.h"

#include "dismantle/simplify/simplify_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>

namespace dismantle {

namespace {

// Rounds of taking from the others what components could not go down to, at most.
constexpr int kShareRounds = 3;
// The search for the error: from this part of the assembly's size to all of it, by so many halvings of the exponent.
constexpr double kLeastError = 1e-6;
constexpr int kErrorSteps = 9;
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
    if (is_new) table.meshes.push_back({c.mesh, 0, 0, false, *c.mesh, {}});
    ++table.meshes[found->second].instances;
    table.of_component.push_back(found->second);
  }
  return table;
}

std::size_t original_count(const SharedMesh& m) {
  return m.original->faces.size();
}

/// How many triangles each mesh has where collapses stop at an error that belongs to an error of the whole assembly:
/// smaller meshes get smaller errors, by the square root of their size, or small parts would lose their shape while
/// large ones do not change. Shape [mesh_count].
std::vector<std::size_t> counts_at(const std::vector<SharedMesh>& meshes, double relative_error, double size,
                                   const SimplifyOptions& options) {
  std::vector<std::size_t> counts(meshes.size());
  options.executor.for_each_heavy(meshes.size(), [&](std::size_t i) {
    const SharedMesh& m = meshes[i];
    const double own_size = diagonal(bounds(*m.original));
    const std::size_t least = std::min(options.minimum_triangles, original_count(m));
    if (m.stuck)
      counts[i] = m.result.faces.size();
    else
      counts[i] = std::max(least, count_simplified(*m.original, relative_error * std::sqrt(own_size * size)));
  });
  return counts;
}

std::size_t total_of(const std::vector<SharedMesh>& meshes, const std::vector<std::size_t>& counts) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) total += meshes[i].instances * counts[i];
  return total;
}

/// Sets the targets so that the total is `budget`, by searching for the error that gives it.
void share_budget(std::vector<SharedMesh>& meshes, std::size_t budget, double size, const SimplifyOptions& options) {
  std::vector<std::size_t> above, below;  // counts with a total above and not above the budget
  for (const SharedMesh& m : meshes) above.push_back(m.stuck ? m.result.faces.size() : original_count(m));
  double least = std::log(kLeastError), largest = 0;
  below = counts_at(meshes, 1, size, options);
  for (int step = 0; step < kErrorSteps; ++step) {
    const double middle = (least + largest) / 2;
    std::vector<std::size_t> counts = counts_at(meshes, std::exp(middle), size, options);
    const bool fits = total_of(meshes, counts) <= budget;
    (fits ? largest : least) = middle;
    (fits ? below : above) = std::move(counts);
  }
  const auto low = static_cast<double>(total_of(meshes, below)), high = static_cast<double>(total_of(meshes, above));
  const double share = high > low ? std::clamp((static_cast<double>(budget) - low) / (high - low), 0.0, 1.0) : 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto from = static_cast<double>(below[i]), to = static_cast<double>(std::max(above[i], below[i]));
    meshes[i].target = static_cast<std::size_t>(from + share * (to - from));
  }
}

/// Runs one round over the meshes that are not stuck.
void simplify_meshes(std::vector<SharedMesh>& meshes, const SimplifyOptions& options) {
  options.executor.for_each_heavy(meshes.size(), [&](std::size_t i) {
    SharedMesh& m = meshes[i];
    if (m.stuck) return;
    m.result = simplify_mesh(*m.original, {m.target});
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
  const double size = diagonal(assembled_bounds(assembly));
  const bool small_enough = triangle_count(assembly) <= target_triangles;
  for (int round = 0; round < kShareRounds && !small_enough; ++round) {
    if (!report_progress(options.progress, "simplifying", static_cast<double>(round) / kShareRounds)) return cancelled;
    share_budget(table.meshes, target_triangles, size, options);
    simplify_meshes(table.meshes, options);
    if (total_triangles(table.meshes) <= enough) break;
  }
  if (!measure_errors(table.meshes, options)) return cancelled;
  return assemble(assembly, table);
}

}  // namespace dismantle
