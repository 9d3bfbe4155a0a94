// SPDX-License-Identifier: Apache-2.0
#include "dismantle/assembly/path.h"

namespace dismantle {

std::string_view name_of(ResponseKind response) {
  switch (response) {
    case ResponseKind::Stop:
      return "stop";
    case ResponseKind::Touch:
      return "touch";
    case ResponseKind::Slide:
      return "slide";
  }
  return "";
}

}  // namespace dismantle
