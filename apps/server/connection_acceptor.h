// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <functional>

namespace dismantle::server {

/// A file descriptor that is kept for the time when the process has no other left: closing it makes room to accept a
/// connection, and to refuse it.
class SpareDescriptor {
 public:
  /// Takes a descriptor.
  SpareDescriptor() { take(); }
  ~SpareDescriptor() { release(); }
  SpareDescriptor(const SpareDescriptor&) = delete;
  SpareDescriptor& operator=(const SpareDescriptor&) = delete;
  /// Takes a descriptor again, if there is one.
  void take();
  /// Makes room for another descriptor.
  void release();

 private:
  int descriptor_ = -1;
};

/// Accepts the connections to one endpoint. If the process has too many open files, connections are refused at once,
/// and after a pause it tries again. For the thread that runs the io_context.
class ConnectionAcceptor {
 public:
  /// Receives accepted connections.
  using OnSocket = std::function<void(boost::asio::ip::tcp::socket)>;

  /// @param on_socket receives connections from start() to close()
  ConnectionAcceptor(boost::asio::io_context& io, OnSocket on_socket)
      : acceptor_(io), pause_(io), on_socket_(std::move(on_socket)) {}

  /// Listens. @return the error, if the endpoint is taken or there is no such address
  boost::system::error_code listen(const boost::asio::ip::tcp::endpoint& endpoint);
  /// True from a successful listen() to close().
  bool is_open() const { return acceptor_.is_open(); }
  /// The port. @pre is_open()
  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  /// Starts to accept. @pre is_open()
  void start();
  /// Stops to listen.
  void close();

 private:
  void refuse_waiting();
  void start_after_pause();

  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  OnSocket on_socket_;
  SpareDescriptor spare_;
};

}  // namespace dismantle::server
