// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dismantle/core/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace dismantle::server {

/// How much of the disk uploads may take.
struct UploadLimits {
  std::uint64_t client_bytes = std::uint64_t{4} << 30;      ///< Of one client [bytes].
  std::uint64_t total_bytes = std::uint64_t{8} << 30;       ///< Of all clients [bytes].
  std::uint64_t min_free_bytes = std::uint64_t{256} << 20;  ///< Stays free on the disk [bytes].
};

/// The folder of one upload. Removed with everything in it at the end of this, which also ends its reservation.
class UploadFolder {
 public:
  virtual ~UploadFolder() = default;
  UploadFolder(const UploadFolder&) = delete;
  UploadFolder& operator=(const UploadFolder&) = delete;
  /// Where it is.
  virtual const std::filesystem::path& path() const = 0;
  /// Tells that its files are written: the disk's free space no longer includes what was reserved.
  virtual void set_written() = 0;

 protected:
  UploadFolder() = default;
};

/// Folders for uploads, within a folder of this process in the system's folder for temporary files:
/// "dismantle-uploads-XXXXXX", locked while this or one of the folders lives. Readable by the user alone. For any
/// thread.
class UploadStore {
 public:
  /// Creates nothing yet, but removes what processes that have ended without cleaning up have left there.
  explicit UploadStore(UploadLimits limits = {});

  /// Creates a folder and reserves room for it. Errors: Failed if a limit is reached, the disk is full, or no folder
  /// can be created.
  /// @param client whose limit counts
  /// @param bytes what the files in the folder may take together
  Result<std::shared_ptr<UploadFolder>> reserve(const std::string& client, std::uint64_t bytes);

 private:
  class State;
  class ReservedFolder;
  std::shared_ptr<State> state_;
};

}  // namespace dismantle::server
