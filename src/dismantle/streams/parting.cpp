// SPDX-License-Identifier: Apache-2.0
#include "dismantle/streams/parting.h"

#include "dismantle/bvh/bvh_traverse.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"
#include "dismantle/narrowphase/penetration_triangle_triangle.h"
#include "dismantle/streams/narrow_phase_kernel.h"
#include "dismantle/surface/vertex_regions.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

constexpr int kVertexSamples = 64;   // vertices of each component that certificate 4 tests
constexpr int kMaxIntervals = 4096;  // the pair counts as parted after so many

/// Two triangles whose vertices may deviate from their linear paths.
struct PerturbedPair {
  const TriangleMotion& a;
  const TriangleMotion& b;
  double determinant_change;  // maximum effect on a determinant of three differences of their corners
};

PerturbedPair perturbed(const TriangleMotion& a, const TriangleMotion& b, double deviation) {
  double longest = 0;  // squared difference of two corners at either end; none is longer in between
  const auto compare = [&](const TriangleMotion& m, const TriangleMotion& n) {
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        longest = std::max({longest, length_squared(m.t0[k] - n.t0[l]), length_squared(m.t1[k] - n.t1[l])});
  };
  compare(a, b);
  compare(a, a);
  compare(b, b);
  const double edge = std::sqrt(longest), shift = 2 * deviation;
  return {a, b, (3 * edge * edge + 3 * edge * shift + shift * shift) * shift * (1 + 1e-9)};
}

/// The strict sign that the cubic, changed by up to `change`, certainly has throughout [0, 1]; 0 if there is none.
int lasting_sign(BernsteinCubic cubic, double change) {
  cubic.error += change;
  if (!certainly_never_coplanar(cubic)) return 0;
  return cubic.c[0] > 0 ? 1 : -1;
}

/// Certificate 1 for edge k of one triangle and the face of the other.
bool pierces_throughout(const TriangleMotion& edges, int k, const TriangleMotion& face, double change) {
  const int next = (k + 1) % 3;
  const VertexFaceMotion first{edges.t0[k], edges.t1[k], face.t0, face.t1};
  const VertexFaceMotion second{edges.t0[next], edges.t1[next], face.t0, face.t1};
  const int side = lasting_sign(coplanarity_cubic(first), change);
  if (side == 0 || lasting_sign(coplanarity_cubic(second), change) != -side) return false;
  int around = 0;
  for (int j = 0; j < 3; ++j) {
    const int j_next = (j + 1) % 3;
    const EdgeEdgeMotion past{{edges.t0[k], edges.t0[next]},
                              {edges.t1[k], edges.t1[next]},
                              {face.t0[j], face.t0[j_next]},
                              {face.t1[j], face.t1[j_next]}};
    const int sign = lasting_sign(coplanarity_cubic(past), change);
    if (sign == 0 || sign == -around) return false;
    around = sign;
  }
  return true;
}

bool pierces_throughout(const PerturbedPair& pair) {
  for (int k = 0; k < 3; ++k) {
    if (pierces_throughout(pair.a, k, pair.b, pair.determinant_change)) return true;
    if (pierces_throughout(pair.b, k, pair.a, pair.determinant_change)) return true;
  }
  return false;
}

/// Queries of one pair of S_i at times and over intervals of a step.
class PartingSearch {
 public:
  explicit PartingSearch(const EmbeddedMotion& motion) : m_(motion) {}

  MomentaryTriangles at(double s) const { return {m_.streams, m_.step, m_.bounds, s}; }

  std::vector<std::uint64_t> intersecting(double s) const {
    const MomentaryTriangles now = at(s);
    std::vector<std::uint64_t> keys;
    for (const std::uint64_t key : m_.triangle_pairs) {
      const NodePair p = pair_of_key(key);
      if (intersect_triangle_triangle(now.triangle(p.a), now.triangle(p.b))) keys.push_back(key);
    }
    return keys;
  }

  bool one_inside_other(double s) const {
    const std::vector<BvhComponent>& components = m_.streams->bvh.components;
    const NodeIndex a = components[m_.a.value].root, b = components[m_.b.value].root;
    if (a == kNoNode || b == kNoNode || !overlaps(m_.bounds[a], m_.bounds[b])) return false;
    return some_inside(s, m_.a, m_.b, m_.b_closed) || some_inside(s, m_.b, m_.a, m_.a_closed);
  }

  bool certain(double begin, double end, Span<const std::uint64_t> intersecting_at_begin) const {
    if (any_pierces(begin, end, intersecting_at_begin)) return true;
    if (intersecting_at_begin.empty() && one_inside_other(begin) && none_meets(begin, end)) return true;
    const double displacement = m_.displacement * (end - begin) + 2 * m_.path_deviation;
    return any_deeper(begin, displacement, intersecting_at_begin) ||
           some_vertex_deeper(begin, displacement, m_.a, m_.b, m_.b_closed) ||
           some_vertex_deeper(begin, displacement, m_.b, m_.a, m_.a_closed);
  }

  bool any_pierces(double begin, double end, Span<const std::uint64_t> keys) const {
    return std::any_of(keys.begin(), keys.end(), [&](std::uint64_t key) {
      const NodePair p = pair_of_key(key);
      const TriangleMotion a = part_of(m_.step.motion(p.a), begin, end);
      const TriangleMotion b = part_of(m_.step.motion(p.b), begin, end);
      return pierces_throughout(perturbed(a, b, m_.path_deviation));
    });
  }

 private:
  bool some_inside(double s, ComponentId of, ComponentId other, bool other_closed) const {
    if (!other_closed) return false;
    const MomentaryTriangles now = at(s);
    const std::vector<std::uint32_t> vertices = shell_vertices(*m_.streams, of);
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](std::uint32_t v) { return point_in_component(now, now.vertex(v), other); });
  }

  bool none_meets(double begin, double end) const {
    return std::none_of(m_.triangle_pairs.begin(), m_.triangle_pairs.end(), [&](std::uint64_t key) {
      const NodePair p = pair_of_key(key);
      return ccd_triangle_triangle(part_of(m_.step.motion(p.a), begin, end), part_of(m_.step.motion(p.b), begin, end),
                                   0)
                 .status == CcdStatus::Contact;
    });
  }

  bool any_deeper(double s, double displacement, Span<const std::uint64_t> keys) const {
    const MomentaryTriangles now = at(s);
    return std::any_of(keys.begin(), keys.end(), [&](std::uint64_t key) {
      const NodePair p = pair_of_key(key);
      const Triangle a = now.triangle(p.a), b = now.triangle(p.b);
      // The error of a depth is the rounding of the coordinates; a relative 1e-6 is far above it.
      return penetration_triangle_triangle(a, b).depth > displacement * (1 + 1e-6) + 1e-9 * max_abs(a[0] - b[0]);
    });
  }

  bool some_vertex_deeper(double s, double displacement, ComponentId of, ComponentId other, bool other_closed) const {
    if (!other_closed) return false;
    const MomentaryTriangles now = at(s);
    const std::uint32_t begin = m_.streams->vertex_begin[of.value], end = m_.streams->vertex_begin[of.value + 1];
    const std::uint32_t stride = 1 + (end - begin) / kVertexSamples;
    for (std::uint32_t v = begin; v < end; v += stride) {
      const Vec3 p = now.vertex(v);
      if (!surface_within(now, p, other, displacement) && point_in_component(now, p, other)) return true;
    }
    return false;
  }

  const EmbeddedMotion& m_;
};

}  // namespace

bool pierced_throughout(const EmbeddedMotion& motion) {
  return PartingSearch(motion).any_pierces(0, 1, motion.intersecting_at_end);
}

bool components_intersect(const EmbeddedMotion& motion, double s) {
  const PartingSearch search(motion);
  return !search.intersecting(s).empty() || search.one_inside_other(s);
}

std::optional<double> parted_from(const EmbeddedMotion& motion) {
  const PartingSearch search(motion);
  double begin = 0, length = 1;
  std::vector<std::uint64_t> intersecting = search.intersecting(0);
  for (int k = 0; k < kMaxIntervals; ++k) {
    const double end = std::min(1.0, begin + length);
    if (search.certain(begin, end, intersecting)) {
      if (end == 1) return std::nullopt;
      begin = end;
      length *= 2;
      intersecting = search.intersecting(begin);
    } else if (motion.displacement * length <= kPartingShare * motion.tolerance) {
      return begin;
    } else {
      length /= 2;
    }
  }
  return begin;
}

}  // namespace dismantle
