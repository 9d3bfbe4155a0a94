// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/access_rules.h"
#include "apps/server/client_socket.h"
#include "apps/server/hub.h"
#include "apps/server/url.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace dismantle::server {

/// The response to a request.
struct HttpAnswer {
  unsigned status = 200;
  std::string content_type;
  SharedText body;
  std::string file_name;  ///< Where it is to be saved as a file: its name.
};

/// An answer with a body {"error": ...}.
HttpAnswer error_answer(unsigned status, const std::string& error);
HttpAnswer json_answer(unsigned status, const Json& json);

/// The purpose of an upload and its file.
struct Upload {
  RequestTarget target;
  std::string client;          ///< Of the header X-Client.
  std::filesystem::path file;  ///< Removed by who takes it.
};

/// The resources that the server offers to requests, independent of the transport. Called on the network's thread.
class Site {
 public:
  using Reply = std::function<void(HttpAnswer)>;

  virtual ~Site() = default;
  virtual const AccessRules& rules() const = 0;
  virtual Hub& hub() = 0;
  /// ServerOptions::idle_time.
  virtual std::chrono::milliseconds idle_time() const = 0;
  /// Answers GET, now or later on the same thread.
  virtual void get(const RequestTarget& target, Reply reply) = 0;
  /// Where the body of a POST of at most how many bytes goes; or why it is refused.
  struct UploadPlace {
    std::filesystem::path file;
    std::uint64_t limit = 0;
  };
  virtual std::variant<UploadPlace, HttpAnswer> begin_upload(const RequestTarget& target,
                                                             const std::string& client) = 0;
  virtual void finish_upload(const Upload& upload, Reply reply) = 0;
};

}  // namespace dismantle::server
