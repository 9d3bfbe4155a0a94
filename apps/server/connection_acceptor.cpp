// SPDX-License-Identifier: Apache-2.0
#include "apps/server/connection_acceptor.h"

#include <boost/asio/ip/v6_only.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>

namespace dismantle::server {

namespace asio = boost::asio;

namespace {

using ErrorCode = boost::system::error_code;

/// Until it is tried again to accept connections.
constexpr std::chrono::milliseconds kPause{200};
/// Connections that are refused before that; more wait.
constexpr int kMaxRefused = 1000;

/// Once in a process: whoever opens connections decides how often it happens.
void report_refusal(const ErrorCode& error) {
  static std::atomic<bool> is_reported = false;
  if (is_reported.exchange(true)) return;
  std::fprintf(stderr,
               "connections are refused for now (%s); close pages that are not needed, or allow more open files with "
               "'ulimit -n'\n",
               error.message().c_str());
}

}  // namespace

void SpareDescriptor::take() {
  if (descriptor_ < 0) descriptor_ = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

void SpareDescriptor::release() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

boost::system::error_code ConnectionAcceptor::listen(const asio::ip::tcp::endpoint& endpoint) {
  ErrorCode error;
  acceptor_.open(endpoint.protocol(), error);
  if (error) return error;
  acceptor_.set_option(asio::ip::tcp::acceptor::reuse_address(true), error);
  if (endpoint.protocol() == asio::ip::tcp::v6()) acceptor_.set_option(asio::ip::v6_only(true), error);
  acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (!error) acceptor_.non_blocking(true, error);
  if (error) close();
  return error;
}

void ConnectionAcceptor::start() {
  acceptor_.async_accept([this](ErrorCode error, asio::ip::tcp::socket socket) {
    if (error == asio::error::operation_aborted || !acceptor_.is_open()) return;
    if (!error) {
      on_socket_(std::move(socket));
      return start();
    }
    report_refusal(error);
    refuse_waiting();
    start_after_pause();
  });
}

void ConnectionAcceptor::refuse_waiting() {
  spare_.release();
  ErrorCode error;
  for (int i = 0; i < kMaxRefused && !error; ++i) const asio::ip::tcp::socket refused = acceptor_.accept(error);
  spare_.take();
}

void ConnectionAcceptor::start_after_pause() {
  pause_.expires_after(kPause);
  pause_.async_wait([this](ErrorCode error) {
    if (error || !acceptor_.is_open()) return;
    spare_.take();
    start();
  });
}

void ConnectionAcceptor::close() {
  ErrorCode ignored;
  acceptor_.close(ignored);
  pause_.cancel();
}

}  // namespace dismantle::server
