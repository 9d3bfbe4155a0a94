// SPDX-License-Identifier: Apache-2.0
// Latency of a drag: the time from sending a target to receiving the pose that answers it, over a real socket, without
// a browser. The tailstock of the lathe sample (refined to about 10,000 triangles) slides to and fro along the bed as
// one rigid set, pressed onto it.
//   bench_drag_latency [--targets N] [--rate HZ] [--samples FOLDER]
// Two rows, tab-separated, of N targets each: targets at --rate, as a page sends them, and each as soon as the one
// before is answered. Wall time.
#include "apps/server/server.h"
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/server/test_client.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <thread>

namespace dismantle::server {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing_client::Client;

/// The group of components that is moved, and those of them that are refined.
const std::string kGroup = "tailstock";
const std::vector<std::string> kRefined = {"tailstock", "quill"};
/// Travel of the targets along the bed, their depth below its top [mm], and their highest speed [mm/s].
constexpr double kReach = 80, kPress = 2, kSpeed = 150;

struct Settings {
  std::uint32_t targets = 3000;
  double rate = 60;
  std::string samples = DISMANTLE_SOURCE_DIR "/samples";
};

/// The same surface with each triangle divided into four at the midpoints of its edges.
TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.vertices, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [vertex, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    return vertex->second;
  };
  for (const auto& [v] : mesh.faces) {
    const std::uint32_t ab = middle(v[0], v[1]), bc = middle(v[1], v[2]), ca = middle(v[2], v[0]);
    for (const Face& f : {Face{{v[0], ab, ca}}, Face{{ab, v[1], bc}}, Face{{ca, bc, v[2]}}, Face{{ab, bc, ca}}})
      fine.faces.push_back(f);
  }
  return fine;
}

bool is_below(const Assembly& assembly, std::size_t node, const std::string& group) {
  for (; node != 0; node = static_cast<std::size_t>(assembly.tree[node].parent))
    if (assembly.tree[node].name == group) return true;
  return false;
}

/// An assembly file, and the names of the components to move.
struct Scene {
  fs::path file;
  std::vector<std::string> moving;
};

/// The lathe with the refined components. Throws where it cannot be made.
Scene write_scene(const Settings& settings, const fs::path& folder) {
  Result<Assembly> lathe = load_assembly(settings.samples + "/lathe.step");
  if (!lathe) throw std::runtime_error(lathe.error().message);
  for (const std::string& name : kRefined) {
    Component& c = lathe->components[lathe->find(name).value().value];
    c.mesh = std::make_shared<const TriangleMesh>(refined(*c.mesh));
  }
  Scene scene{folder / "lathe.glb", {}};
  for (const Component& c : lathe->components)
    if (is_below(*lathe, c.tree_node, kGroup)) scene.moving.push_back(c.name);
  if (const Result<Done> written = write_assembly(scene.file, *lathe); !written)
    throw std::runtime_error(written.error().message);
  return scene;
}

/// The target's position after some seconds [mm]: to and fro along x, pressed down.
Vec3 target_at(double seconds) {
  return {0.5 * kReach * (1 - std::cos(2 * kSpeed / kReach * seconds)), 0, -kPress};
}

/// Latencies and poses of a number of targets.
struct Drag {
  std::vector<double> ms;
  std::uint32_t stopped = 0;  ///< Poses in contact, short of the target.
  double min_x = 1e9, max_x = -1e9, min_z = 1e9;
};

/// Sends targets, each when the one before is answered but not before its time. @param interval [s]; 0: no waiting
Drag drag(Client& client, std::uint32_t grip, std::uint32_t first, std::uint32_t count, double interval) {
  Drag made;
  const Clock::time_point begin = Clock::now();
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto due = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(i * interval));
    std::this_thread::sleep_until(due);
    const Vec3 position = target_at(i * (interval > 0 ? interval : 1.0 / 1000));
    const std::string target = encode(TargetMessage{grip, first + i, {position, {}}});
    const bench::Stopwatch watch;
    client.send_binary(target);
    const PoseMessage pose = client.pose_for_target(first + i);
    made.ms.push_back(watch.ms());
    made.stopped += (pose.flags & kStopped) != 0;
    made.min_x = std::min(made.min_x, pose.pose.position.x);
    made.max_x = std::max(made.max_x, pose.pose.position.x);
    made.min_z = std::min(made.min_z, pose.pose.position.z);
  }
  return made;
}

/// Metrics of the engine since the server started.
struct EngineMetrics {
  double steps = 0, median_us = 0, p99_us = 0, max_us = 0;
};

EngineMetrics metrics_of(Client& client) {
  const Json metrics = client.command("metrics");
  return {metrics["steps"], metrics["step_us"]["median"], metrics["step_us"]["p99"], metrics["step_us"]["max"]};
}

/// Sizes of the scene as the server has it.
struct Sizes {
  Json moving = Json::array();  ///< The moving components, by index.
  std::uint64_t triangles = 0, moving_triangles = 0;
};

/// One row of the table. @param first the number of the first target
void measure(Client& client, std::uint32_t grip, const char* name, std::uint32_t first, const Settings& settings,
             double interval, const Sizes& sizes) {
  const EngineMetrics before = metrics_of(client);
  const bench::Stopwatch watch;
  const Drag made = drag(client, grip, first, settings.targets, interval);
  const double seconds = watch.seconds();
  const EngineMetrics after = metrics_of(client);
  const auto count = static_cast<double>(made.ms.size());
  std::printf("%s\t%llu\t%llu\t%.0f\t%.2f\t%.2f\t%.2f\t%.0f\t%.0f\t%.0f\t%.0f\t%.0f\t%.1f\t%.1f\t%.3f\n", name,
              static_cast<unsigned long long>(sizes.triangles), static_cast<unsigned long long>(sizes.moving_triangles),
              count / seconds, bench::quantile(made.ms, 0.5), bench::quantile(made.ms, 0.99),
              bench::quantile(made.ms, 1), (after.steps - before.steps) / seconds, after.median_us, after.p99_us,
              after.max_us, 100 * made.stopped / count, made.min_x, made.max_x, made.min_z);
  std::fflush(stdout);
}

Sizes find_sizes(const Json& model, const std::vector<std::string>& moving) {
  Sizes sizes;
  sizes.triangles = model["triangles"].get<std::uint64_t>();
  for (std::size_t i = 0; i < model["components"].size(); ++i) {
    const Json& component = model["components"][i];
    if (std::find(moving.begin(), moving.end(), component["name"].get<std::string>()) == moving.end()) continue;
    sizes.moving.push_back(i);
    sizes.moving_triangles += component["triangles"].get<std::uint64_t>();
  }
  return sizes;
}

void run(const Settings& settings) {
  std::string folder = (fs::temp_directory_path() / "dismantle-drag-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const Scene scene = write_scene(settings, folder);
  ServerOptions options;
  options.state_folder = fs::path(folder) / "state";
  options.model.classify.tolerance = load_assembly(settings.samples + "/lathe.step").value().deflection * 2;
  const Result<std::unique_ptr<Server>> server = Server::start(std::move(options));
  if (!server || !(*server)->open_file(scene.file)) throw std::runtime_error("the server does not open the lathe");

  Client client({(*server)->port(), (*server)->token()});
  const Json model = client.event("model");
  client.state();
  const Sizes sizes = find_sizes(model, scene.moving);
  const std::uint32_t grip = client.command("hold", {{"components", sizes.moving}})["grip"];
  drag(client, grip, 1, 1, 0);  // builds the front
  std::printf(
      "targets\ttriangles\tmoving_triangles\ttargets_per_s\tlatency_median_ms\tlatency_p99_ms\tlatency_max_ms\t"
      "steps_per_s\tstep_median_us\tstep_p99_us\tstep_max_us\tin_contact_percent\tmin_x_mm\tmax_x_mm\tmin_z_mm\n");
  measure(client, grip, "at the rate", 2, settings, 1 / settings.rate, sizes);
  measure(client, grip, "at once", 2 + settings.targets, settings, 0, sizes);
  client.command("release");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dismantle::server

int main(int argc, char** argv) {
  dismantle::server::Settings settings;
  dismantle::bench::CommandLine line("bench_drag_latency [--targets N] [--rate HZ] [--samples FOLDER]");
  line.option("--targets", settings.targets, 1);
  line.option("--rate", settings.rate);
  line.option("--samples", settings.samples);
  if (!line.parse(argc, argv) || (settings.rate <= 0 && !line.wrong())) return dismantle::bench::kExitUsage;
  try {
    dismantle::server::run(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_drag_latency: %s\n", error.what());
    return dismantle::bench::kExitFailed;
  }
  return 0;
}
