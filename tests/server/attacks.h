// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/server/test_client.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// Attacks on a live server over its sockets (docs/security.md). Each tells how the server answered, and what it should
/// not have done.
namespace dismantle::server::testing_client {

/// How a server answered an attack.
struct AttackResult {
  std::map<std::string, int> answers;  ///< "421", "closed 1002", ...: how often.
  std::vector<std::string> failures;   ///< What should not have happened.

  /// Counts an answer; it is a failure unless it is one of `expected`.
  void add(const std::string& what, const std::string& answer, const std::vector<std::string>& expected);
};

/// The status of an HTTP response as it came over the socket; "closed" or "silent" if there is none.
std::string status_of(const RawConnection& connection, const std::string& response);

/// Names of other hosts, and malformed ones, in the Host header of requests for the page, the API and the socket.
AttackResult attack_by_host(const ServerAddress& address);
/// Requests that a browser sends for a page of another site, also of one whose name leads to this machine by now.
AttackResult attack_by_origin(const ServerAddress& address);
/// Wrong tokens, `count` of each kind.
AttackResult attack_by_token(const ServerAddress& address, int count);
/// Requests that are malformed, or larger than any browser sends.
AttackResult attack_by_http(const ServerAddress& address);
/// Frames that break RFC 6455, or are larger than allowed, each on a socket of its own.
AttackResult attack_by_frames(const ServerAddress& address);
/// Names that lead out of the roots or the page, in every parameter that names a file. `root` is the server's only
/// root; beside it is a folder with the file "secret.obj".
AttackResult attack_by_paths(const ServerAddress& address, const std::filesystem::path& root,
                             const std::filesystem::path& outside);
/// Connections one after another, each with a request for the page.
AttackResult attack_by_many_connections(const ServerAddress& address, int count);
/// Clients with new keys, each of which leaves after a command.
AttackResult attack_by_many_clients(const ServerAddress& address, int count);
/// Commands of a megabyte that are not waited for.
AttackResult attack_by_large_commands(const ServerAddress& address, int count);

}  // namespace dismantle::server::testing_client
