// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/cad/brep_shape.h"

#include "dismantle/formats/cad/text_buffer.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <istream>

namespace dismantle {

TopoDS_Shape read_brep_shape(std::string_view bytes, const ProgressCallback& progress) {
  constexpr std::string_view kBinary = "Open CASCADE Topology V";
  TextBuffer buffer(bytes, progress);
  std::istream stream(&buffer);
  stream.exceptions(std::ios::failbit | std::ios::badbit);  // else it counts on where a file ends
  TopoDS_Shape shape;
  try {
    if (bytes.substr(0, 64).find(kBinary) != std::string_view::npos) {
      BinTools::Read(shape, stream);
    } else {
      BRepTools::Read(shape, stream, BRep_Builder());
    }
  } catch (const std::ios::failure&) {
    return {};
  }
  return shape;
}

}  // namespace dismantle
