// SPDX-License-Identifier: Apache-2.0
// Time of the certified continuous test of triangle pairs, one thread.
//   bench_ccd_triangles
// Pairs are random triangles of size 1, `gap` apart at the start (half to one and a half times); one of them moves by
// up to `move` and turns by up to a third of it. One row a scene, tab-separated: mean time of a test of the free pairs,
// of the same pairs with the axis that an earlier test found as a hint, and of the pairs that come into contact; the
// fastest of kPasses passes each.
#include "bench/timing.h"
#include "dismantle/narrowphase/ccd_triangle_triangle.h"

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace dismantle;

constexpr int kPasses = 30;
constexpr std::size_t kPairs = 3000;
constexpr unsigned kSeed = 7;

struct Scene {
  const char* name;
  double gap, move, allowed;
  double sliver;  ///< Height of the triangles; 0: no limit.
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
    const Vec3 displacement = scene_.move * vector(1);
    const double angle = scene_.move * number(-0.3, 0.3);
    TriangleMotion m{t, t};
    for (Vec3& p : m.t1.corner) p = Vec3{p.x - angle * p.y, p.y + angle * p.x, p.z} + displacement;
    return m;
  }
  static double gap(const Triangle& a, const Triangle& b, Vec3 axis) {
    double min_b = dot(axis, b[0]), max_a = dot(axis, a[0]);
    for (int i = 1; i < 3; ++i) {
      min_b = std::min(min_b, dot(axis, b[i]));
      max_a = std::max(max_a, dot(axis, a[i]));
    }
    return min_b - max_a;
  }

  Scene scene_;
  std::mt19937_64 random_;
};

/// Mean time of a test of the pairs, with a hint for each [ns].
double measure(const std::vector<Pair>& pairs, const std::vector<Vec3>& hints, double allowed) {
  if (pairs.empty()) return 0;
  const double fastest = bench::fastest_ns(kPasses, [&] {
    double sum = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      sum += ccd_triangle_triangle(pairs[i].a, pairs[i].b, allowed, hints[i]).ccd.toi;
    bench::keep(sum);
  });
  return fastest / pairs.size();
}

void run(const Scene& scene) {
  Pairs source(scene);
  std::vector<Pair> free, hits;
  std::vector<Vec3> hints;
  int iterations = 0;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const Pair pair = source.next();
    const AxisCcdResult r = ccd_triangle_triangle(pair.a, pair.b, scene.allowed, Vec3{});
    if (r.ccd.status == CcdStatus::Free) {
      free.push_back(pair);
      hints.push_back(r.axis);
    } else {
      hits.push_back(pair);
      iterations += r.ccd.iterations;
    }
  }
  const std::vector<Vec3> none(kPairs);
  std::printf("%s\t%zu\t%.0f\t%.0f\t%zu\t%.0f\t%.2f\n", scene.name, free.size(), measure(free, none, scene.allowed),
              measure(free, hints, scene.allowed), hits.size(), measure(hits, none, scene.allowed),
              hits.empty() ? 0.0 : static_cast<double>(iterations) / hits.size());
}

}  // namespace

int main() {
  std::printf("scene\tfree_pairs\tfree_mean_ns\tfree_with_hint_mean_ns\thits\thit_mean_ns\thit_mean_iterations\n");
  for (const Scene& scene : kScenes) run(scene);
  return 0;
}
