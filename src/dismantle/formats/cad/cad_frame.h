// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"
#include "dismantle/formats/import/file_formats.h"

#include <string_view>

namespace dismantle {

/// Done if the bytes begin and end as a file of the format does, else an Error that says what is wrong: "<why>; <what
/// to do>". Recognises what files are mistaken for, and files that were cut off.
Result<Done> check_cad_frame(FileFormat format, std::string_view bytes);

}  // namespace dismantle
