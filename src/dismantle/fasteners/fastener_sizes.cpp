// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/fastener_sizes.h"

#include "dismantle/fasteners/standard_sizes.h"

#include <algorithm>
#include <cmath>

namespace dismantle {

namespace {

using Drive = Fastener::Drive;
using Head = Fastener::Head;

/// Diameters are nominal within this share.
constexpr double kNominal = 0.03;

}  // namespace

bool is_near(double a, double b, double share) {
  return b > 0 && std::abs(a - b) <= share * b;
}

double rounded_length(double length) {
  const double half = std::round(2 * length) / 2;
  return std::abs(half - length) <= std::min(0.01 * length, 0.06) ? half : std::round(100 * length) / 100;
}

double screw_diameter(double measured, const HeadedShape* shape) {
  double best = 0, best_score = 0.4;
  for (const ThreadSize& size : thread_sizes()) {
    double score = 0;
    if (is_near(measured, size.diameter, kNominal))
      score = 2 - std::abs(measured / size.diameter - 1);
    else if (measured < size.diameter && measured > size.diameter - 1.3 * size.pitch)
      score = 0.5;
    else
      continue;
    if (shape != nullptr) {
      const double head = 2 * shape->head_radius, key = shape->recess.size;
      if (is_near(shape->across_flats, size.hexagon, 0.03) || is_near(shape->across_flats, size.hexagon_din, 0.03))
        score += 1;
      if (shape->recess.drive == Drive::HexSocket) {
        if (is_near(head, size.cylinder_head, 0.05) && is_near(key, size.cylinder_key, 0.08)) score += 1;
        if (is_near(head, size.button_head, 0.06) && is_near(key, size.button_key, 0.08)) score += 1;
      }
      if (shape->recess.drive == Drive::Cross && is_near(head, size.pan_head, 0.06)) score += 0.5;
    }
    if (score > best_score) {
      best_score = score;
      best = size.diameter;
    }
  }
  if (best > 0) return best;
  const double tenth = std::round(10 * measured) / 10;
  return is_near(measured, tenth, 0.02) ? tenth : std::round(100 * measured) / 100;
}

double drive_size(Drive drive, Head head, double measured, double diameter) {
  const ThreadSize* size = thread_size(diameter);
  switch (drive) {
    case Drive::Hexagon:
      return nominal_width(measured);
    case Drive::HexSocket:
      // Sockets are drawn a little wider than the key.
      if (size != nullptr && head == Head::Cylinder && is_near(measured, size->cylinder_key, 0.09))
        return size->cylinder_key;
      return nominal_width(measured);
    case Drive::Cross:
      return size != nullptr ? size->cross : 0;
    case Drive::Torx:
      return torx_number(measured);
    default:
      return 0;
  }
}

double washer_for(double hole) {
  double best = 0;
  for (const ThreadSize& size : thread_sizes())
    if (hole >= 0.995 * size.diameter) best = size.diameter;
  return best;
}

double insert_for(double hole) {
  double best = 0, off = 1;
  for (const ThreadSize& size : thread_sizes())
    // Inserts are made for sizes that have set screws.
    for (const double drawn : {size.diameter, size.diameter - size.pitch})
      if (size.set_screw_key > 0 && std::abs(hole / drawn - 1) < off) {
        off = std::abs(hole / drawn - 1);
        best = size.diameter;
      }
  return best;
}

}  // namespace dismantle
