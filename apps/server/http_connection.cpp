// SPDX-License-Identifier: Apache-2.0
#include "apps/server/http_connection.h"

#include <utility>

#include "apps/server/file_commands.h"
#include "apps/server/http_headers.h"
#include "apps/server/web_socket.h"

#include <boost/asio/dispatch.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <algorithm>
#include <cctype>
#include <limits>
#include <memory>

namespace dismantle::server {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using ErrorCode = boost::system::error_code;

constexpr std::chrono::seconds kIdle{30};  // for the next request, and between two pieces of one
constexpr std::chrono::minutes kUploadTime{30};
constexpr std::uint32_t kHeaderLimit = 16 * 1024;
constexpr std::size_t kShortestKey = 16, kLongestKey = 64;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

bool is_client_key(std::string_view key) {
  return key.size() >= kShortestKey && key.size() <= kLongestKey &&
         std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isxdigit(c); });
}

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count)
      : stream_(std::move(socket)), site_(site), count_(std::move(count)) {}
  ~HttpConnection() {
    if (!upload_.file.empty()) remove_with_folder(upload_.file);  // it did not come to its end
  }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read() {
    head_.emplace();
    head_->header_limit(kHeaderLimit);
    head_->body_limit(std::numeric_limits<std::uint64_t>::max());  // what its body is for sets the limit: see receive()
    stream_.expires_after(kIdle);
    http::async_read_header(stream_, buffer_, *head_,
                            [self = shared_from_this()](ErrorCode error, std::size_t) { self->on_head(error); });
  }

 private:
  const http::fields& headers() const { return head_->get(); }
  std::string_view header(http::field name) const { return view(headers()[name]); }

  void on_head(ErrorCode error) {
    if (error == http::error::end_of_stream) return end();
    if (error) return;  // it went, or sent no HTTP: nobody to answer
    const std::optional<RequestTarget> target = parse_target(view(head_->get().target()));
    if (std::optional<HttpAnswer> refusal = find_refusal(target)) {
      ++site_.hub().counters().refused;
      return send(*refusal, Keep::No);
    }
    if (target->path == "/session") return upgrade(*target);
    if (head_->get().method() == http::verb::post) return receive(*target);
    if (head_->get().method() != http::verb::get)
      return send(error_answer(405, "this method is not supported (only GET and POST are); use one of these"),
                  Keep::No);
    site_.get(*target, [self = shared_from_this()](const HttpAnswer& answer) { self->send(answer, Keep::Yes); });
  }

  /// The rules of docs/wire.md, "Doors", in their order.
  std::optional<HttpAnswer> find_refusal(const std::optional<RequestTarget>& target) const {
    const AccessRules& rules = site_.rules();
    if (headers().count(http::field::host) != 1 || !rules.is_own_host(header(http::field::host)))
      return error_answer(421,
                          "the Host header is wrong (it is none of this server's names); use the URL that it printed");
    if (!target)
      return error_answer(400, "the request was not understood (its target is malformed); correct the client");
    const bool is_socket = target->path == "/session", is_api = target->path.substr(0, 5) == "/api/";
    if (!is_socket && !is_api) return {};

    const auto origins = headers().count(http::field::origin);
    const bool own_origin = origins == 1 && rules.is_own_origin(header(http::field::origin));
    if (is_socket ? !own_origin : origins != 0 && !own_origin)
      return error_answer(
          403, "the Origin header is wrong (requests from other sites are refused); use the URL that it printed");
    const bool token = is_socket ? rules.offers_token(header(http::field::sec_websocket_protocol))
                                 : rules.is_authorized(header(http::field::authorization));
    if (!token)
      return error_answer(
          401, "the token is missing or wrong (every run has a new one); use the URL that the server printed");
    return {};
  }

  void upgrade(const RequestTarget& target) {
    const auto key = target.query.find("client");
    if (!beast::websocket::is_upgrade(head_->get()) || key == target.query.end() || !is_client_key(key->second))
      return send(
          error_answer(400,
                       "this is not a WebSocket request (an upgrade with client=HEX is required); correct the client"),
          Keep::No);
    http::request<http::string_body> request;
    static_cast<http::request_header<>&>(request) = head_->get();
    serve_socket(std::move(stream_), request, {key->second, std::move(count_)}, site_);
  }

  void receive(const RequestTarget& target) {
    const std::string client(view(headers()["X-Client"]));
    auto place = site_.begin_upload(target, client);
    if (auto* refusal = std::get_if<HttpAnswer>(&place)) return send(*refusal, Keep::No);
    upload_ = {target, client, std::get<Site::UploadPlace>(place).file};
    body_.emplace(std::move(*head_));
    const std::uint64_t limit = std::get<Site::UploadPlace>(place).limit;
    if (body_->content_length().value_or(0) > limit) return refuse_size();
    body_->body_limit(limit);
    ErrorCode error;
    body_->get().body().open(upload_.file.c_str(), beast::file_mode::write, error);
    if (error)
      return send(error_answer(500, "the upload cannot be stored (" + error.message() + "); free some space"),
                  Keep::No);
    stream_.expires_after(kUploadTime);
    http::async_read(stream_, buffer_, *body_,
                     [self = shared_from_this()](ErrorCode e, std::size_t) { self->on_body(e); });
  }

  void on_body(ErrorCode error) {
    body_->get().body().close();
    if (error) {
      if (error == http::error::body_limit) refuse_size();
      return;
    }
    Upload whole;
    std::swap(whole, upload_);
    site_.finish_upload(whole, [self = shared_from_this()](const HttpAnswer& answer) { self->send(answer, Keep::No); });
  }

  void refuse_size() {
    send(error_answer(413, "the file is too large (for an upload); put it into a folder that the server may read"),
         Keep::No);
  }

  enum class Keep { Yes, No };

  void send(const HttpAnswer& answer, Keep keep) {
    body_kept_ = answer.body;
    auto response = std::make_shared<http::response<http::span_body<const char>>>();
    response->version(11);
    response->result(answer.status);
    response->set(http::field::content_type, answer.content_type);
    response->set(http::field::cache_control, "no-store");
    if (!answer.file_name.empty())
      response->set(http::field::content_disposition, "attachment; filename=\"" + answer.file_name + "\"");
    add_safety_headers(response->base());
    response->body() = {body_kept_->data(), body_kept_->size()};
    response->keep_alive(keep == Keep::Yes && head_->is_done() && head_->get().keep_alive());
    response->prepare_payload();
    stream_.expires_after(kIdle);
    http::async_write(stream_, *response, [self = shared_from_this(), response](ErrorCode error, std::size_t) {
      if (error) return;
      response->need_eof() ? self->end() : self->read();
    });
  }

  void end() {
    ErrorCode ignored;
    stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  }

  beast::tcp_stream stream_;
  Site& site_;
  std::shared_ptr<const void> count_;
  beast::flat_buffer buffer_{kHeaderLimit + 64 * 1024};
  std::optional<http::request_parser<http::empty_body>> head_;
  std::optional<http::request_parser<http::file_body>> body_;
  Upload upload_;
  SharedText body_kept_;  // of the answer that is being sent
};

}  // namespace

HttpAnswer json_answer(unsigned status, const Json& json) {
  return {status, "application/json", std::make_shared<const std::string>(text_of(json)), {}};
}

HttpAnswer error_answer(unsigned status, const std::string& error) {
  return json_answer(status, {{"error", error}});
}

void serve_connection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count) {
  std::make_shared<HttpConnection>(std::move(socket), site, std::move(count))->read();
}

}  // namespace dismantle::server
