// SPDX-License-Identifier: Apache-2.0
// bench_ccd_triangles: what the certified test of a moving triangle pair costs, one core. Pairs are random triangles of
// size 1, `gap` apart at the start (half to one and a half times); one of them moves by up to `move` and turns by a
// third of it. Prints a line a scene (tab-separated, header first): mean ns a test of the free pairs without and with
// the axis that an earlier test ended on, and of the pairs that come into contact; the fastest of kPasses passes each.
#include "dismantle/narrowphase/ccd_triangle_triangle.h"

#include <chrono>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace dismantle;
using Clock = std::chrono::steady_clock;

constexpr int kPasses = 30;
constexpr std::size_t kPairs = 3000;
constexpr unsigned kSeed = 7;

struct Scene {
  const char* name;
  double gap, move, allowed;
  double sliver;  ///< The height of the triangles; 0 for any.
};

constexpr Scene kScenes[] = {
    {"apart", 0.1, 0.02, 0, 0},
    {"near", 0.01, 0.02, 0, 0},
    {"near, allowance", 0.01, 0.02, 0.005, 0},
    {"near, far move", 0.01, 0.3, 0.001, 0},
    {"close", 0.001, 0.01, 0, 0},
    {"slivers", 0.01, 0.02, 0, 0.01},
    {"slivers, far move", 0.01, 0.3, 0.001, 0.01},
};

struct Pair {
  TriangleMotion a, b;
};

class Pairs {
 public:
  explicit Pairs(const Scene& scene) : scene_(scene), random_(kSeed) {}

  Pair next() {
    for (;;) {
      const Triangle a = triangle({});
      Triangle b = triangle(vector(1.2));
      const AxisCcdResult apart = ccd_triangle_triangle({a, a}, {b, b}, 0, Vec3{});
      if (apart.ccd.status != CcdStatus::Free) continue;
      const Vec3 axis = normalized(apart.axis);
      const Vec3 shift = (scene_.gap * number(0.5, 1.5) - gap(a, b, axis)) * axis;
      for (Vec3& p : b.corner) p += shift;
      return {moved(a), {b, b}};
    }
  }

 private:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3 vector(double size) {
    const double x = number(-size, size), y = number(-size, size);
    return {x, y, number(-size, size)};
  }
  Triangle triangle(Vec3 centre) {
    Triangle t;
    for (Vec3& p : t.corner) p = centre + vector(1);
    if (scene_.sliver > 0) t[2] = t[0] + 0.5 * (t[1] - t[0]) + vector(scene_.sliver);
    return t;
  }
  TriangleMotion moved(const Triangle& t) {
    const Vec3 way = scene_.move * vector(1);
    const double angle = scene_.move * number(-0.3, 0.3);
    TriangleMotion m{t, t};
    for (Vec3& p : m.t1.corner) p = Vec3{p.x - angle * p.y, p.y + angle * p.x, p.z} + way;
    return m;
  }
  static double gap(const Triangle& a, const Triangle& b, Vec3 axis) {
    double least = dot(axis, b[0]), most = dot(axis, a[0]);
    for (int i = 1; i < 3; ++i) {
      least = dot(axis, b[i]) < least ? dot(axis, b[i]) : least;
      most = dot(axis, a[i]) > most ? dot(axis, a[i]) : most;
    }
    return least - most;
  }

  Scene scene_;
  std::mt19937_64 random_;
};

/// Mean ns of a test of the pairs, with a hint each.
double measure(const std::vector<Pair>& pairs, const std::vector<Vec3>& hints, double allowed) {
  double fastest = 0;
  for (int pass = 0; pass <= kPasses && !pairs.empty(); ++pass) {
    const Clock::time_point start = Clock::now();
    double sum = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      sum += ccd_triangle_triangle(pairs[i].a, pairs[i].b, allowed, hints[i]).ccd.toi;
    asm volatile("" : : "g"(&sum) : "memory");
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count() / pairs.size();
    if (pass == 1 || (pass > 1 && ns < fastest)) fastest = ns;
  }
  return fastest;
}

void run(const Scene& scene) {
  Pairs source(scene);
  std::vector<Pair> free, hits;
  std::vector<Vec3> hints;
  int steps = 0;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Pair pair = source.next();
    const AxisCcdResult r = ccd_triangle_triangle(pair.a, pair.b, scene.allowed, Vec3{});
    if (r.ccd.status == CcdStatus::Free) {
      free.push_back(pair);
      hints.push_back(r.axis);
    } else {
      hits.push_back(pair);
      steps += r.ccd.iterations;
    }
  }
  const std::vector<Vec3> none(kPairs);
  std::printf("%s\t%zu\t%.0f\t%.0f\t%zu\t%.0f\t%.2f\n", scene.name, free.size(), measure(free, none, scene.allowed),
              measure(free, hints, scene.allowed), hits.size(), measure(hits, none, scene.allowed),
              hits.empty() ? 0.0 : static_cast<double>(steps) / hits.size());
}

}  // namespace

int main() {
  std::printf("scene\tfree\tfree_ns\tfree_hint_ns\thits\thit_ns\thit_steps\n");
  for (const Scene& scene : kScenes) run(scene);
  return 0;
}
