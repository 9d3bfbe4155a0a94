// SPDX-License-Identifier: Apache-2.0
#include "apps/server/server.h"

#include <utility>

#include "apps/server/connection_acceptor.h"
#include "apps/server/engine_loop.h"
#include "apps/server/export_request.h"
#include "apps/server/file_commands.h"
#include "apps/server/http_connection.h"
#include "apps/server/static_files.h"
#include "dismantle/formats/import/file_formats.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>

#include <atomic>
#include <mutex>
#include <thread>

namespace dismantle::server {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using Tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

namespace {

constexpr std::chrono::seconds kTick{1};
constexpr int kMaxPortTries = 20;
/// Further connections are closed at once; a page has a few.
constexpr long kMaxConnections = 256;
constexpr std::uint64_t kMaxUploadBytes = std::uint64_t{1} << 30, kMaxGuideBytes = std::uint64_t{256} << 20;
/// Disk space of a packed upload and its unpacked files, relative to the size of the upload.
constexpr std::uint64_t kUnpackedFactor = 2;
/// Time limit for closing the sockets when the server stops.
constexpr std::chrono::milliseconds kCloseTimeout{500};

Json job_event(const JobUpdate& update) {
  static constexpr const char* kStatus[] = {"running", "done", "failed", "cancelled"};
  Json json{{"event", "job"},
            {"job", update.job},
            {"name", update.name},
            {"stage", update.stage},
            {"fraction", update.fraction},
            {"seconds", update.seconds},
            {"status", kStatus[static_cast<int>(update.status)]}};
  if (!update.error.empty()) json["error"] = update.error;
  return json;
}

Error cannot_listen(std::uint16_t port, const std::string& why) {
  return {ErrorKind::Failed,
          "the viewer cannot listen on port " + std::to_string(port) + " (" + why + "); give another with --port"};
}

}  // namespace

/// Functions are called on the network's thread unless they say otherwise.
class Server::Impl final : public Site, private EngineListener {
 public:
  Impl(ServerOptions options, Roots roots)
      : pages_(options.web_folder),
        idle_time_(options.idle_time),
        uploads_(options.uploads),
        jobs_([this](const JobUpdate& update) { publish_job(update); }),
        engine_(*this, roots, journal_folder(options), jobs_),
        files_(std::move(roots), std::move(options.model), RecentFiles(options.state_folder), jobs_, uploads_,
               [this](Model model) { on_model(std::move(model)); }),
        hub_(engine_, files_, [this](std::function<void()> work) { asio::post(io_, std::move(work)); }),
        v4_(io_, [this](Tcp::socket socket) { on_socket(std::move(socket)); }),
        v6_(io_, [this](Tcp::socket socket) { on_socket(std::move(socket)); }),
        tick_(io_) {}

  ~Impl() override {
    asio::post(io_, [this] { begin_stop(); });
    if (thread_.joinable()) thread_.join();
    engine_.stop();
    jobs_.stop();
  }

  Result<Done> listen(std::uint16_t port) {
    std::string why = "no free port was found";
    for (int tries = 0; tries < kMaxPortTries; ++tries) {
      ErrorCode error = v4_.listen({asio::ip::address_v4::loopback(), port});
      if (error) return cannot_listen(port, error.message());
      const std::uint16_t chosen = v4_.port();
      error = v6_.listen({asio::ip::address_v6::loopback(), chosen});
      const bool has_v6 =
          error != asio::error::address_family_not_supported && error != boost::system::errc::address_not_available;
      if (error && has_v6) {  // taken on ::1
        if (port != 0) return cannot_listen(port, error.message());
        v4_.close();
        continue;
      }
      rules_.emplace(chosen, random_token());
      return Done{};
    }
    return cannot_listen(port, why);
  }

  void run() {
    Json roots = Json::array();
    for (const std::string& name : files_.roots().names()) roots.push_back(name);
    Json extensions = Json::array();
    for (const FormatEntry& format : file_formats())
      for (const std::string_view extension : format.extensions) extensions.push_back(extension);
    hub_.set_hello({{"event", "hello"},
                    {"version", DISMANTLE_VERSION},
                    {"roots", std::move(roots)},
                    {"extensions", std::move(extensions)}});
    v4_.start();
    if (v6_.is_open()) v6_.start();
    tick();
    thread_ = std::thread([this] { io_.run(); });
  }

  const AccessRules& rules() const override { return *rules_; }
  Hub& hub() override { return hub_; }
  std::chrono::milliseconds idle_time() const override { return idle_time_; }
  FileCommands& files() { return files_; }
  /// Sets the path file that becomes the guide of the first model. @pre nothing was opened before
  void set_first_guide(const fs::path& guide) { first_guide_ = guide; }

  void get(const RequestTarget& target, ResponseCallback respond) override {
    if (target.path == "/api/model.glb") return respond(model_response(target));
    if (target.path == "/api/path.json")
      return send_text(&Workbench::recording_text, "there is no recording (no assembly is open); open one first",
                       respond);
    if (target.path == "/api/guide.json")
      return send_text(&Workbench::guide_text, "there is no guide (no path file is open); open one first", respond);
    if (target.path == "/api/instructions") return send_instructions(std::move(respond));
    if (const std::optional<ExportRequest> request = parse_export(target))
      return export_file(*request, std::move(respond));
    if (target.path.substr(0, 5) == "/api/") return respond(not_found(target.path));
    if (std::optional<HttpResponse> file = pages_.find(target.path)) return respond(std::move(*file));
    respond(not_found(target.path));
  }

  std::variant<Upload, HttpResponse> begin_upload(const RequestTarget& target, const std::string& client,
                                                  std::uint64_t bytes) override {
    const bool is_guide = target.path == "/api/guide", is_packed = target.path == "/api/open_files";
    if (!is_guide && !is_packed && target.path != "/api/open") return not_found(target.path);
    // Until the first page connects, the client in control has no name: a request without one must not pass for it.
    if (client.empty() || !hub_.is_in_control(client))
      return error_response(403, "nothing can be opened (another page is in control); take control first");
    const std::string base = is_packed ? "packed" : name_of(target);
    if (base.empty() || base[0] == '.')
      return error_response(400, "the upload has no name (its extension gives the format); give ?name=FILE");
    if (bytes > (is_guide ? kMaxGuideBytes : kMaxUploadBytes))
      return error_response(413,
                            "the file is too large (for an upload); put it into a folder that the server may read");
    const Result<std::shared_ptr<UploadFolder>> folder =
        uploads_.reserve(client, is_packed ? kUnpackedFactor * bytes : bytes);
    if (!folder) return error_response(507, folder.error().message);
    return Upload{target, client, (*folder)->path() / base, *folder};
  }

  void finish_upload(const Upload& upload, ResponseCallback respond) override {
    if (upload.target.path == "/api/open_files") return open_packed(upload, std::move(respond));
    upload.folder->set_written();
    if (upload.target.path == "/api/guide") return open_guide(upload, std::move(respond));
    respond(job_response(files_.open_upload(upload.file, upload.folder)));
  }

 private:
  /// The file name of the query's `name`; empty if there is none.
  static std::string name_of(const RequestTarget& target) {
    const auto name = target.query.find("name");
    return name == target.query.end() ? "" : fs::path(name->second).filename().string();
  }

  static HttpResponse not_found(const std::string& path) {
    return error_response(404, "there is no " + path + " (no file of the page has this name); see docs/wire.md");
  }

  void on_socket(Tcp::socket socket) {
    if (connections_.use_count() <= kMaxConnections) serve_connection(std::move(socket), *this, connections_);
  }

  void tick() {
    tick_.expires_after(kTick);
    tick_.async_wait([this](ErrorCode error) {
      if (error) return;
      hub_.tick(Hub::Clock::now());
      tick();
    });
  }

  void begin_stop() {
    v4_.close();
    v6_.close();
    hub_.close_all(CloseReason::Stopping);
    tick_.expires_after(kCloseTimeout);
    tick_.async_wait([this](ErrorCode) { io_.stop(); });
  }

  HttpResponse model_response(const RequestTarget& target) const {
    const auto number = target.query.find("model");
    if (!glb_ || (number != target.query.end() && number->second != std::to_string(model_number_)))
      return error_response(404, "there is no such model (another one or none is open); see the event model");
    return {200, "model/gltf-binary", glb_, {}};
  }

  void send_text(std::optional<std::string> (Workbench::*text)() const, const std::string& otherwise,
                 ResponseCallback respond) {
    engine_.post_always([this, text, otherwise, respond = std::move(respond)](Workbench& bench) {
      HttpResponse response = error_response(404, otherwise);
      if (const std::optional<std::string> found = (bench.*text)())
        response = {200, "application/json", std::make_shared<const std::string>(*found), bench.recording_name()};
      asio::post(io_, [respond, response] { respond(response); });
    });
  }

  void send_instructions(ResponseCallback respond) {
    engine_.post_always([this, respond = std::move(respond)](Workbench& bench) {
      HttpResponse response = error_response(
          404,
          "there are no work instructions (none were made of this assembly); make them by the command instructions");
      // The page is never shown from here: it has styles of its own, which the policy of the viewer forbids.
      if (const MadeInstructions* made = bench.instructions())
        response = {200,
                    made->format == ExportFormat::InstructionsPdf ? "application/pdf" : "application/octet-stream",
                    made->bytes,
                    {}};
      asio::post(io_, [respond, response] { respond(response); });
    });
  }

  /// The data is captured on the engine's thread and the file made on another one, so that neither a drag nor the
  /// network waits.
  void export_file(const ExportRequest& request, ResponseCallback respond) {
    engine_.post_always([this, request, respond = std::move(respond)](Workbench& bench) {
      auto source = std::make_shared<const Result<ExportSource>>(export_source(request, bench.model()));
      asio::post(worker_, [this, request, source, respond] {
        HttpResponse response =
            *source ? export_response(request, **source) : error_response(409, source->error().message);
        asio::post(io_, [respond, response] { respond(response); });
      });
    });
  }

  static HttpResponse job_response(const Result<std::uint32_t>& job) {
    return job ? json_response(202, {{"job", *job}}) : error_response(409, job.error().message);
  }

  /// The files are unpacked on another thread: the network must not wait for the disk.
  void open_packed(const Upload& upload, ResponseCallback respond) {
    asio::post(worker_, [this, upload, respond = std::move(respond)] {
      auto file =
          std::make_shared<Result<OpenedFile>>(unpack_upload(upload.file, name_of(upload.target), upload.folder));
      asio::post(io_, [this, file, respond] {
        respond(job_response(*file ? files_.open_unpacked(std::move(**file)) : file->error()));
      });
    });
  }

  void open_guide(const Upload& upload, ResponseCallback respond) {
    engine_.post_always([this, upload, respond = std::move(respond)](Workbench& bench) {
      const Result<Done> opened = bench.open_guide(upload.file, upload.file.filename().string());
      engine_.publish_state();
      HttpResponse response = opened ? json_response(200, Json::object()) : error_response(422, opened.error().message);
      asio::post(io_, [respond, response] { respond(response); });
    });
  }

  static std::optional<fs::path> journal_folder(const ServerOptions& options) {
    if (!options.state_folder) return {};
    return *options.state_folder / "sessions";
  }

  /// On the job's thread. The last event of a job follows what the job changed, which the engine's thread publishes.
  void publish_job(const JobUpdate& update) {
    const bool running = update.status == JobUpdate::Status::Running;
    const bool failed = update.status == JobUpdate::Status::Failed;
    const auto broadcast = [this, job = update.job, text = text_of(job_event(update)), running, failed] {
      asio::post(io_, [this, job, text, running, failed] {
        hub_.broadcast_job(job, text, running);
        // Such as that of the file of the command line, before the page is there.
        if (failed) hub_.keep_if_unheard(std::make_shared<const std::string>(text));
      });
    };
    if (running) return broadcast();
    engine_.post_always([this, broadcast](Workbench&) {
      engine_.publish_state();
      broadcast();
    });
  }

  /// On the job's thread.
  void on_model(Model model) {
    model.number = ++models_;
    asio::post(io_, [this, glb = model.glb, number = model.number] {
      glb_ = glb;
      model_number_ = number;
    });
    engine_.set_model(std::move(model));
    const fs::path guide = std::exchange(first_guide_, {});
    if (guide.empty()) return;
    engine_.post_always([this, guide](Workbench& bench) {
      const Result<Done> opened = bench.open_guide(guide, guide.filename().string());
      if (!opened) bench.warn(opened.error().message);
      engine_.publish_state();
    });
  }

  // On the engine's thread.
  void on_pose(std::string bytes) override {
    const std::lock_guard lock(pose_mutex_);
    const bool is_posted = std::exchange(pose_, std::move(bytes)).has_value();
    if (is_posted) return;
    asio::post(io_, [this] {
      std::unique_lock pose_lock(pose_mutex_);
      std::string newest = std::move(*pose_);
      pose_.reset();
      pose_lock.unlock();
      hub_.broadcast_pose(std::move(newest));
    });
  }
  void on_event(EngineEvent event) override {
    asio::post(io_, [this, event = std::move(event)] { hub_.broadcast_event(event); });
  }

  /// Shared by the open connections: its use count is their number, plus 1.
  std::shared_ptr<const int> connections_ = std::make_shared<const int>(0);
  asio::io_context io_{1};
  StaticFiles pages_;
  const std::chrono::milliseconds idle_time_;
  std::optional<AccessRules> rules_;
  std::mutex pose_mutex_;
  std::optional<std::string> pose_;  ///< The newest, until the network's thread takes it.
  std::atomic<std::uint32_t> models_ = 0;
  fs::path first_guide_;  ///< Guide of the first model; used by the job's thread.
  SharedText glb_;
  std::uint32_t model_number_ = 0;
  UploadStore uploads_;
  Jobs jobs_;
  EngineLoop engine_;
  FileCommands files_;
  Hub hub_;
  asio::thread_pool worker_{1};  ///< Makes exports and unpacks uploads.
  ConnectionAcceptor v4_, v6_;
  asio::steady_timer tick_;
  std::thread thread_;
};

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() = default;

Result<std::unique_ptr<Server>> Server::start(ServerOptions options) {
  Result<Roots> roots = Roots::create(options.roots);
  if (!roots) return roots.error();
  const std::uint16_t port = options.port;
  auto impl = std::make_unique<Impl>(std::move(options), std::move(*roots));
  if (Result<Done> listening = impl->listen(port); !listening) return listening.error();
  impl->run();
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

std::uint16_t Server::port() const {
  return impl_->rules().port();
}

const std::string& Server::token() const {
  return impl_->rules().token();
}

std::string Server::url() const {
  return "http://127.0.0.1:" + std::to_string(port()) + "/#token=" + token();
}

Result<Done> Server::open_file(const fs::path& file) {
  const Result<std::uint32_t> job = impl_->files().open_file(file);
  if (!job) return job.error();
  return Done{};
}

Result<Done> Server::open_guided(const fs::path& file, const fs::path& guide) {
  impl_->set_first_guide(guide);
  return open_file(file);
}

Result<Done> Server::open_sample(const std::string& name) {
  const Result<std::uint32_t> job = impl_->files().open_sample(name);
  if (!job) return job.error();
  return Done{};
}

}  // namespace dismantle::server
