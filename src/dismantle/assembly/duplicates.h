// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/assembly.h"
#include "dismantle/core/span.h"

#include <vector>

namespace dismantle {

/// A component that is identical with another one and in the same place; it was probably placed twice.
struct Duplicate {
  ComponentId component;  ///< The later one.
  ComponentId of;         ///< The first component of this kind in this place.
};

/// The components that are identical with an earlier one and coincide with it within rounding (1e-6 of the assembly's
/// diagonal), ascending.
std::vector<Duplicate> find_duplicates(const Assembly& assembly);

/// Removes components from an assembly; the product tree is left as it is.
void remove_components(Assembly& assembly, Span<const ComponentId> components);

}  // namespace dismantle
