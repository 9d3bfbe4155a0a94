// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"

namespace dismantle {

/// An estimate of Assembly::deflection for meshes, whose files do not say how far their facets are from the surfaces
/// that they stand for: from the angles between neighbouring facets and their widths. For tessellations by a CAD kernel
/// it is the deflection that the kernel was asked for, to a few percent; coarse curves that could as well be edges do
/// not count. At most what CAD files are tessellated with by default (kDefaultRelativeDeflection); 0 without curved
/// surfaces. [mm]
double estimated_deflection(const Assembly& assembly);

}  // namespace dismantle
