// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/offline_page.h"

namespace dismantle::server {

/// The files of the embedded viewer page that an exported page contains.
ViewerFiles viewer_files();

}  // namespace dismantle::server
