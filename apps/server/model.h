// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/assembly/clash.h"
#include "dismantle/session/session.h"

#include <cstdint>
#include <memory>
#include <string>

namespace dismantle::server {

/// An assembly that is open in the viewer.
struct Model {
  std::uint32_t number = 0;                  ///< Counts up within a run of the server.
  std::string name;                          ///< For users: display_name() of the file.
  std::string product;                       ///< For titles: product_name() of the file.
  std::shared_ptr<const Assembly> assembly;  ///< Never null once loaded.
  std::shared_ptr<const std::string> glb;    ///< The assembly in assembled position as binary glTF.
  Clashes clashes;                           ///< Of the assembly: the reply to `check`.
  std::unique_ptr<Session> session;          ///< Of the assembly; never null once loaded.
};

}  // namespace dismantle::server
