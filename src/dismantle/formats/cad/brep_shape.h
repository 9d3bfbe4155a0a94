// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/progress.h"

#include <TopoDS_Shape.hxx>
#include <string_view>

namespace dismantle {

/// The shape of a BREP file, text or binary; null if it cannot be
/// read. Throws OpenCASCADE's exceptions.
TopoDS_Shape read_brep_shape(std::string_view bytes, const ProgressCallback& progress);

}  // namespace dismantle
