// SPDX-License-Identifier: Apache-2.0
// How deep do components get in each other on a path? By the oracle of soak_families, which shares no code with the
// methods or the audit: branch and bound over both surfaces with winding numbers, at many times.
//   judge_path [--poses N] [--min-depth MM] [--ghosts] ASSEMBLY PATH
// One row a pair that moves against each other and gets deeper than --min-depth, tab-separated, lengths in mm:
//   start     in the assembled state             deepest   on the way, and at which pose of the pair's own track
//   parted    the pose from which on the two have been apart (-1: never), and after: the greatest depth from then on
//   passed    with --ghosts: 1 where a point of a surface was passed by the other one, with the allowance of the path
#include "bench/command_line.h"
#include "bench/families/depth_search.h"
#include "bench/families/path_judge.h"
#include "bench/families/screw_track.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/loading/load_assembly.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace dismantle::families {
namespace {

struct Settings {
  int poses = 400;       // at which depths are searched for
  double min_depth = 0;  // of the pairs that are listed [mm]
  bool ghosts = false;
};

/// A component whose poses are followed through the moves.
struct Body {
  std::string name;
  OracleMesh mesh;
  Pose pose;
};

/// The pose of one body as seen from another one.
Pose relative(const Pose& fixed, const Pose& moving) {
  const Quat back = conjugate(fixed.rotation);
  return {mat3_from_quat(back) * (moving.position - fixed.position), back * moving.rotation};
}

/// The box of a mesh after a motion.
Aabb moved_box(const Aabb& box, const RigidTransform& by) {
  Aabb moved;
  for (int i = 0; i < 8; ++i)
    moved.extend(by * Vec3{(i & 1 ? box.upper : box.lower).x, (i & 2 ? box.upper : box.lower).y,
                           (i & 4 ? box.upper : box.lower).z});
  return moved;
}

void judge_pair(const Body& moving, const Body& fixed, const std::vector<Pose>& poses, const Path& path,
                const Settings& settings) {
  const ScrewTrack track(poses);
  std::vector<double> times;
  const int count = std::max(1, std::min<int>(settings.poses, static_cast<int>(8 * poses.size())));
  for (int i = 0; i <= count; ++i) times.push_back(track.end() * i / count);
  if (poses.size() <= static_cast<std::size_t>(settings.poses))
    for (std::size_t k = 0; k < poses.size(); ++k) times.push_back(static_cast<double>(k));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());

  const double tolerance = path.tolerance;
  const DepthEffort effort{0.02 * tolerance, 20000, 0};
  const FoundDepth start = search_depth(moving.mesh, fixed.mesh, track.at(0), {0.02 * tolerance});
  double deepest = start.attained, deepest_at = 0, after = 0, parted = -1;
  for (const double time : times) {
    const RigidTransform at = track.at(time);
    const bool near = overlaps(moved_box(moving.mesh.bounds(), at), fixed.mesh.bounds());
    if (near) {
      const FoundDepth found = search_depth(moving.mesh, fixed.mesh, at, effort);
      if (found.attained > deepest) deepest = found.attained, deepest_at = time;
      if (parted >= 0) after = std::max(after, found.attained);
    }
    if (parted < 0 && time > 0 && (!near || apart(moving.mesh, fixed.mesh, at, tolerance))) parted = time;
  }
  Verdict verdict;
  if (settings.ghosts) {
    JudgeOptions options;
    for (const PathPair& p : path.pairs)
      if ((p.a == moving.name && p.b == fixed.name) || (p.b == moving.name && p.a == fixed.name))
        options.declared = p.allowed_depth;
    verdict = judge({moving.mesh, fixed.mesh, tolerance}, poses, options);
  }
  if (deepest < settings.min_depth && !verdict.passed) return;
  std::printf("%s\t%s\t%.6g\t%.6g\t%.6g\t%.2f\t%.2f\t%.6g\t%d\n", moving.name.c_str(), fixed.name.c_str(),
              start.attained, start.bound, deepest, deepest_at, parted, after, verdict.passed ? 1 : 0);
  std::fflush(stdout);
}

int run(const std::string& assembly_file, const std::string& path_file, const Settings& settings) {
  const Result<Assembly> assembly = load_assembly(assembly_file);
  const Result<Path> path = read_path(path_file);
  if (!assembly || !path) {
    std::fprintf(stderr, "judge_path: %s\n", (assembly ? path.error() : assembly.error()).message.c_str());
    return bench::kExitUnreadable;
  }
  if (const Result<Done> known = check_names(*path, *assembly); !known) {
    std::fprintf(stderr, "judge_path: %s\n", known.error().message.c_str());
    return bench::kExitUnreadable;
  }
  std::vector<Body> bodies;
  for (const Component& c : assembly->components) {
    TriangleMesh mesh = assembled_mesh(c);
    const bool solid = is_solid(mesh);
    bodies.push_back({c.name, OracleMesh(std::move(mesh), solid, false), {}});
  }
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Pose>> tracks;
  for (const Move& move : path->moves) {
    std::vector<bool> moves(bodies.size());
    for (const std::string& name : move.components) moves[assembly->find(name)->value] = true;
    for (const Frame& frame : move.frames) {
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (moves[i]) bodies[i].pose = frame.pose;
      for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t k = 0; moves[i] && k < bodies.size(); ++k) {
          if (moves[k]) continue;
          const std::size_t a = std::min(i, k), b = std::max(i, k);
          std::vector<Pose>& poses = tracks[{a, b}];
          if (poses.empty()) poses.push_back({});
          const Pose pose = relative(bodies[b].pose, bodies[a].pose);
          if (!(poses.back() == pose)) poses.push_back(pose);
        }
    }
  }
  std::printf("moving\tfixed\tstart\tstart_bound\tdeepest\tat\tparted\tafter\tpassed\n");
  for (const auto& [pair, poses] : tracks) {
    const Body &a = bodies[pair.first], &b = bodies[pair.second];
    bool near = false;
    const ScrewTrack track(poses);
    for (double time = 0; time <= track.end() && !near; time += 0.25)
      near = overlaps(moved_box(a.mesh.bounds(), track.at(time)), b.mesh.bounds());
    if (near) judge_pair(a, b, poses, *path, settings);
  }
  return 0;
}

}  // namespace
}  // namespace dismantle::families

int main(int argc, char** argv) {
  using namespace dismantle;
  families::Settings settings;
  std::vector<std::string> words;
  bench::CommandLine line("judge_path [--poses N] [--min-depth MM] [--ghosts] ASSEMBLY PATH");
  line.option("--poses", settings.poses, 1);
  line.option("--min-depth", settings.min_depth);
  line.flag("--ghosts", settings.ghosts);
  line.words(words);
  if (!line.parse(argc, argv)) return bench::kExitUsage;
  if (words.size() != 2) return line.wrong(), bench::kExitUsage;
  return families::run(words[0], words[1], settings);
}
