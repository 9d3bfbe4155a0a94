// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/access_rules.h"
#include "apps/server/client_socket.h"
#include "apps/server/hub.h"
#include "apps/server/upload_store.h"
#include "apps/server/url.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace dismantle::server {

/// A response to an HTTP request.
struct HttpResponse {
  unsigned status = 200;     ///< The status code.
  std::string content_type;  ///< The MIME type of the body.
  SharedText body;           ///< Never null when sent.
  std::string file_name;     ///< Name under which browsers save the body; empty: they show it.
};

/// A response with the body {"error": ...}.
HttpResponse error_response(unsigned status, const std::string& error);
/// A response with a JSON body.
HttpResponse json_response(unsigned status, const Json& json);

/// A received upload.
struct Upload {
  RequestTarget target;                  ///< Of the POST request.
  std::string client;                    ///< The header X-Client.
  std::filesystem::path file;            ///< The received body.
  std::shared_ptr<UploadFolder> folder;  ///< Holds the file.
};

/// The server as its connections see it: access rules, clients, and responses to HTTP requests. For the network's
/// thread.
class Site {
 public:
  /// Receives the response to a request.
  using ResponseCallback = std::function<void(HttpResponse)>;

  virtual ~Site() = default;
  /// The access rules of this run.
  virtual const AccessRules& rules() const = 0;
  /// The clients.
  virtual Hub& hub() = 0;
  /// ServerOptions::idle_time.
  virtual std::chrono::milliseconds idle_time() const = 0;
  /// Responds to a GET request, now or later, on the network's thread.
  virtual void get(const RequestTarget& target, ResponseCallback respond) = 0;
  /// Accepts or rejects a POST request before its body is read. @return what receives the body in a file that is to be
  /// created, or the rejection
  /// @param client the header X-Client
  /// @param bytes size of the body
  virtual std::variant<Upload, HttpResponse> begin_upload(const RequestTarget& target, const std::string& client,
                                                          std::uint64_t bytes) = 0;
  /// Processes a complete upload and responds, now or later, on the network's thread.
  virtual void finish_upload(const Upload& upload, ResponseCallback respond) = 0;
};

}  // namespace dismantle::server
