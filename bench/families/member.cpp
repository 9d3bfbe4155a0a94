// SPDX-License-Identifier: Apache-2.0
#include "bench/families/member.h"

#include "bench/families/depth_search.h"
#include "bench/families/drive.h"
#include "bench/families/path_judge.h"
#include "bench/timing.h"
#include "dismantle/certificates/certificate_engine.h"
#include "dismantle/documents/motion_file.h"
#include "dismantle/engine/classify_pairs.h"
#include "tests/support/meshes.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace dismantle::families {

namespace {

namespace fs = std::filesystem;

/// The allowance with which the oracle must find a straight motion free, in tolerances.
constexpr double kStuckShare = 0.05;
/// The library's depth may be this much above that of the oracle, in tolerances and as a share.
constexpr double kDepthGap = 0.2, kDepthShare = 0.02;

std::string text(const char* format, auto... values) {
  char line[300];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

/// The depth of a point inside a mesh; 0 outside.
double depth_of(const OracleMesh& mesh, Vec3 point) {
  const NearestFace near = mesh.nearest(point);
  return mesh.solid() && mesh.inside(point, near) ? near.distance : 0;
}

/// True if a corner or the middle of a face of either mesh gets deeper in the other, on a straight way, than both the
/// tolerance and its depth at the start: how deep two components may overlap depends on the place.
bool overlaps_elsewhere(const JudgedPair& pair, Vec3 way) {
  constexpr int kTimes = 24;
  const auto gets_deeper = [&](const OracleMesh& other, Vec3 along, Vec3 point) {
    const double allowed = std::max(depth_of(other, point), pair.tolerance) + kStuckShare * pair.tolerance;
    for (int k = 1; k <= kTimes; ++k)
      if (depth_of(other, point + (1.0 * k / kTimes) * along) > allowed) return true;
    return false;
  };
  const auto any_gets_deeper = [&](const OracleMesh& points, const OracleMesh& other, Vec3 along) {
    const TriangleMesh& mesh = points.mesh();
    for (const Vec3& p : mesh.vertices)
      if (gets_deeper(other, along, p)) return true;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle t = mesh.triangle(f);
      if (gets_deeper(other, along, (t[0] + t[1] + t[2]) / 3.0)) return true;
    }
    return false;
  };
  return any_gets_deeper(pair.moving, pair.fixed, way) || any_gets_deeper(pair.fixed, pair.moving, -way);
}

class Member {
 public:
  Member(const MemberKey& key, const MemberOptions& options, const std::function<void(const std::string&)>& report)
      : options_(options),
        report_(report),
        random_(key.seed * 1'000'003 + key.number * 101 + key.family),
        scene_(make_scene(key.family, random_)) {
    std::vector<Component> components;
    for (const Part& part : scene_.parts) components.push_back(scenes::component(part.name, part.mesh));
    assembly_ = scenes::assembly(std::move(components));
    folder_ = fs::path(options.dump) / text("%s-%llu-%llu", std::string(kFamilies[key.family]).c_str(),
                                            static_cast<unsigned long long>(key.seed),
                                            static_cast<unsigned long long>(key.number));
  }

  MemberResult run() {
    const bench::Stopwatch watch;
    if (!options_.dump.empty()) write_parts();
    report_("pairs");
    ClassifyOptions classify;
    classify.tolerance = scene_.tolerance;
    states_ = *classify_pairs(assembly_, classify);
    report_("engine");
    Dice dice{random_};
    std::vector<Drive> straight;
    {
      CertificateEngine engine(assembly_, states_);
      for (const ComponentPair& p : engine.overlapping_pairs()) declared_ = p.allowed_depth;
      drive_ = drive(scene_, engine, dice, options_.max_steps, options_.engine_seconds);
    }
    if (!options_.dump.empty()) write("motion", drive_.motion);
    result_.steps = drive_.steps;
    result_.slowest_ms = drive_.slowest_ms;
    result_.engine_seconds = drive_.seconds;
    report_("oracle");
    const JudgedPair pair{{*assembly_.components[0].mesh, scene_.parts[0].solid, scene_.parts[0].simple},
                          {*assembly_.components[1].mesh, scene_.parts[1].solid, scene_.parts[1].simple},
                          scene_.tolerance};
    judge_drive(pair);
    report_("straight");
    for (const Vec3& exit : scene_.exits) pull_out(pair, exit, dice);
    pull_out(pair, -1 * scene_.toward, dice);
    pull_out(pair, normalized(cross(scene_.toward, dice.direction())), dice);
    result_.seconds = watch.seconds();
    return std::move(result_);
  }

 private:
  void write_parts() const {
    fs::create_directories(folder_ / "parts");
    for (const Part& part : scene_.parts) {
      std::ofstream file(folder_ / "parts" / (part.name + ".obj"));
      for (const Vec3& p : part.mesh.vertices) file << text("v %.17g %.17g %.17g\n", p.x, p.y, p.z);
      for (const Face& f : part.mesh.faces)
        file << "f " << f.v[0] + 1 << ' ' << f.v[1] + 1 << ' ' << f.v[2] + 1 << '\n';
    }
    std::ofstream(folder_ / "tolerance") << text("%.17g\n", scene_.tolerance);
  }

  void write(const std::string& name, const Motion& motion) const {
    if (!write_motion(folder_ / (name + ".motion.json"), motion))
      std::fprintf(stderr, "%s: not written\n", name.c_str());
  }

  void judge_drive(const JudgedPair& pair) {
    JudgeOptions options;
    options.declared = declared_;
    options.sagittas = scene_.sagittas;
    options.near_moving = drive_.near_moving;
    options.near_fixed = drive_.near_fixed;
    options.seed = random_();
    const Verdict v = judge(pair, drive_.poses, options);
    result_.depth_ratio = v.ratio;
    result_.doubted = v.doubted;
    const auto step = [&](double time) {
      const auto k = static_cast<std::size_t>(time);
      return k < drive_.step_of.size() ? drive_.step_of[k] : drive_.step_of.empty() ? 0 : drive_.step_of.back();
    };
    const std::string about = text("tolerance %.4g, start depth %.4g, %s", scene_.tolerance, v.start_depth,
                                   std::string(name_of(drive_.motion.response)).c_str());
    if (v.beyond) {
      result_.beyond = 1;
      note(text("too deep, %.3g of the allowance, step %zu, pose %.3f; ", v.ratio, step(v.beyond_at), v.beyond_at) +
           about);
    }
    if (v.passed) {
      result_.passed = 1;
      result_.passed_by = v.passed_by;
      note(text("passed, by %.3g, step %zu, pose %.3f, %s point (%.6g %.6g %.6g); ", v.passed_by, step(v.passed_at),
                v.passed_at, v.passed_moving ? "moving" : "fixed", v.passed_point.x, v.passed_point.y,
                v.passed_point.z) +
           about);
    }
    check_start(pair, v.start_depth);
  }

  /// The library's depth is a bound, and not far from the depth.
  void check_start(const JudgedPair& pair, double bound) {
    const FoundDepth found = search_depth(pair.moving, pair.fixed, {}, {0.01 * scene_.tolerance});
    const ComponentPair* known = states_.find(ComponentId(0), ComponentId(1));
    const double depth = known ? known->depth : 0;
    start_depth_ = found.attained;
    const bool good = found.attained <= depth + 1e-3 * scene_.tolerance &&
                      depth <= bound * (1 + kDepthShare) + kDepthGap * scene_.tolerance + 1e-3;
    // Curved sheets enclose something, too, by the library's measure.
    if (good || found.cut || !pair.moving.solid() || !pair.fixed.solid()) return;
    ++result_.errors;
    note(text("depth at the start: %.6g in the library, %.6g to %.6g by the oracle", depth, found.attained, bound));
  }

  void pull_out(const JudgedPair& pair, Vec3 direction, Dice& dice) {
    const Vec3 way = 1.3 * scene_.size * direction;
    JudgeOptions options;
    options.extra = kStuckShare - 1;
    options.slack = kStuckShare;
    options.depths = 60;
    options.seed = random_();
    options.samples = 300;
    const Verdict free = judge(pair, {{}, {way, {}}}, options);
    if (free.beyond || free.passed || free.doubted > 0) return;
    const ComponentPair* known = states_.find(ComponentId(0), ComponentId(1));
    if (known && known->depth > pair.tolerance && overlaps_elsewhere(pair, way)) return;
    ++result_.straight;
    CertificateEngine engine(assembly_, states_);
    const Drive pulled = pull(scene_, engine, way, dice);
    result_.slowest_ms = std::max(result_.slowest_ms, pulled.slowest_ms);
    result_.engine_seconds += pulled.seconds;
    if (!options_.dump.empty()) write(text("straight%d", result_.straight), pulled.motion);
    const double made = dot(engine.poses()[0].position, way) / dot(way, way);
    if (engine.poses()[0].position == way) return;
    ++result_.stuck;
    note(text("stuck after %.6f of straight%d (%.3g %.3g %.3g), %s, tolerance %.4g, start depth %.4g", made,
              result_.straight, way.x, way.y, way.z, std::string(name_of(pulled.motion.response)).c_str(),
              scene_.tolerance, start_depth_));
  }

  void note(const std::string& what) { result_.note += (result_.note.empty() ? "" : "\n      ") + what; }

  const MemberOptions& options_;
  const std::function<void(const std::string&)>& report_;
  std::mt19937_64 random_;
  Scene scene_;
  Assembly assembly_;
  PairStates states_;
  fs::path folder_;
  Drive drive_;
  double start_depth_ = 0, declared_ = 0;
  MemberResult result_;
};

}  // namespace

MemberResult run_member(const MemberKey& key, const MemberOptions& options,
                        const std::function<void(const std::string&)>& report) {
  return Member(key, options, report).run();
}

}  // namespace dismantle::families
