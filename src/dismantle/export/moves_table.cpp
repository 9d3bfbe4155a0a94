// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/moves_table.h"

#include "dismantle/files/csv_text.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// How far a move goes.
struct Way {
  double length = 0;  ///< Of the way of the set's middle [mm].
  double angle = 0;   ///< All turns together [rad].
};

Vec3 middle_of(const Assembly& assembly, const std::vector<ComponentId>& set) {
  Aabb box;
  for (const ComponentId c : set) box.extend(assembled_bounds(assembly[c]));
  return box.empty() ? Vec3{} : box.center();
}

Way way_of(const TimelineMove& move, Vec3 middle) {
  Way way;
  for (std::size_t i = 1; i < move.frames.size(); ++i) {
    const Pose& start = move.frames[i - 1].pose;
    const Screw screw = screw_between(start, move.frames[i].pose);
    const Vec3 place = transform_from_pose(start) * middle;
    // A point's speed does not change along a screw.
    way.length += length(screw.velocity + screw.angle * cross(screw.axis, place - screw.reference));
    way.angle += screw.angle;
  }
  return way;
}

void add_pose(std::vector<std::string>& row, const Pose& p) {
  for (const double value :
       {p.position.x, p.position.y, p.position.z, p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z})
    row.push_back(csv_field(value));
}

std::string header() {
  std::vector<std::string> row{"move",   "label",     "components",      "start_s",  "end_s",
                               "frames", "length_mm", "displacement_mm", "angle_rad"};
  for (const char* end : {"from_", "to_"})
    for (const char* part : {"x_mm", "y_mm", "z_mm", "qw", "qx", "qy", "qz"}) row.push_back(std::string(end) + part);
  row.insert(row.end(), {"least_clearance_mm", "least_clearance_s", "nearest"});
  return csv_row(row);
}

class MovesTable {
 public:
  MovesTable(const Assembly& assembly, const Timeline& timeline, const MovesTableOptions& options)
      : assembly_(assembly),
        timeline_(timeline),
        options_(options),
        is_reversed_(options.direction == PathDirection::Reversed) {}

  std::string row(std::size_t number) const {
    const std::size_t count = timeline_.moves().size();
    const std::size_t index = is_reversed_ ? count - 1 - number : number;
    const TimelineMove& move = timeline_.moves()[index];
    const double start = is_reversed_ ? timeline_.duration() - move.start - move.duration() : move.start;
    const Vec3 middle = middle_of(assembly_, move.components);
    const Way way = way_of(move, middle);
    Pose from = move.frames.front().pose, to = move.frames.back().pose;
    if (is_reversed_) std::swap(from, to);

    std::vector<std::string> names;
    for (const ComponentId c : move.components) names.push_back(assembly_[c].name);
    std::vector<std::string> row{
        csv_field(number + 1),
        csv_field(move.label),
        csv_field(joined(names)),
        csv_field(start),
        csv_field(start + move.duration()),
        csv_field(move.frames.size()),
        csv_field(way.length),
        csv_field(length(transform_from_pose(to) * middle - transform_from_pose(from) * middle)),
        csv_field(way.angle)};
    add_pose(row, from);
    add_pose(row, to);
    add_clearance(row, index, start);
    return csv_row(row);
  }

 private:
  void add_clearance(std::vector<std::string>& row, std::size_t index, double start) const {
    if (options_.clearances.empty() || !options_.clearances[index].neighbour.valid()) {
      row.insert(row.end(), 3, std::string());
      return;
    }
    const MoveClearance& least = options_.clearances[index];
    const double time = is_reversed_ ? timeline_.moves()[index].duration() - least.time : least.time;
    row.insert(row.end(),
               {csv_field(least.distance), csv_field(start + time), csv_field(assembly_[least.neighbour].name)});
  }

  const Assembly& assembly_;
  const Timeline& timeline_;
  const MovesTableOptions& options_;
  bool is_reversed_;
};

}  // namespace

std::optional<std::vector<MoveClearance>> move_clearances(const Assembly& assembly, const PairStates& pairs,
                                                          const Timeline& timeline, const CertificateOptions& options,
                                                          const ProgressCallback& progress) {
  CertificateEngine engine(assembly, pairs, options);
  std::vector<Pose> poses(assembly.components.size());
  std::vector<MoveClearance> all;
  for (const TimelineMove& move : timeline.moves()) {
    MoveClearance least{std::numeric_limits<double>::infinity(), 0, {}};
    for (const Frame& frame : move.frames) {
      const double done = timeline.duration() > 0 ? (move.start + frame.time) / timeline.duration() : 1;
      if (!report_progress(progress, "measuring clearances", done)) return {};
      for (const ComponentId c : move.components) poses[c.value] = frame.pose;
      engine.jump(poses);
      engine.hold(move.components);
      const Clearance now = engine.clearance(least.distance);
      if (now.distance < least.distance) least = {now.distance, frame.time, now.fixed};
      if (!(least.distance > 0)) break;  // no frame is nearer
    }
    for (const ComponentId c : move.components) poses[c.value] = move.frames.back().pose;
    all.push_back(least);
  }
  return all;
}

std::string moves_csv(const Assembly& assembly, const Timeline& timeline, const MovesTableOptions& options) {
  DISMANTLE_EXPECT(options.clearances.empty() || options.clearances.size() == timeline.moves().size());
  const MovesTable table(assembly, timeline, options);
  std::string text = header();
  for (std::size_t i = 0; i < timeline.moves().size(); ++i) text += table.row(i);
  return text;
}

}  // namespace dismantle
