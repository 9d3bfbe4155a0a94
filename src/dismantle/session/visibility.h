// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Which components are drawn. Hidden components keep their poses and still block others.
class Visibility {
 public:
  /// Everything visible.
  explicit Visibility(std::size_t component_count) : hidden_(component_count, false) {}

  /// True if the component is hidden.
  bool is_hidden(ComponentId c) const { return hidden_[c.value]; }
  /// True if components are isolated, so that restore() has an effect.
  bool is_isolated() const { return before_.has_value(); }

  /// Hides components.
  void hide(Span<const ComponentId> components) { set(components, true); }
  /// Shows components.
  void show(Span<const ComponentId> components) { set(components, false); }
  /// Hides all others and shows these. The visibility from before the first of several calls is kept for restore().
  void isolate(Span<const ComponentId> components) {
    if (!before_) before_ = hidden_;
    hidden_.assign(hidden_.size(), true);
    set(components, false);
  }
  /// Ends the isolation.
  void restore() {
    if (before_) hidden_ = *before_;
    before_.reset();
  }

 private:
  void set(Span<const ComponentId> components, bool hidden) {
    for (const ComponentId c : components) hidden_[c.value] = hidden;
  }

  std::vector<bool> hidden_;
  std::optional<std::vector<bool>> before_;
};

}  // namespace dismantle
