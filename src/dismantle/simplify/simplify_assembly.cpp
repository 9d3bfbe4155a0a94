// SPDX-License-Identifier: Apache-2.0
#include "dismantle/simplify/simplify_assembly.h"

#include "dismantle/simplify/simplify_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <unordered_map>

namespace dismantle {

namespace {

// The search for the error: bisection of its logarithm, from this part of the assembly's size to all of it.
constexpr double kMinError = 1e-6;
constexpr int kErrorSteps = 40;

/// A mesh, the number of its instances, and its simplification.
struct SharedMesh {
  std::shared_ptr<const TriangleMesh> original;
  std::size_t instances = 0;
  std::size_t target = 0;
  double size = 0;  // diagonal [mm]
  std::vector<SimplificationStep> curve;
  TriangleMesh result;
  DistanceBounds error;
};

/// The meshes of an assembly, each once, and the mesh of each component.
struct MeshTable {
  std::vector<SharedMesh> meshes;
  std::vector<std::size_t> of_component;
};

MeshTable collect_meshes(const Assembly& assembly) {
  MeshTable table;
  std::unordered_map<const TriangleMesh*, std::size_t> index_of;
  for (const Component& c : assembly.components) {
    const auto [found, is_new] = index_of.try_emplace(c.mesh.get(), table.meshes.size());
    if (is_new) table.meshes.push_back({c.mesh, 0, 0, diagonal(bounds(*c.mesh)), {}, *c.mesh, {}});
    ++table.meshes[found->second].instances;
    table.of_component.push_back(found->second);
  }
  return table;
}

std::size_t original_count(const SharedMesh& m) {
  return m.original->faces.size();
}

/// Number of triangles of each mesh at an error of the whole assembly, shape [mesh_count]. A mesh's own error is in
/// proportion to the square root of its size: with one error for all, small parts would lose their shape before large
/// ones change.
std::vector<std::size_t> counts_at(const std::vector<SharedMesh>& meshes, double relative_error, double size,
                                   std::size_t minimum) {
  std::vector<std::size_t> counts;
  for (const SharedMesh& m : meshes) {
    const double error = relative_error * std::sqrt(m.size * size);
    const auto past = std::upper_bound(m.curve.begin(), m.curve.end(), error,
                                       [](double e, const SimplificationStep& step) { return e < step.error; });
    const std::size_t min_count = std::min(minimum, original_count(m));
    counts.push_back(std::max(min_count, std::prev(past)->triangles));  // the first step's error is 0
  }
  return counts;
}

std::size_t total_of(const std::vector<SharedMesh>& meshes, const std::vector<std::size_t>& counts) {
  std::size_t total = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) total += meshes[i].instances * counts[i];
  return total;
}

/// Sets the targets so that the total is `budget`, by a search for the error that gives it.
void share_budget(std::vector<SharedMesh>& meshes, std::size_t budget, double size, std::size_t minimum) {
  // Counts whose total is at most the budget, and above it.
  std::vector<std::size_t> above, below = counts_at(meshes, 1, size, minimum);
  for (const SharedMesh& m : meshes) above.push_back(original_count(m));
  double lower = std::log(kMinError), upper = 0;
  for (int step = 0; step < kErrorSteps; ++step) {
    const double middle = (lower + upper) / 2;
    std::vector<std::size_t> counts = counts_at(meshes, std::exp(middle), size, minimum);
    const bool fits = total_of(meshes, counts) <= budget;
    (fits ? upper : lower) = middle;
    (fits ? below : above) = std::move(counts);
  }
  const auto low = static_cast<double>(total_of(meshes, below)), high = static_cast<double>(total_of(meshes, above));
  const double share = high > low ? std::clamp((static_cast<double>(budget) - low) / (high - low), 0.0, 1.0) : 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto from = static_cast<double>(below[i]), to = static_cast<double>(std::max(above[i], below[i]));
    meshes[i].target = static_cast<std::size_t>(from + share * (to - from));
  }
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
  if (triangle_count(assembly) > target_triangles) {
    if (!report_progress(options.progress, "simplifying", 0)) return cancelled;
    options.executor.for_each_heavy(table.meshes.size(), [&](std::size_t i) {
      table.meshes[i].curve = simplification_curve(*table.meshes[i].original);
    });
    if (!report_progress(options.progress, "simplifying", 0.5)) return cancelled;
    const double size = diagonal(assembled_bounds(assembly));
    share_budget(table.meshes, target_triangles, size, options.minimum_triangles);
    options.executor.for_each_heavy(table.meshes.size(), [&](std::size_t i) {
      table.meshes[i].result = simplify_mesh(*table.meshes[i].original, {table.meshes[i].target});
    });
  }
  if (!measure_errors(table.meshes, options)) return cancelled;
  return assemble(assembly, table);
}

}  // namespace dismantle
