// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener_shape.h"

#include "dismantle/fasteners/fastener_sizes.h"
#include "dismantle/fasteners/headed_shape.h"
#include "dismantle/fasteners/hexagon_drives.h"
#include "dismantle/fasteners/standard_sizes.h"
#include "dismantle/features/thread_axes.h"
#include "dismantle/proposals/shape_kinds.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dismantle {

namespace {

using Certainty = FastenerShape::Certainty;
using Drive = Fastener::Drive;
using Head = Fastener::Head;
using Kind = Fastener::Kind;

/// Number of sections of a shape.
constexpr std::size_t kSections = 192;
/// Threads are looked for in meshes of no more faces.
constexpr std::size_t kMaxThreadFaces = 200'000;
/// A plain pin, and a set screw, is no longer than this many diameters, a pin no shorter than the other.
constexpr double kLongest = 10, kShortestPin = 1.5;
/// Pins and rings by shape alone are of these diameters [mm]: thinner ones are wires and contacts, thicker ones
/// machine parts.
constexpr double kThinnestPin = 1.5, kThickestPin = 20, kWidestWasher = 36;
/// The largest set screw with a slot or cross by its shape alone [mm], and the least length in diameters.
constexpr double kWidestSlotted = 20, kShortestScrew = 0.6;
/// Teeth of a knurl around.
constexpr std::size_t kMinTeeth = 5;
/// Sections of a head, at least, by which its form is read; and sections in all, at most.
constexpr double kHeadSections = 24, kMaxSections = 1024;
/// A hole goes through if it is in this share of the sections; rounded edges may close the others.
constexpr double kThrough = 0.95;

/// The shapes that a mesh may be about one axis.
class AxisReader {
 public:
  AxisReader(const TriangleMesh& mesh, const FastenerAxis& axis)
      : mesh_(mesh), axis_(axis), sections_(axial_sections(mesh, axis.frame, kSections)) {
    for (const AxialSection& s : sections_) {
      hollow_ += s.axis_is_empty();
      holes_.push_back(s.hole_min());
      outers_.push_back(s.outer_max());
    }
    for (const HexagonDrive& drive : hexagon_drives(mesh, {axis.frame.point, axis.frame.direction, 0}))
      if (drive.kind == HexagonDrive::Kind::Head) hexagon_ = std::max(hexagon_, drive.across_flats);
  }

  std::vector<FastenerShape> run() {
    if (static_cast<double>(hollow_) > kThrough * kSections) {
      read_ring();
    } else if (!read_standoff()) {
      if (const auto headed = headed_shape(mesh_, axis_, sections_))
        read_headed(finer(*headed));
      else
        read_plain();
    }
    return std::move(found_);
  }

 private:
  Fastener fastener(Kind kind) const {
    Fastener f;
    f.kind = kind;
    f.point = axis_.frame.point;
    f.axis = axis_.frame.direction;
    return f;
  }

  void add(Fastener f, Certainty certainty) {
    const bool threaded =
        f.kind == Kind::Screw || f.kind == Kind::Nut || f.kind == Kind::Insert || f.kind == Kind::Standoff;
    if (threaded && f.pitch == 0)
      if (const ThreadSize* size = thread_size(f.diameter)) f.pitch = size->pitch;
    f.length = rounded_length(f.length);
    found_.push_back({f, certainty});
  }

  /// The thread of the mesh about the axis: outer above 0, inner below.
  std::optional<ThreadAxis> thread(double side) const {
    if (mesh_.faces.size() > kMaxThreadFaces) return std::nullopt;
    const std::vector<RevolutionAxis> axes{{axis_.frame.point, axis_.frame.direction, 0}};
    for (const ThreadAxis& t : thread_axes(mesh_.vertices, mesh_.faces, axes))
      if (t.radial_sum() * side > 0 && std::abs(dot(t.direction, axis_.frame.direction)) > 0.999 && is_fastening(t))
        return t;
    return std::nullopt;
  }

  /// True for the pitches that fasteners have, over some turns; false for knurls, worms and what only looks like one.
  static bool is_fastening(const ThreadAxis& t) {
    const double pitch = std::abs(t.lead) / t.starts;
    return pitch > 0.03 * 2 * t.max_radius && pitch < 0.5 * 2 * t.max_radius && t.end - t.begin > 2 * pitch;
  }

  static void set_thread(Fastener& f, const ThreadAxis& t) {
    f.pitch = std::round(1000 * std::abs(t.lead) / t.starts) / 1000;
    f.thread_is_modelled = true;
    f.left_handed = t.lead < 0;
  }

  /// The same with enough sections of a low head on a long shank.
  HeadedShape finer(const HeadedShape& shape) const {
    const double wanted = kHeadSections * shape.total_length / shape.head_height;
    if (!(wanted > kSections)) return shape;
    const auto count = static_cast<std::size_t>(std::min(wanted, kMaxSections));
    return headed_shape(mesh_, axis_, axial_sections(mesh_, axis_.frame, count)).value_or(shape);
  }

  void read_headed(const HeadedShape& shape) {
    const std::optional<ThreadAxis> t = thread(1);
    Fastener f = fastener(Kind::Screw);
    f.axis = shape.axis;
    f.head = shape.head;
    f.drive = shape.head == Head::Hexagon ? Drive::Hexagon : shape.recess.drive;
    const double measured = 2 * (t ? std::max(t->max_radius, shape.shank_radius) : shape.shank_radius);
    f.diameter = screw_diameter(measured, &shape);
    f.length = shape.head == Head::Countersunk ? shape.total_length : shape.shank_length;
    f.drive_size =
        drive_size(f.drive, f.head, f.drive == Drive::Hexagon ? shape.across_flats : shape.recess.size, f.diameter);
    if (t) set_thread(f, *t);
    const bool fits = f.drive != Drive::Torx || (f.drive_size > 0 && shape.recess.size < 1.2 * f.diameter);
    const bool has_tool = f.drive != Drive::None && shape.head != Head::Other && fits;
    const bool is_standard = thread_size(f.diameter) != nullptr;
    Certainty certainty = Certainty::Possible;
    if (has_tool || (t && shape.head != Head::Other)) certainty = is_standard ? Certainty::Certain : Certainty::Likely;
    add(f, certainty);
    if (certainty == Certainty::Possible) {
      f.kind = Kind::Rivet;
      f.pitch = 0;
      add(f, Certainty::Possible);
    }
  }

  /// A solid of one radius: set screw or pin.
  void read_plain() {
    const double radius = axis_.radius, length = axis_.length();
    const auto same = std::count_if(outers_.begin(), outers_.end(), [&](double r) { return is_near(r, radius, 0.05); });
    const std::optional<ThreadAxis> t = thread(1);
    for (const AxisEnd end : {AxisEnd::End, AxisEnd::Begin}) {
      const DriveRecess recess = drive_recess(mesh_, axis_, sections_, end);
      if (recess.drive == Drive::None || static_cast<double>(same) < 0.6 * kSections) continue;
      Fastener f = fastener(Kind::Screw);
      if (end == AxisEnd::Begin) f.axis = -f.axis;
      f.drive = recess.drive;
      f.diameter = screw_diameter(2 * radius, nullptr);
      f.length = length;
      f.drive_size = drive_size(f.drive, f.head, recess.size, f.diameter);
      if (t) set_thread(f, *t);
      const bool is_standard = thread_size(f.diameter) != nullptr && length <= kLongest * 2 * radius && is_solid();
      const bool is_slotted = f.diameter <= kWidestSlotted && length > kShortestScrew * f.diameter;
      add(f, !is_standard                       ? Certainty::Possible
             : t || f.drive == Drive::HexSocket ? Certainty::Certain
             : is_slotted                       ? Certainty::Likely
                                                : Certainty::Possible);
      return;
    }
    Fastener screw = fastener(Kind::Screw);
    screw.diameter = screw_diameter(2 * radius, nullptr);
    screw.length = length;
    if (t) set_thread(screw, *t);
    const auto round = std::count_if(sections_.begin(), sections_.end(), [&](const AxialSection& s) {
      return s.outer_min() >= 0.985 * radius && s.hole_max() == 0;
    });
    Fastener pin = fastener(Kind::Dowel);
    const double standard = dowel_diameter(2 * radius);
    pin.diameter = standard > 0 ? standard : std::round(200 * radius) / 100;
    pin.length = length;
    const bool is_likely = standard >= kThinnestPin && standard <= kThickestPin && hollow_ == 0 &&
                           static_cast<double>(round) > 0.86 * kSections && is_dowel_length(standard, length) &&
                           length >= kShortestPin * standard && length <= kLongest * standard && !t;
    if (!t) add(pin, is_likely ? Certainty::Likely : Certainty::Possible);
    if (static_cast<double>(same) >= 0.6 * kSections) add(screw, Certainty::Possible);
  }

  /// True if the sections are round, with no hole but a recess in an end.
  bool is_solid() const {
    const auto full = std::count_if(sections_.begin(), sections_.end(), [&](const AxialSection& s) {
      return s.misses() == 0 && s.outer_min() > 0.9 * axis_.radius;
    });
    return hollow_<0.8 * kSections&& static_cast<double>(full)> 0.5 * kSections;
  }

  void read_ring() {
    // Cracks of a mesh may leave a section without a hole.
    std::vector<double> holes = holes_;
    const auto tenth = holes.begin() + static_cast<std::ptrdiff_t>(kSections / 10);
    std::nth_element(holes.begin(), tenth, holes.end());
    const double hole = 2 * *tenth;
    const double outer = 2 * axis_.radius, height = axis_.length();
    if (!(hole > 0)) return;
    if (hexagon_ > 0.6 * outer && read_hexagon_ring(hole, height)) return;
    Fastener washer = fastener(Kind::Washer), nut = fastener(Kind::Nut), insert = fastener(Kind::Insert);
    washer.diameter = washer_for(hole);
    washer.length = height;
    nut.diameter = screw_diameter(hole, nullptr);
    nut.length = height;
    insert.diameter = nut.diameter;
    insert.length = height;
    if (is_washer(washer.diameter, hole, outer, height)) add(washer, Certainty::Likely);
    if (is_knurled() && outer < 2.3 * hole && outer < 25 && is_near(hole, insert_for(hole), 0.2)) {
      insert.diameter = insert_for(hole);
      add(insert, Certainty::Likely);
    }
    add(washer, Certainty::Possible);
    const double wall = (outer - hole) / 2;
    if (height > 0.7 * wall && height < 1.5 * hole && outer > 1.3 * hole && outer < 2.5 * hole)
      add(nut, Certainty::Possible);
    if (outer < 2.3 * hole) add(insert, Certainty::Possible);
  }

  /// A hexagonal ring: nut or standoff.
  bool read_hexagon_ring(double hole, double height) {
    const std::optional<ThreadAxis> t = thread(-1);
    double best = 0, best_off = 1;
    for (const ThreadSize& size : thread_sizes()) {
      if (!is_near(hexagon_, size.hexagon, 0.025) && !is_near(hexagon_, size.hexagon_din, 0.025)) continue;
      if (hole < 0.74 * size.diameter || hole > 1.09 * size.diameter) continue;
      const double off =
          std::min(std::abs(hole / size.diameter - 1), std::abs(hole / (size.diameter - size.pitch) - 1));
      if (off >= best_off) continue;
      best_off = off;
      best = size.diameter;
    }
    Fastener f = fastener(Kind::Nut);
    f.diameter = best > 0 ? best : screw_diameter(t ? 2 * t->max_radius : hole, nullptr);
    f.length = height;
    f.drive = Drive::Hexagon;
    f.drive_size = nominal_width(hexagon_);
    if (t) set_thread(f, *t);
    if (height > 1.7 * f.diameter) f.kind = Kind::Standoff;
    const bool is_thick = hexagon_ < 2.2 * hole && hexagon_ > 1.25 * hole;
    const bool is_standard = (best > 0 || t) && height > 0.25 * f.diameter;
    if (!is_thick && !is_standard) return false;
    add(f, !is_standard ? Certainty::Possible : f.kind == Kind::Nut ? Certainty::Certain : Certainty::Likely);
    return true;
  }

  /// A hexagonal column with a stud at an end.
  bool read_standoff() {
    if (!(hexagon_ > 0.8 * 2 * axis_.radius) || hollow_ == 0) return false;
    const auto is_wide = [&](double r) { return r > 0.9 * axis_.radius; };
    const auto first = std::find_if(outers_.begin(), outers_.end(), is_wide);
    const auto last = std::find_if(outers_.rbegin(), outers_.rend(), is_wide).base();
    const double step = axis_.length() / kSections, body = static_cast<double>(last - first) * step;
    const double stud = *std::min_element(outers_.begin(), outers_.end());
    const bool at_end = outers_.end() - last > first - outers_.begin();
    const bool bore_opposite = at_end ? sections_.front().axis_is_empty() : sections_.back().axis_is_empty();
    if (body < hexagon_ || !bore_opposite || stud > 0.4 * hexagon_) return false;
    Fastener f = fastener(Kind::Standoff);
    f.axis = at_end ? -f.axis : f.axis;
    f.diameter = screw_diameter(2 * *std::max_element(outers_.begin() + (at_end ? last - outers_.begin() + 2 : 2),
                                                      at_end ? outers_.end() - 2 : first - 1),
                                nullptr);
    f.length = body;
    f.drive = Drive::Hexagon;
    f.drive_size = nominal_width(hexagon_);
    add(f, Certainty::Likely);
    return true;
  }

  bool is_washer(double diameter, double hole, double outer, double height) const {
    const bool is_plain = std::all_of(sections_.begin(), sections_.end(), [&](const AxialSection& s) {
      return s.outer_min() > 0.9 * axis_.radius && s.hole_max() < 0.5 * 1.15 * hole && s.hits[0] == 2;
    });
    return is_plain && diameter >= 1.6 && diameter <= kWidestWasher && hole <= 1.13 * diameter &&
           outer >= 1.45 * hole && outer <= 3.3 * hole && height <= 0.3 * diameter && height >= 0.1 * diameter &&
           height <= 0.15 * outer;
  }

  /// True if the outline has many teeth in some sections, and less reach in others.
  bool is_knurled() const {
    std::size_t toothed = 0, narrow = 0;
    for (const AxialSection& s : sections_) {
      narrow += s.outer_max() < 0.975 * axis_.radius;
      const double high = s.outer_max(), low = s.outer_min(), middle = (high + low) / 2;
      if (low > 0.99 * high) continue;
      std::size_t teeth = 0;
      for (std::size_t k = 0; k < kSectionRays; ++k)
        teeth += s.outer[k] < middle && s.outer[(k + 1) % kSectionRays] >= middle;
      toothed += teeth >= kMinTeeth;
    }
    return 8 * toothed > kSections && 20 * narrow > kSections;
  }

  const TriangleMesh& mesh_;
  const FastenerAxis& axis_;
  std::vector<AxialSection> sections_;
  std::size_t hollow_ = 0;              // sections whose axis is empty
  std::vector<double> holes_, outers_;  // smallest hole and largest outer radius of each section [mm]
  double hexagon_ = 0;                  // across flats of the outer hexagon [mm]
  std::vector<FastenerShape> found_;
};

/// A circlip by its ring with a gap.
std::optional<FastenerShape> read_circlip(const TriangleMesh& mesh) {
  const std::optional<RingShape> ring = ring_shape(mesh);
  if (!ring || !is_circlip(*ring)) return std::nullopt;
  Fastener f;
  f.kind = Kind::Circlip;
  f.point = ring->center;
  f.axis = ring->axis;
  f.diameter = circlip_shaft(2 * ring->inner);
  f.length = rounded_length(ring->height);
  return FastenerShape{f, Certainty::Likely};
}

}  // namespace

std::vector<FastenerShape> fastener_shapes(const TriangleMesh& mesh) {
  if (mesh.faces.size() < 20) return {};
  if (const auto circlip = read_circlip(mesh)) return {*circlip};
  std::vector<FastenerShape> found;
  for (const FastenerAxis& axis : fastener_axes(mesh))
    for (FastenerShape& shape : AxisReader(mesh, axis).run()) found.push_back(shape);
  std::stable_sort(found.begin(), found.end(),
                   [](const FastenerShape& a, const FastenerShape& b) { return a.certainty > b.certainty; });
  return found;
}

}  // namespace dismantle
