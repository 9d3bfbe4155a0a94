// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/export/offline_page.h"

namespace dismantle::server {

/// The files of the viewer's page that is in the program, for pages that are to do without it.
ViewerFiles viewer_files();

}  // namespace dismantle::server
