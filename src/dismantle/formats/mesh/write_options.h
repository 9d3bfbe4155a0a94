// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

/// The two forms of STL.
enum class StlForm { Binary, Ascii };

/// Options of write_assembly.
struct WriteOptions {
  StlForm stl = StlForm::Binary;  ///< The form of .stl files.
};

}  // namespace dismantle
