// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/clash.h"

namespace dismantle {

std::string_view name_of(ClashState state) {
  switch (state) {
    case ClashState::Near:
      return "near";
    case ClashState::Contact:
      return "contact";
    case ClashState::Overlapping:
      return "overlapping";
  }
  return "";
}

}  // namespace dismantle
