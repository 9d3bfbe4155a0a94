// SPDX-License-Identifier: Apache-2.0
#include "dismantle/fasteners/find_fasteners.h"

#include "dismantle/fasteners/fastener_names.h"
#include "dismantle/fasteners/fastener_shape.h"
#include "dismantle/fasteners/standard_sizes.h"
#include "dismantle/features/revolution_axes.h"
#include "dismantle/math/angle.h"
#include "dismantle/proposals/shape_kinds.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace dismantle {

namespace {

using Certainty = FastenerShape::Certainty;
using Drive = Fastener::Drive;
using Head = Fastener::Head;
using Kind = Fastener::Kind;

/// A size in a name counts if the shape's is unknown or not further from it than this share: models of threads are
/// drawn at the root diameter, lengths with and without the head.
constexpr double kNamedSize = 0.3;
/// Axes within this share of a mesh's diagonal of its middle pass through it.
constexpr double kThroughMiddle = 0.1;
/// The thickness of a nut or a washer by its name alone is at most this share of its width, its length at most this
/// many widths.
constexpr double kFlat = 0.6, kSquare = 1.6;

/// Takes what the name says more exactly than the shape.
void add_name(Fastener& f, const FastenerName& name) {
  const auto agrees = [](double named, double found) {
    return named > 0 && (!(found > 0) || std::abs(named - found) <= kNamedSize * found);
  };
  if (name.kind && *name.kind != f.kind) return;
  if (agrees(name.diameter, f.diameter) && f.diameter != name.diameter) {
    f.diameter = name.diameter;
    if (const ThreadSize* size = thread_size(f.diameter); size != nullptr && !f.thread_is_modelled && f.pitch > 0)
      f.pitch = size->pitch;
  }
  if (agrees(name.length, f.length)) f.length = name.length;
  if (f.kind != Kind::Screw) return;
  if (f.drive == Drive::None) f.drive = name.drive;
  if (f.head == Head::Other && name.head != Head::None) f.head = name.head;
  const ThreadSize* size = thread_size(f.diameter);
  if (size == nullptr || f.drive_size > 0) return;
  if (f.drive == Drive::Hexagon) f.drive_size = size->hexagon;
  if (f.drive == Drive::Cross) f.drive_size = size->cross;
  if (f.drive == Drive::HexSocket)
    f.drive_size = f.head == Head::Cylinder ? size->cylinder_key
                   : f.head == Head::None   ? size->set_screw_key
                                            : size->button_key;
}

/// A fastener by its name alone: what is round about an axis through its middle, or flat in the case of nuts and
/// washers.
std::optional<Fastener> named_only(const TriangleMesh& mesh, const FastenerName& name) {
  if (name.is_other || !name.kind || mesh.faces.empty()) return std::nullopt;
  Fastener f;
  f.kind = *name.kind;
  f.head = f.kind == Kind::Screw ? Head::Other : Head::None;
  f.drive = name.drive;
  f.diameter = name.diameter;
  f.length = name.length;
  f.by_name_only = true;
  if (const ThreadSize* size = thread_size(f.diameter); size != nullptr && f.kind != Kind::Washer)
    f.pitch = size->pitch;
  const Aabb box = bounds(mesh);
  f.point = box.center();
  if (f.kind == Kind::Nut || f.kind == Kind::Washer) {
    const Vec3 lengths = principal_lengths(mesh);
    if (lengths.x > kFlat * lengths.y || lengths.z > kSquare * lengths.y) return std::nullopt;
    const Vec3 size = box.size();
    f.axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0} : size.y <= size.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return f;
  }
  for (const RevolutionAxis& axis : revolution_axes(mesh.vertices, mesh.faces)) {
    if (axis.turn < 0.9 * kTurn) break;
    if (length(axis.point - box.center()) > kThroughMiddle * diagonal(box)) continue;
    f.point = axis.point;
    f.axis = axis.direction;
    return f;
  }
  return std::nullopt;
}

/// Number of characters that all names begin with, up to the end of a word: the name of their assembly. None of fewer
/// than three names.
std::size_t common_beginning(const Assembly& assembly) {
  if (assembly.components.size() < 3) return 0;
  std::string common = assembly.components.front().name;
  for (const Component& c : assembly.components) {
    const auto [end, other] = std::mismatch(common.begin(), common.end(), c.name.begin(), c.name.end());
    common.erase(end, common.end());
  }
  const std::size_t end = common.find_last_of(" _-.:/");
  return end == std::string::npos ? 0 : end + 1;
}

std::optional<Fastener> judged(const std::vector<FastenerShape>& shapes, const FastenerName& name) {
  const bool is_named_size = name.diameter > 0 && name.length > 0;
  // The kind in the name, if the shape admits it.
  if (name.kind && (!name.is_other || is_named_size))
    for (const FastenerShape& shape : shapes) {
      if (shape.fastener.kind != *name.kind) continue;
      // A plain cylinder is a screw only if the name has its size: lead screws, screw shafts.
      const bool is_plain = shape.certainty == Certainty::Possible && shape.fastener.kind == Kind::Screw &&
                            shape.fastener.head == Head::None;
      if (is_plain && !is_named_size) continue;
      Fastener f = shape.fastener;
      add_name(f, name);
      f.by_name_only = shape.certainty == Certainty::Possible;
      return f;
    }
  for (const FastenerShape& shape : shapes) {
    if (shape.certainty == Certainty::Possible) continue;
    if (shape.certainty == Certainty::Likely && name.is_other) continue;
    Fastener f = shape.fastener;
    add_name(f, name);
    return f;
  }
  // "M5x16" says enough of what has a head.
  if (!name.kind && !name.is_other && is_named_size)
    for (const FastenerShape& shape : shapes)
      if (shape.fastener.kind == Kind::Screw && shape.fastener.head != Head::None) {
        Fastener f = shape.fastener;
        add_name(f, name);
        f.by_name_only = true;
        return f;
      }
  return std::nullopt;
}

/// The shapes that the meshes may be, in the frames of the meshes.
using MeshShapes = std::unordered_map<const TriangleMesh*, std::vector<FastenerShape>>;

MeshShapes shapes_of(const Assembly& assembly, const Executor& executor) {
  MeshShapes shapes;
  std::vector<MeshShapes::value_type*> meshes;
  for (const Component& component : assembly.components)
    if (const auto [at, is_new] = shapes.try_emplace(component.mesh.get()); is_new) meshes.push_back(&*at);
  executor.for_each_heavy(meshes.size(),
                          [&](std::size_t i) { meshes[i]->second = fastener_shapes(*meshes[i]->first); });
  return shapes;
}

auto order_of(const Fastener& f) {
  // The thickness of nuts and washers, and the height of circlips, are no part of their designation.
  const bool has_length = f.kind != Kind::Nut && f.kind != Kind::Washer && f.kind != Kind::Circlip;
  return std::make_tuple(f.kind, f.head, f.drive, f.diameter, has_length ? f.length : 0, f.drive_size);
}

}  // namespace

std::vector<std::optional<Fastener>> find_fasteners(const Assembly& assembly, const Executor& executor,
                                                    FastenerEvidence evidence) {
  const std::size_t common = common_beginning(assembly);
  const MeshShapes shapes = shapes_of(assembly, executor);
  std::vector<std::optional<Fastener>> found;
  found.reserve(assembly.components.size());
  for (const Component& component : assembly.components) {
    const std::vector<FastenerShape>& own = shapes.at(component.mesh.get());
    const FastenerName name =
        evidence == FastenerEvidence::ShapeAndName
            ? read_fastener_name(std::string_view(component.name).substr(std::min(common, component.name.size())))
            : FastenerName{};
    std::optional<Fastener> fastener = judged(own, name);
    if (!fastener && own.empty()) fastener = named_only(*component.mesh, name);
    found.push_back(fastener);
  }
  return found;
}

std::vector<CountedFastener> counted_fasteners(const std::vector<std::optional<Fastener>>& fasteners) {
  std::vector<CountedFastener> counted;
  for (std::uint32_t c = 0; c < fasteners.size(); ++c) {
    if (!fasteners[c]) continue;
    const auto same = std::find_if(counted.begin(), counted.end(), [&](const CountedFastener& other) {
      return order_of(other.fastener) == order_of(*fasteners[c]);
    });
    if (same == counted.end())
      counted.push_back({*fasteners[c], {ComponentId(c)}});
    else
      same->components.emplace_back(c);
  }
  std::stable_sort(counted.begin(), counted.end(), [](const CountedFastener& a, const CountedFastener& b) {
    return order_of(a.fastener) < order_of(b.fastener);
  });
  return counted;
}

}  // namespace dismantle
