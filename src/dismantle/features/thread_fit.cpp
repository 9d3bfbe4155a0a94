// SPDX-License-Identifier: Apache-2.0
#include "dismantle/features/thread_fit.h"

#include "dismantle/features/axis_frame.h"
#include "dismantle/geometry/adjacency.h"
#include "dismantle/math/angle.h"
#include "dismantle/math/mat3.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dismantle {

namespace {

/// Faces that meet at a larger cosine are parts of one smooth surface.
constexpr double kSmooth = 0.85;
/// Faces that meet at a larger cosine are coplanar.
constexpr double kFlat = 1 - 1e-7;
/// Above every cosine: no faces count as coplanar.
constexpr double kAnyCosine = 2;
/// Fewer samples are not fitted.
constexpr std::size_t kMinSamples = 24;
/// Scales of the iteratively reweighted fit: the share of the velocity along the normal that halves a sample's weight.
/// The last ones separate a seat from a flank, which may differ only by the slope of the thread, one in twenty.
constexpr double kOff[] = {1, 0.3, 0.3, 0.1, 0.1, 0.1, 0.05, 0.05, 0.05, 0.02, 0.02, 0.02, 0.01, 0.01, 0.01, 0.01};
/// Samples with a smaller share are on the thread; at least kMinShare of the area must be.
constexpr double kOnThread = 0.03;
constexpr double kMinShare = 0.4;
/// Range of the axial component of a flank's normal. Flanks determine the rise; at least kMinFlanks of the area must be
/// flanks.
constexpr double kFlank[] = {0.1, 0.995};
constexpr double kMinFlanks = 0.2;
/// Range of the rise of a thread per radian, relative to its radius.
constexpr double kRise[] = {0.01, 3};
/// Regularisation against translations along a plain bore, which cost nothing.
constexpr double kRidge = 1e-9;

/// Sums of outer products.
struct Moments {
  Mat3 nn{{{}, {}, {}}}, nm{{{}, {}, {}}}, mm{{{}, {}, {}}};  // of normals n and moments m = p x n

  void add(const Vec3& n, const Vec3& m, double weight) {
    for (int i = 0; i < 3; ++i) {
      nn.row[i] += weight * n[i] * n;
      nm.row[i] += weight * n[i] * m;
      mm.row[i] += weight * m[i] * m;
    }
  }
};

Mat3 inverse_of(const Mat3& a) {
  const Vec3 bc = cross(a.row[1], a.row[2]), ca = cross(a.row[2], a.row[0]), ab = cross(a.row[0], a.row[1]);
  const double d = dot(a.row[0], bc);
  return transposed({{bc / d, ca / d, ab / d}});
}

/// The unit eigenvector of a symmetric matrix' smallest eigenvalue, by inverse iteration.
Vec3 min_direction(Mat3 a, double ridge) {
  for (int i = 0; i < 3; ++i) a.row[i][i] += ridge;
  const Mat3 inverse = inverse_of(a);
  Vec3 best;
  for (const Vec3& start : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    Vec3 v = start;
    for (int k = 0; k < 64; ++k) v = normalized(inverse * v);
    if (best == Vec3{} || dot(v, a * v) < dot(best, a * best)) best = v;
  }
  return best;
}

/// A screw motion about the origin: velocity v + w x p, |w| = 1.
struct Twist {
  Vec3 v, w;
};

/// The twist with a unit angular velocity and the smallest velocities along the normals.
Twist min_twist(const Moments& sums) {
  Mat3 nn = sums.nn;
  const double trace = nn.row[0].x + nn.row[1].y + nn.row[2].z;
  for (int i = 0; i < 3; ++i) nn.row[i][i] += kRidge * trace;
  const Mat3 v_from_w = inverse_of(nn) * sums.nm;  // v = -nn^-1 nm w
  Mat3 rest = transposed(sums.nm) * v_from_w;
  for (int i = 0; i < 3; ++i) rest.row[i] = sums.mm.row[i] - rest.row[i];
  const double size = sums.mm.row[0].x + sums.mm.row[1].y + sums.mm.row[2].z;
  const Vec3 w = min_direction(rest, kRidge * size);
  return {-(v_from_w * w), w};
}

/// A sample relative to the centroid of all, in units of their size.
struct Centred {
  Vec3 point, normal, moment;
  double weight;
};

double off(const Centred& s, const Twist& t) {
  const Vec3 velocity = t.v + cross(t.w, s.point);
  const double speed = length(velocity);
  return speed > 0 ? std::abs(dot(s.normal, velocity)) / speed : 0;
}

/// True if the samples that a twist moves along the surface make up a thread.
bool is_thread(const std::vector<Centred>& samples, const Twist& twist, double rise, double radius) {
  double on = 0, flanks = 0, all = 0;
  for (const Centred& s : samples) {
    all += s.weight;
    if (off(s, twist) > kOnThread) continue;
    on += s.weight;
    const double along = std::abs(dot(s.normal, twist.w));
    if (along > kFlank[0] && along < kFlank[1]) flanks += s.weight;
  }
  const double slope = std::abs(rise) / radius;
  return on > kMinShare * all && flanks > kMinFlanks * all && slope > kRise[0] && slope < kRise[1];
}

/// Sets the extent of the thread to that of the samples on it.
void set_extent(ThreadAxis& thread, Span<const SurfaceSample> samples, const std::vector<Centred>& centred,
                const Twist& twist) {
  const AxisFrame frame(thread.point, thread.direction);
  thread.begin = thread.min_radius = std::numeric_limits<double>::infinity();
  thread.end = -thread.begin;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (off(centred[i], twist) > kOnThread) continue;
    const double along = frame.along(samples[i].point), distance = length(frame.across(samples[i].point));
    thread.begin = std::min(thread.begin, along);
    thread.end = std::max(thread.end, along);
    thread.min_radius = std::min(thread.min_radius, distance);
    thread.max_radius = std::max(thread.max_radius, distance);
  }
}

Triangle triangle_of(Span<const Vec3> vertices, const Face& face) {
  return {{vertices[face.v[0]], vertices[face.v[1]], vertices[face.v[2]]}};
}

/// The sample at an edge between two faces; none if they form a corner, or meet at a cosine above `flat`.
std::optional<SurfaceSample> sample_of(Span<const Vec3> vertices, Span<const Face> faces, const NeighbouringFaces& pair,
                                       double flat) {
  const Vec3 a = 0.5 * normal_unscaled(triangle_of(vertices, faces[pair.face[0]]));
  const Vec3 b = 0.5 * normal_unscaled(triangle_of(vertices, faces[pair.face[1]]));
  const double cosine = dot(a, b), both = length(a) * length(b);
  if (!(cosine > kSmooth * both) || cosine > flat * both) return std::nullopt;
  const Vec3 middle = 0.5 * (vertices[pair.edge[0]] + vertices[pair.edge[1]]);
  return SurfaceSample{middle, normalized(normalized(a) + normalized(b)), std::min(length(a), length(b))};
}

}  // namespace

std::vector<SurfaceSample> smooth_samples(const TriangleMesh& mesh, Span<const std::uint8_t> of_interest) {
  std::vector<SurfaceSample> samples;
  for (const NeighbouringFaces& pair : neighbouring_faces(mesh.faces)) {
    if (of_interest[pair.face[0]] == 0 || of_interest[pair.face[1]] == 0) continue;
    if (const auto sample = sample_of(mesh.vertices, mesh.faces, pair, kAnyCosine)) samples.push_back(*sample);
  }
  return samples;
}

std::vector<SurfaceSample> curved_samples(Span<const Vec3> vertices, Span<const Face> faces, std::size_t max_count) {
  const std::vector<NeighbouringFaces> pairs = neighbouring_faces(faces);
  const std::size_t stride = 1 + pairs.size() / max_count;
  std::vector<SurfaceSample> samples;
  for (std::size_t i = 0; i < pairs.size(); i += stride)
    if (const auto sample = sample_of(vertices, faces, pairs[i], kFlat)) samples.push_back(*sample);
  return samples;
}

std::optional<ThreadAxis> fit_thread(Span<const SurfaceSample> samples) {
  Vec3 middle;
  double area = 0, square = 0;
  for (const SurfaceSample& s : samples) {
    middle += s.area * s.point;
    area += s.area;
  }
  if (samples.size() < kMinSamples || !(area > 0)) return std::nullopt;
  middle = middle / area;
  for (const SurfaceSample& s : samples) square += s.area * length_squared(s.point - middle) / area;
  const double size = std::sqrt(square);
  if (!(size > 0)) return std::nullopt;

  std::vector<Centred> centred;
  for (const SurfaceSample& s : samples) {
    const Vec3 p = (s.point - middle) / size;
    centred.push_back({p, s.normal, cross(p, s.normal), s.area / area});
  }
  Twist twist;
  for (const double half : kOff) {
    Moments sums;
    for (const Centred& s : centred) {
      const double ratio = twist.w == Vec3{} ? 0 : off(s, twist) / half;
      sums.add(s.normal, s.moment, s.weight / (1 + ratio * ratio));
    }
    twist = min_twist(sums);
  }
  const Vec3 foot = cross(twist.w, twist.v);
  double radius = 0;
  for (const Centred& s : centred) radius += s.weight * length(cross(twist.w, s.point - foot));
  const double rise = dot(twist.w, twist.v);
  if (!is_thread(centred, twist, rise, radius)) return std::nullopt;
  ThreadAxis thread;
  thread.point = middle + size * foot;
  thread.direction = twist.w;
  thread.lead = kTurn * size * rise;
  set_extent(thread, samples, centred, twist);
  return thread;
}

}  // namespace dismantle
