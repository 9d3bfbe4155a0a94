// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "tests/server/test_client.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <optional>
#include <stdexcept>

namespace dismantle::server::testing_client {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using ErrorCode = boost::system::error_code;

namespace {

/// Runs an io_context until `done`.
template <class Done>
void run_until(asio::io_context& io, const Done& done, const char* what) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!done()) {
    io.restart();
    io.run_one_until(end);
    if (std::chrono::steady_clock::now() >= end) throw std::runtime_error(std::string("nothing came: ") + what);
  }
}

void connect(beast::tcp_stream& stream, std::uint16_t port) {
  stream.connect(asio::ip::tcp::endpoint(asio::ip::address_v4::loopback(), port));
}

std::string text_of(beast::string_view view) {
  return {view.data(), view.size()};
}

/// The response to a Client's handshake, as plain HTTP.
HttpReply upgrade(const ServerAddress& address, const std::string& key, const Headers& headers) {
  Headers all = {{"Origin", address.origin()},
                 {"Connection", "Upgrade"},
                 {"Upgrade", "websocket"},
                 {"Sec-WebSocket-Version", "13"},
                 {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
                 {"Sec-WebSocket-Protocol", "dismantle.1, token." + address.token}};
  for (const auto& [name, value] : headers) all[name] = value;
  return request(address, "GET", "/session?client=" + key, all);
}

}  // namespace

HttpReply request(const ServerAddress& address, const std::string& method, const std::string& target, Headers headers,
                  const std::string& body) {
  asio::io_context io;
  beast::tcp_stream stream(io);
  connect(stream, address.port);
  http::request<http::string_body> message(http::string_to_verb(method), target, 11);
  headers.try_emplace("Host", address.host());
  for (const auto& [name, value] : headers)
    if (!value.empty()) message.set(name, value);
  message.body() = body;
  message.prepare_payload();
  ErrorCode error;
  http::write(stream, message, error);  // may fail: the refusal can arrive before all is sent
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(std::uint64_t{1} << 30);
  bool done = false;
  http::async_read(stream, buffer, parser, [&](ErrorCode e, std::size_t) {
    error = e;
    done = true;
  });
  run_until(
      io, [&] { return done; }, "a reply");
  if (error) throw boost::system::system_error(error);
  HttpReply reply{parser.get().result_int(), parser.get().body(), {}};
  for (const auto& field : parser.get()) reply.headers[text_of(field.name_string())] = text_of(field.value());
  return reply;
}

HttpReply get(const ServerAddress& address, const std::string& target) {
  return request(address, "GET", target, {{"Authorization", "Bearer " + address.token}});
}

std::string exchange(const ServerAddress& address, const std::string& bytes, std::chrono::milliseconds quiet) {
  RawConnection connection(address);
  connection.send(bytes);
  return connection.receive(quiet);
}

namespace {

/// For all raw connections of a thread, of which one at a time waits: an io_context of its own takes three descriptors.
asio::io_context& shared_io() {
  thread_local asio::io_context io;
  return io;
}

}  // namespace

class RawConnection::Impl {
 public:
  asio::io_context& io = shared_io();
  asio::ip::tcp::socket socket{io};
  bool is_closed = false;
};

RawConnection::RawConnection(const ServerAddress& address) : impl_(std::make_unique<Impl>()) {
  impl_->socket.connect({asio::ip::address_v4::loopback(), address.port});
}
RawConnection::~RawConnection() = default;

bool RawConnection::send(const std::string& bytes) {
  ErrorCode error;
  asio::write(impl_->socket, asio::buffer(bytes), error);
  impl_->is_closed |= static_cast<bool>(error);
  return !error;
}

std::string RawConnection::receive(std::chrono::milliseconds quiet) {
  std::string reply, part(std::size_t{1} << 16, '\0');
  for (bool is_over = false; !is_over;) {
    bool done = false;
    impl_->socket.async_read_some(asio::buffer(part), [&](ErrorCode error, std::size_t count) {
      reply.append(part, 0, count);
      done = true;
      is_over = static_cast<bool>(error);
      impl_->is_closed |= error && error != asio::error::operation_aborted;
    });
    impl_->io.restart();
    impl_->io.run_for(quiet);
    if (done) continue;
    impl_->socket.cancel();
    impl_->io.restart();
    impl_->io.run();
  }
  return reply;
}

bool RawConnection::is_closed() const {
  return impl_->is_closed;
}

class Client::Impl {
 public:
  Impl(const ServerAddress& address, const std::string& key, const Headers& headers) : stream_(io_) {
    connect(stream_.next_layer(), address.port);
    stream_.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
      request.set(http::field::host, address.host());
      request.set(http::field::origin, address.origin());
      request.set(http::field::sec_websocket_protocol, "dismantle.1, token." + address.token);
      for (const auto& [name, value] : headers) {
        request.erase(name);
        if (!value.empty()) request.set(name, value);
      }
    }));
    websocket::response_type response;
    ErrorCode error;
    stream_.handshake(response, address.host(), "/session?client=" + key, error);
    status_ = response.result_int();
    protocol_ = text_of(response[http::field::sec_websocket_protocol]);
    ended_ = static_cast<bool>(error);
    if (ended_) {  // Beast does not expose the refusal: send the request again
      status_ = upgrade(address, key, headers).status;
      return;
    }
    stream_.read_message_max(std::size_t{256} << 20);
    stream_.control_callback(
        [this](websocket::frame_type kind, beast::string_view) { pings_ += kind == websocket::frame_type::ping; });
    read();
  }

  void read() {
    stream_.async_read(buffer_, [this](ErrorCode error, std::size_t) {
      if (error) {
        ended_ = true;
        return;
      }
      const std::string message = beast::buffers_to_string(buffer_.data());
      buffer_.consume(buffer_.size());
      if (stream_.got_text()) {
        texts_.push_back(Json::parse(message));
      } else if (const auto pose = decode_pose(message)) {
        poses_.push_back(*pose);
      } else {
        throw std::runtime_error("the server sent a struct that is none");
      }
      read();
    });
  }

  void write(const std::string& bytes, bool is_text) {
    bool done = false;
    stream_.text(is_text);
    stream_.async_write(asio::buffer(bytes), [&](ErrorCode error, std::size_t) {
      done = true;
      ended_ |= static_cast<bool>(error);
    });
    run_until(
        io_, [&] { return done; }, "room to write");
  }

  bool has_event(const std::string& name) {
    io_.restart();
    io_.poll();
    for (const Json& j : texts_)
      if (j.value("event", "") == name) return true;
    return false;
  }

  template <class IsIt>
  Json take(const IsIt& is_it, const char* what) {
    std::optional<Json> found;
    const auto look = [&] {
      for (auto at = texts_.begin(); at != texts_.end() && !found; ++at) {
        if (!is_it(*at)) continue;
        found = std::move(*at);
        texts_.erase(at);
        break;
      }
      return found.has_value() || ended_;
    };
    run_until(io_, look, what);
    if (!found) throw std::runtime_error(std::string("the socket ended while this was awaited: ") + what);
    return *found;
  }

  asio::io_context io_;
  websocket::stream<beast::tcp_stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<Json> texts_;
  std::deque<PoseMessage> poses_;
  Json latest_state_;
  unsigned status_ = 0;
  std::string protocol_;
  bool ended_ = false;
  int pings_ = 0;
  std::uint64_t last_id_ = 0;
};

Client::Client(const ServerAddress& address, std::string key, const Headers& headers)
    : impl_(std::make_unique<Impl>(address, key, headers)) {}
Client::~Client() = default;
Client::Client(Client&&) noexcept = default;

unsigned Client::status() const {
  return impl_->status_;
}

const std::string& Client::protocol() const {
  return impl_->protocol_;
}

bool Client::is_open() const {
  return !impl_->ended_;
}

int Client::pings() const {
  return impl_->pings_;
}

unsigned Client::close_code() const {
  return impl_->stream_.reason().code;
}

void Client::send_text(const std::string& text) {
  impl_->write(text, true);
}

void Client::send_binary(const std::string& bytes) {
  impl_->write(bytes, false);
}

std::uint64_t Client::send_command(const std::string& name, Json arguments) {
  arguments["id"] = ++impl_->last_id_;
  arguments["command"] = name;
  send_text(server::text_of(arguments));
  return impl_->last_id_;
}

Json Client::reply(std::uint64_t id) {
  return impl_->take([&](const Json& j) { return j.value("reply", std::uint64_t{0}) == id; }, "a reply");
}

Json Client::event(const std::string& name) {
  return impl_->take([&](const Json& j) { return j.value("event", "") == name; }, name.c_str());
}

Json Client::state() {
  Json& latest = impl_->latest_state_;
  while (impl_->has_event("state") || latest.is_null()) latest = event("state");
  return latest;
}

PoseMessage Client::pose() {
  run_until(
      impl_->io_, [&] { return !impl_->poses_.empty() || impl_->ended_; }, "a pose");
  if (impl_->poses_.empty()) throw std::runtime_error("the socket ended while a pose was awaited");
  PoseMessage message = impl_->poses_.front();
  impl_->poses_.pop_front();
  return message;
}

void Client::wait_for_end() {
  run_until(
      impl_->io_, [&] { return impl_->ended_; }, "the end of the socket");
}

void Client::idle(std::chrono::milliseconds time) {
  impl_->io_.restart();
  impl_->io_.run_for(time);
}

void Client::drop() {
  impl_->stream_.next_layer().close();
}

void Client::set_last_id(std::uint64_t id) {
  impl_->last_id_ = id;
}

}  // namespace dismantle::server::testing_client
