// SPDX-License-Identifier: Apache-2.0
#include "apps/server/http_connection.h"

#include <utility>

#include "apps/server/http_headers.h"
#include "apps/server/web_socket.h"

#include <boost/asio/dispatch.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <limits>
#include <memory>

namespace dismantle::server {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using ErrorCode = boost::system::error_code;

constexpr std::chrono::seconds kIdleTimeout{30};  // until the next request, or the next part of one
constexpr std::chrono::seconds kCloseTimeout{2};
constexpr std::size_t kDiscardBytes = 64 * 1024;
constexpr std::uint32_t kMaxHeaderBytes = 16 * 1024;
constexpr std::size_t kMinKeyLength = 16, kMaxKeyLength = 64;

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

bool is_client_key(std::string_view key) {
  return key.size() >= kMinKeyLength && key.size() <= kMaxKeyLength &&
         std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isxdigit(c); });
}

/// True for errors of writing a file; others are those of a connection.
bool is_of_disk(const ErrorCode& error) {
  return error == boost::system::errc::no_space_on_device || error == boost::system::errc::file_too_large ||
         error == boost::system::errc::io_error || error.value() == EDQUOT;
}

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count)
      : stream_(std::move(socket)), site_(site), count_(std::move(count)) {}
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read_request() {
    header_.emplace();
    header_->header_limit(kMaxHeaderBytes);
    header_->body_limit(std::numeric_limits<std::uint64_t>::max());  // begin_upload() knows the limit
    stream_.expires_after(kIdleTimeout);
    http::async_read_header(stream_, buffer_, *header_,
                            [self = shared_from_this()](ErrorCode error, std::size_t) { self->on_header(error); });
  }

 private:
  const http::fields& headers() const { return header_->get(); }
  std::string_view header(http::field name) const { return view(headers()[name]); }

  void on_header(ErrorCode error) {
    if (error == http::error::end_of_stream) return close();
    if (error) return;  // disconnected, or not HTTP
    const std::optional<RequestTarget> target = parse_target(view(header_->get().target()));
    if (std::optional<HttpResponse> rejection = find_rejection(target)) {
      ++site_.hub().counters().refused;
      return send(*rejection, KeepAlive::No);
    }
    if (target->path == "/session") return upgrade(*target);
    if (header_->get().method() == http::verb::post) return receive_upload(*target);
    if (header_->get().method() != http::verb::get)
      return send(error_response(405, "this method is not supported (only GET and POST are); use one of these"),
                  KeepAlive::No);
    site_.get(*target,
              [self = shared_from_this()](const HttpResponse& response) { self->send(response, KeepAlive::Yes); });
  }

  /// Checks the rules of docs/wire.md, "Access", in their order. @return the response if one is broken
  std::optional<HttpResponse> find_rejection(const std::optional<RequestTarget>& target) const {
    const AccessRules& rules = site_.rules();
    if (headers().count(http::field::host) != 1 || !rules.is_own_host(header(http::field::host)))
      return error_response(
          421, "the Host header is wrong (it is none of this server's names); use the URL that it printed");
    if (!target)
      return error_response(400, "the request was not understood (its target is malformed); correct the client");
    const bool is_socket = target->path == "/session", is_api = target->path.substr(0, 5) == "/api/";
    if (!is_socket && !is_api) return {};

    const auto origins = headers().count(http::field::origin);
    const bool own_origin = origins == 1 && rules.is_own_origin(header(http::field::origin));
    if (is_socket ? !own_origin : origins != 0 && !own_origin)
      return error_response(
          403, "the Origin header is wrong (requests from other sites are refused); use the URL that it printed");
    const bool token = is_socket ? rules.offers_token(header(http::field::sec_websocket_protocol))
                                 : rules.is_authorized(header(http::field::authorization));
    if (!token)
      return error_response(
          401, "the token is missing or wrong (every run has a new one); use the URL that the server printed");
    return {};
  }

  void upgrade(const RequestTarget& target) {
    const auto key = target.query.find("client");
    if (!beast::websocket::is_upgrade(header_->get()) || key == target.query.end() || !is_client_key(key->second))
      return send(
          error_response(
              400, "this is not a WebSocket request (an upgrade with client=HEX is required); correct the client"),
          KeepAlive::No);
    http::request<http::string_body> request;
    static_cast<http::request_header<>&>(request) = header_->get();
    serve_socket(std::move(stream_), request, {key->second, std::move(count_)}, site_);
  }

  void receive_upload(const RequestTarget& target) {
    const boost::optional<std::uint64_t> length = header_->content_length();
    if (!length)
      return send(error_response(411, "the upload has no length (Content-Length is required); correct the client"),
                  KeepAlive::No);
    auto begun = site_.begin_upload(target, std::string(view(headers()["X-Client"])), *length);
    if (auto* rejection = std::get_if<HttpResponse>(&begun)) return send(*rejection, KeepAlive::No);
    upload_ = std::move(std::get<Upload>(begun));
    body_.emplace(std::move(*header_));
    body_->body_limit(*length);
    ErrorCode error;
    body_->get().body().open(upload_.file.c_str(), beast::file_mode::write_new, error);
    if (error) return reject_storage(error);
    receive_part();
  }

  void receive_part() {
    if (body_->is_done()) return finish_upload();
    stream_.expires_after(kIdleTimeout);
    http::async_read_some(stream_, buffer_, *body_, [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (!error) return self->receive_part();
      if (is_of_disk(error)) self->reject_storage(error);
    });
  }

  void finish_upload() {
    body_->get().body().close();
    Upload complete;
    std::swap(complete, upload_);
    site_.finish_upload(
        complete, [self = shared_from_this()](const HttpResponse& response) { self->send(response, KeepAlive::No); });
  }

  void reject_storage(const ErrorCode& error) {
    send(error_response(507, "the upload cannot be stored (" + error.message() + "); free some space"), KeepAlive::No);
  }

  enum class KeepAlive { Yes, No };

  void send(const HttpResponse& content, KeepAlive keep_alive) {
    static const auto kNothing = std::make_shared<const std::string>();
    sent_body_ = header_->get().method() == http::verb::head ? kNothing : content.body;  // RFC 9110, 9.3.2
    auto response = std::make_shared<http::response<http::span_body<const char>>>();
    response->version(11);
    response->result(content.status);
    response->set(http::field::content_type, content.content_type);
    response->set(http::field::cache_control, "no-store");
    if (!content.file_name.empty())
      response->set(http::field::content_disposition, attachment_disposition(content.file_name));
    if (content.status == 405) response->set(http::field::allow, "GET, POST");
    add_security_headers(response->base());
    response->body() = {sent_body_->data(), sent_body_->size()};
    response->keep_alive(keep_alive == KeepAlive::Yes && header_->is_done() && header_->get().keep_alive());
    response->prepare_payload();
    stream_.expires_after(kIdleTimeout);
    http::async_write(stream_, *response, [self = shared_from_this(), response](ErrorCode error, std::size_t) {
      if (error) return;
      response->need_eof() ? self->close() : self->read_request();
    });
  }

  /// Ends the connection when the client has done so, or soon: closing it while an upload that was rejected still comes
  /// would take the response away from the client.
  void close() {
    ErrorCode ignored;
    stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kCloseTimeout);
    discard();
  }

  void discard() {
    buffer_.consume(buffer_.size());
    stream_.async_read_some(buffer_.prepare(kDiscardBytes), [self = shared_from_this()](ErrorCode error, std::size_t) {
      if (!error) self->discard();
    });
  }

  beast::tcp_stream stream_;
  Site& site_;
  std::shared_ptr<const void> count_;
  beast::flat_buffer buffer_{kMaxHeaderBytes + 64 * 1024};
  std::optional<http::request_parser<http::empty_body>> header_;
  std::optional<http::request_parser<http::file_body>> body_;
  Upload upload_;         // that is being received; its folder goes with this if it stays incomplete
  SharedText sent_body_;  // of the response that is being sent
};

}  // namespace

HttpResponse json_response(unsigned status, const Json& json) {
  return {status, "application/json", std::make_shared<const std::string>(text_of(json)), {}};
}

HttpResponse error_response(unsigned status, const std::string& error) {
  return json_response(status, {{"error", error}});
}

void serve_connection(boost::asio::ip::tcp::socket socket, Site& site, std::shared_ptr<const void> count) {
  std::make_shared<HttpConnection>(std::move(socket), site, std::move(count))->read_request();
}

}  // namespace dismantle::server
