// SPDX-License-Identifier: Apache-2.0
#include "dismantle/export/moves_table.h"

#include "dismantle/files/csv_text.h"
#include "dismantle/math/screw.h"

#include <algorithm>
#include <limits>

namespace dismantle {

namespace {

/// Extent of a move.
struct Travel {
  double length = 0;  ///< Path length of the centre of the moving set [mm].
  double angle = 0;   ///< Total rotation [rad].
};

/// Centre of a set in the assembled state [mm].
Vec3 center_of(const Assembly& assembly, const std::vector<ComponentId>& set) {
  Aabb box;
  for (const ComponentId c : set) box.extend(assembled_bounds(assembly[c]));
  return box.empty() ? Vec3{} : box.center();
}

Travel travel_of(const TimelineMove& move, Vec3 center) {
  Travel travel;
  for (std::size_t i = 1; i < move.frames.size(); ++i) {
    const Pose& start = move.frames[i - 1].pose;
    const Screw screw = screw_between(start, move.frames[i].pose);
    const Vec3 point = transform_from_pose(start) * center;
    // The speed of a point is constant along a screw motion.
    travel.length += length(screw.velocity + screw.angle * cross(screw.axis, point - screw.reference));
    travel.angle += screw.angle;
  }
  return travel;
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

/// Writes the rows of the table.
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
    const Vec3 center = center_of(assembly_, move.components);
    const Travel travel = travel_of(move, center);
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
        csv_field(travel.length),
        csv_field(length(transform_from_pose(to) * center - transform_from_pose(from) * center)),
        csv_field(travel.angle)};
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
    const MoveClearance& minimum = options_.clearances[index];
    const double time = is_reversed_ ? timeline_.moves()[index].duration() - minimum.time : minimum.time;
    row.insert(row.end(),
               {csv_field(minimum.distance), csv_field(start + time), csv_field(assembly_[minimum.neighbour].name)});
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
    MoveClearance minimum{std::numeric_limits<double>::infinity(), 0, {}};
    for (const Frame& frame : move.frames) {
      const double done = timeline.duration() > 0 ? (move.start + frame.time) / timeline.duration() : 1;
      if (!report_progress(progress, "measuring clearances", done)) return {};
      for (const ComponentId c : move.components) poses[c.value] = frame.pose;
      engine.jump(poses);
      engine.grab(move.components);
      const Clearance now = engine.clearance(minimum.distance);
      if (now.distance < minimum.distance) minimum = {now.distance, frame.time, now.fixed};
      if (!(minimum.distance > 0)) break;  // no frame can be closer
    }
    for (const ComponentId c : move.components) poses[c.value] = move.frames.back().pose;
    all.push_back(minimum);
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
