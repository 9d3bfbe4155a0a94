// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace dismantle::server {

/// True if an exception says that there is no memory, or none for a further thread. oneTBB says the latter by a
/// std::runtime_error with the system's text in it.
inline bool is_lack_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return true;
  if (dynamic_cast<const std::length_error*>(&error) != nullptr) return true;
  const std::string text = error.what();
  for (const int number : {EAGAIN, ENOMEM})
    if (text.find(std::strerror(number)) != std::string::npos) return true;
  return false;
}

}  // namespace dismantle::server
