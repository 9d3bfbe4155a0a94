// SPDX-License-Identifier: Apache-2.0
#include "apps/server/web_socket.h"

#include "apps/server/http_headers.h"

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <memory>

namespace dismantle::server {

namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using ErrorCode = boost::system::error_code;

constexpr std::size_t kMaxMessageBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxUnsentBytes = std::size_t{16} << 20;  // queued for a slow client
constexpr std::chrono::seconds kHandshakeTimeout{10};

/// A connected WebSocket. Its pending operations own it; it is registered with the hub from the handshake to the close.
class WebSocket : public ClientSocket, public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(beast::tcp_stream stream, SocketOwner owner, Site& site)
      : stream_(std::move(stream)), count_(std::move(owner.count)), key_(std::move(owner.key)), site_(site) {}

  void accept(const http::request<http::string_body>& upgrade) {
    websocket::stream_base::timeout times{kHandshakeTimeout, site_.idle_time(), /*keep_alive_pings=*/true};
    beast::get_lowest_layer(stream_).expires_never();
    ErrorCode ignored;  // without the option, the socket is only slower
    beast::get_lowest_layer(stream_).socket().set_option(boost::asio::ip::tcp::no_delay(true), ignored);
    stream_.set_option(times);
    stream_.set_option(websocket::stream_base::decorator(&WebSocket::complete_response));
    stream_.read_message_max(kMaxMessageBytes);
    stream_.auto_fragment(false);
    stream_.async_accept(upgrade, [self = shared_from_this()](ErrorCode error) {
      if (error) return;
      self->is_registered_ = true;
      self->site_.hub().connect(self->key_, *self);
      self->read();
    });
  }

  void send_text(SharedText text) override {
    if (is_closing_) return;
    unsent_bytes_ += text->size();
    if (unsent_bytes_ > kMaxUnsentBytes) return drop();
    texts_.push_back(std::move(text));
    write();
  }

  void send_pose(SharedText bytes) override {
    if (is_closing_) return;
    if (pose_) ++site_.hub().counters().dropped_frames;
    pose_ = std::move(bytes);
    write();
  }

  void close(CloseReason reason) override {
    if (is_closing_) return;
    is_closing_ = true;
    close_code_ =
        reason == CloseReason::Malformed ? websocket::close_code::policy_error : websocket::close_code::going_away;
    if (!is_writing_) send_close();
  }

 private:
  /// Completes Beast's response to a handshake: the chosen protocol, or an error as JSON instead of plain text.
  static void complete_response(websocket::response_type& response) {
    add_security_headers(response);
    if (response.result() == http::status::switching_protocols) {
      response.set(http::field::sec_websocket_protocol, kProtocol.data());
      return;
    }
    const HttpResponse error = error_response(
        response.result_int(), "this is not a WebSocket handshake (" + response.body() + "); correct the client");
    response.set(http::field::content_type, error.content_type);
    response.body() = *error.body;
    response.keep_alive(false);
    response.prepare_payload();
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, std::size_t) { self->on_read(error); });
  }

  void on_read(ErrorCode error) {
    if (error) return unregister();
    const auto data = buffer_.cdata();
    const std::string_view message(static_cast<const char*>(data.data()), data.size());
    if (!is_closing_) {
      stream_.got_text() ? site_.hub().receive_text(key_, message) : site_.hub().receive_binary(key_, message);
    }
    buffer_.consume(buffer_.size());
    read();
  }

  /// Sends the next text or, if there is none, the newest pose.
  void write() {
    if (is_writing_ || is_closing_ || (texts_.empty() && !pose_)) return;
    is_writing_ = true;
    const bool is_text = !texts_.empty();
    if (is_text) {
      sending_ = std::move(texts_.front());
      texts_.pop_front();
      unsent_bytes_ -= sending_->size();
    } else {
      sending_ = std::move(pose_);
      pose_.reset();
    }
    stream_.text(is_text);
    stream_.async_write(boost::asio::buffer(*sending_), [self = shared_from_this()](ErrorCode error, std::size_t sent) {
      self->is_writing_ = false;
      self->site_.hub().counters().bytes_out += sent;
      if (error) return self->unregister();
      self->is_closing_ ? self->send_close() : self->write();
    });
  }

  void send_close() {
    stream_.async_close(close_code_, [self = shared_from_this()](ErrorCode) { self->unregister(); });
  }

  /// Closes the connection without a handshake, as the client does not read.
  void drop() {
    is_closing_ = true;
    texts_.clear();
    beast::get_lowest_layer(stream_).close();
    unregister();
  }

  void unregister() {
    is_closing_ = true;
    if (std::exchange(is_registered_, false)) site_.hub().disconnect(key_, *this);
  }

  websocket::stream<beast::tcp_stream> stream_;
  std::shared_ptr<const void> count_;
  std::string key_;
  Site& site_;
  beast::flat_buffer buffer_;
  std::deque<SharedText> texts_;
  SharedText pose_, sending_;
  std::size_t unsent_bytes_ = 0;  ///< In texts_.
  bool is_registered_ = false, is_writing_ = false, is_closing_ = false;
  websocket::close_code close_code_ = websocket::close_code::normal;
};

}  // namespace

void serve_socket(beast::tcp_stream stream, const http::request<http::string_body>& upgrade, SocketOwner owner,
                  Site& site) {
  const auto socket = std::make_shared<WebSocket>(std::move(stream), std::move(owner), site);
  socket->accept(upgrade);
}

}  // namespace dismantle::server
