// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/pango_text.h"

namespace dismantle {

std::string valid_utf8(const std::string& text) {
  gchar* made = g_utf8_make_valid(text.data(), static_cast<gssize>(text.size()));
  std::string valid(made);
  g_free(made);
  return valid;
}

}  // namespace dismantle
