// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/id.h"
#include "dismantle/core/span.h"

#include <optional>
#include <vector>

namespace dismantle {

/// Which components are drawn. What is hidden still stands where it is and stops others.
class Visibility {
 public:
  explicit Visibility(std::size_t component_count) : hidden_(component_count, false) {}

  bool is_hidden(ComponentId c) const { return hidden_[c.value]; }
  /// Whether restore() has something to go back to.
  bool is_isolated() const { return before_.has_value(); }

  void hide(Span<const ComponentId> components) { set(components, true); }
  void show(Span<const ComponentId> components) { set(components, false); }
  /// Hides all others and shows these. What was hidden before the first of several comes back by restore().
  void isolate(Span<const ComponentId> components) {
    if (!before_) before_ = hidden_;
    hidden_.assign(hidden_.size(), true);
    set(components, false);
  }
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
