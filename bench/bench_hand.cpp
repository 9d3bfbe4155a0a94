// SPDX-License-Identifier: Apache-2.0
// From a hand's target to the pose that answers it, over a real socket, without a page: the tailstock of the lathe (six
// components as one rigid set, refined to about 10,000 triangles) slides to and fro along the bed, pressed onto it.
//   bench_hand [--targets N] [--rate HZ] [--samples FOLDER]
// Targets go at the rate of a screen, as a page's do; then as fast as they are answered. Times are wall time.
#include "apps/server/server.h"
#include "dismantle/io/load_assembly.h"
#include "dismantle/io/write_assembly.h"
#include "tests/server/test_client.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
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
/// How far the hand goes along the bed and how far below its top it presses [mm]; its highest speed [mm/s].
constexpr double kReach = 80, kPress = 2, kSpeed = 150;

struct Settings {
  std::uint32_t targets = 3000;
  double rate = 60;
  fs::path samples = DISMANTLE_SOURCE_DIR "/samples";
};

/// Each triangle in four, by the middles of its edges: the same surface.
TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.vertices, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    return place->second;
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

/// An assembly as a file, and what is to be moved in it.
struct Scene {
  fs::path file;
  std::vector<std::string> set;
};

/// The lathe with the refined components. Throws where it cannot be made.
Scene write_scene(const Settings& settings, const fs::path& folder) {
  Result<Assembly> lathe = load_assembly(settings.samples / "lathe.step");
  if (!lathe) throw std::runtime_error(lathe.error().message);
  for (const std::string& name : kRefined) {
    Component& c = lathe->components[lathe->find(name).value().value];
    c.mesh = std::make_shared<const TriangleMesh>(refined(*c.mesh));
  }
  Scene scene{folder / "lathe.glb", {}};
  for (const Component& c : lathe->components)
    if (is_below(*lathe, c.tree_node, kGroup)) scene.set.push_back(c.name);
  if (const Result<Done> written = write_assembly(scene.file, *lathe); !written)
    throw std::runtime_error(written.error().message);
  return scene;
}

/// To and fro along x, pressed down.
Vec3 hand_at(double seconds) {
  return {0.5 * kReach * (1 - std::cos(2 * kSpeed / kReach * seconds)), 0, -kPress};
}

struct Answers {
  std::vector<double> ms;
  std::uint32_t stopped = 0;  ///< In contact, short of the target.
  double least_x = 1e9, greatest_x = -1e9, least_z = 1e9;
};

double quantile(std::vector<double> values, double q) {
  const auto at = values.begin() + std::lround(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Sends targets, each when the one before is answered, and not before its time. @param interval 0: at once
Answers slide(Client& client, std::uint32_t grip, std::uint32_t first, std::uint32_t count, double interval) {
  Answers answers;
  const Clock::time_point begin = Clock::now();
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto due = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(i * interval));
    std::this_thread::sleep_until(due);
    const Vec3 wanted = hand_at(i * (interval > 0 ? interval : 1.0 / 1000));
    const std::string target = encode(TargetMessage{grip, first + i, {wanted, {}}});
    const Clock::time_point sent = Clock::now();
    client.send_binary(target);
    const PoseMessage pose = client.pose_answering(first + i);
    answers.ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - sent).count());
    answers.stopped += (pose.flags & kStopped) != 0;
    answers.least_x = std::min(answers.least_x, pose.pose.position.x);
    answers.greatest_x = std::max(answers.greatest_x, pose.pose.position.x);
    answers.least_z = std::min(answers.least_z, pose.pose.position.z);
  }
  return answers;
}

/// What the engine has done by now.
struct Work {
  double steps = 0, median_us = 0, p99_us = 0;
};

Work work_of(Client& client) {
  const Json metrics = client.command("metrics");
  return {metrics["steps"], metrics["step_us"]["median"], metrics["step_us"]["p99"]};
}

/// One row of the table.
void measure(Client& client, std::uint32_t grip, const char* name, const Settings& settings, double interval) {
  static std::uint32_t number = 1;
  const Work before = work_of(client);
  const Clock::time_point begin = Clock::now();
  const Answers a = slide(client, grip, number + 1, settings.targets, interval);
  number += settings.targets;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const Work after = work_of(client);
  const auto count = static_cast<double>(a.ms.size());
  std::printf("%s\t%.0f\t%.2f\t%.2f\t%.2f\t%.0f\t%.0f\t%.0f\t%.0f\t%.1f to %.1f\t%.3f\n", name, count / seconds,
              quantile(a.ms, 0.5), quantile(a.ms, 0.99), quantile(a.ms, 1), (after.steps - before.steps) / seconds,
              after.median_us, after.p99_us, 100 * a.stopped / count, a.least_x, a.greatest_x, a.least_z);
}

/// The set's components by index, and how many triangles they have.
std::pair<Json, std::uint64_t> find_set(const Json& model, const std::vector<std::string>& names) {
  Json indices = Json::array();
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; i < model["components"].size(); ++i) {
    const Json& component = model["components"][i];
    if (std::find(names.begin(), names.end(), component["name"].get<std::string>()) == names.end()) continue;
    indices.push_back(i);
    triangles += component["triangles"].get<std::uint64_t>();
  }
  return {indices, triangles};
}

void run(const Settings& settings) {
  std::string folder = (fs::temp_directory_path() / "dismantle-hand-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const Scene scene = write_scene(settings, folder);
  ServerOptions options;
  options.state_folder = fs::path(folder) / "state";
  options.model.classify.tolerance = load_assembly(settings.samples / "lathe.step").value().deflection * 2;
  const Result<std::unique_ptr<Server>> server = Server::start(std::move(options));
  if (!server || !(*server)->open_file(scene.file)) throw std::runtime_error("the server does not open the lathe");

  Client client({(*server)->port(), (*server)->token()});
  const Json model = client.event("model");
  client.state();
  const auto [set, triangles] = find_set(model, scene.set);
  std::printf("lathe: %llu triangles; in hand: %zu components, %llu triangles\n",
              model["triangles"].get<unsigned long long>(), set.size(), static_cast<unsigned long long>(triangles));
  const Json held = client.command("hold", {{"components", set}});
  const std::uint32_t grip = held["grip"];
  slide(client, grip, 1, 1, 0);  // builds the front
  std::printf(
      "targets\ta second\thand to pose: median [ms]\tp99\tmost\tsteps a second\tstep: median [us]\tp99\tin contact "
      "[%%]\tx [mm]\tleast z\n");
  measure(client, grip, "of a screen", settings, 1 / settings.rate);
  measure(client, grip, "at once", settings, 0);
  client.command("release");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dismantle::server

int main(int argc, char** argv) {
  dismantle::server::Settings settings;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view name = argv[i];
    if (name == "--targets") settings.targets = static_cast<std::uint32_t>(std::atoi(argv[i + 1]));
    if (name == "--rate") settings.rate = std::atof(argv[i + 1]);
    if (name == "--samples") settings.samples = argv[i + 1];
  }
  try {
    dismantle::server::run(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
