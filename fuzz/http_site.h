// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/server/http_connection.h"
#include "apps/server/static_files.h"
#include "fuzz/fuzz_input.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <future>
#include <memory>
#include <string>
#include <utility>

namespace dismantle::fuzz {

// Constants that inputs of the corpus contain.
inline constexpr std::uint16_t kPort = 1234;
inline const std::string kToken = "0123456789abcdef0123456789abcdef";
/// A client that is connected before the input comes, and in control.
inline const std::string kController = "ffeeddccbbaa99887766554433221100";
/// In every answer for which the token is needed, and in files that are outside the page's folder.
inline const std::string kSecret = "only with the token";
/// Uploads may take little, so that inputs reach the limit [bytes].
inline constexpr std::uint64_t kClientUploads = 20'000, kAllUploads = 30'000;

/// A server without listening sockets and without a model: the connections, the hub, the uploads and the page's files
/// are those of the viewer; what /api answers is made up.
class HttpSite final : public server::Site, private server::ServerCommands, private server::EngineListener {
 public:
  /// @param page the folder with the page's files
  explicit HttpSite(const std::filesystem::path& page)
      : pages_(page),
        uploads_({kClientUploads, kAllUploads, 1}),
        jobs_([](const server::JobUpdate&) {}),
        engine_(*this, *server::Roots::create({}), std::nullopt, jobs_),
        hub_(engine_, *this, [this](std::function<void()> work) { boost::asio::post(io_, std::move(work)); }) {
    hub_.set_hello({{"event", "hello"}});
    hub_.connect(kController, other_client_);
  }
  ~HttpSite() override {
    engine_.stop();
    hub_.disconnect(kController, other_client_);
  }

  boost::asio::io_context& io() { return io_; }
  /// Waits until the engine has done all that it was asked for.
  void wait_for_engine() {
    std::promise<void> done;
    engine_.post_always([&done](server::Workbench&) { done.set_value(); });
    done.get_future().wait();
  }

  const server::AccessRules& rules() const override { return rules_; }
  server::Hub& hub() override { return hub_; }
  std::chrono::milliseconds idle_time() const override { return std::chrono::seconds(20); }

  void get(const server::RequestTarget& target, ResponseCallback respond) override {
    if (!target.path.starts_with("/api/"))
      return respond(pages_.find(target.path).value_or(server::error_response(404, "there is no such file; none")));
    server::HttpResponse response = server::json_response(200, {{"secret", kSecret}});
    const auto name = target.query.find("name");
    if (name != target.query.end()) response.file_name = name->second;
    if (target.path == "/api/model.glb") return respond(response);  // the others wait for the engine
    boost::asio::post(io_, [respond = std::move(respond), response = std::move(response)] { respond(response); });
  }

  std::variant<server::Upload, server::HttpResponse> begin_upload(const server::RequestTarget& target,
                                                                  const std::string& client,
                                                                  std::uint64_t bytes) override {
    if (!target.path.starts_with("/api/")) return server::error_response(404, "there is no such file; none");
    if (client.empty() || !hub_.is_in_control(client)) return server::error_response(403, "not in control; take it");
    const auto folder = uploads_.reserve(client, bytes);
    if (!folder) return server::error_response(507, folder.error().message);
    return server::Upload{target, client, (*folder)->path() / "upload", *folder};
  }

  void finish_upload(const server::Upload& upload, ResponseCallback respond) override {
    const std::uint64_t bytes = std::filesystem::file_size(upload.file);
    require(bytes <= kClientUploads, "an upload within the limit");
    boost::asio::post(io_, [respond = std::move(respond), bytes, folder = upload.folder] {
      respond(server::json_response(202, {{"secret", kSecret}, {"bytes", bytes}}));
    });
  }

 private:
  /// The socket of kController.
  struct DeafSocket final : server::ClientSocket {
    void send_text(server::SharedText) override {}
    void send_pose(server::SharedText) override {}
    void close(server::CloseReason) override {}
  };

  // Commands: `broadcast` sends each kind of message that the engine and jobs send.
  bool knows(std::string_view command) const override { return command == "broadcast" || command == "fail"; }
  bool needs_control(std::string_view command) const override { return command == "broadcast"; }
  Result<server::Json> execute(const server::Json& command) override {
    if (command["command"] == "fail") return Error{ErrorKind::Usage, "it failed (as it must); do not ask"};
    hub_.broadcast_pose(server::encode(server::PoseMessage{}));
    hub_.broadcast_pose(server::encode(server::PoseMessage{}));
    hub_.broadcast_job(1, server::text_of({{"event", "job"}}), true);
    hub_.broadcast_event({server::EngineEvent::Kind::Model, false, server::text_of({{"event", "model"}})});
    return server::Json{{"text", std::string(20'000, 'x')}};
  }

  void on_pose(std::string bytes) override {
    boost::asio::post(io_, [this, bytes = std::move(bytes)] { hub_.broadcast_pose(bytes); });
  }
  void on_event(server::EngineEvent event) override {
    boost::asio::post(io_, [this, event = std::move(event)] { hub_.broadcast_event(event); });
  }

  boost::asio::io_context io_{1};
  const server::AccessRules rules_{kPort, kToken};
  server::StaticFiles pages_;
  server::UploadStore uploads_;
  server::Jobs jobs_;
  server::EngineLoop engine_;
  server::Hub hub_;
  DeafSocket other_client_;
};

}  // namespace dismantle::fuzz
