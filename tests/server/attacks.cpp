// SPDX-License-Identifier: Apache-2.0
#include "tests/server/attacks.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <string_view>
#include <utility>

namespace dismantle::server::testing_client {

namespace fs = std::filesystem;

namespace {

const std::string kSecret = "v 12.5 12.5 12.5";

std::string bearer(const ServerAddress& address) {
  return "Authorization: Bearer " + address.token + "\r\n";
}

std::string upgrade_lines(const ServerAddress& address, const std::string& token) {
  return "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: dismantle.1, token." +
         (token.empty() ? address.token : token) + "\r\n";
}

std::string answer_to(const ServerAddress& address, const std::string& bytes) {
  RawConnection connection(address);
  connection.send(bytes);
  const std::string response = connection.receive(std::chrono::milliseconds(100));
  return status_of(connection, response);
}

const char* const kTargets[] = {"/", "/api/model.glb", "/session?client=00112233445566778899aabbccddeeff"};

/// Answers to GET requests for the page, the API and the socket, with the token.
void get_all(AttackResult& result, const ServerAddress& address, const std::string& lines,
             const std::vector<std::string>& expected) {
  for (const char* target : kTargets)
    result.add(target + (" with " + lines),
               answer_to(address, std::string("GET ") + target + " HTTP/1.1\r\n" + lines + bearer(address) +
                                      upgrade_lines(address, {}) + "\r\n"),
               expected);
}

}  // namespace

void AttackResult::add(const std::string& what, const std::string& answer, const std::vector<std::string>& expected) {
  ++answers[answer];
  if (std::find(expected.begin(), expected.end(), answer) == expected.end())
    failures.push_back(what.substr(0, 200) + ": " + answer);
}

std::string status_of(const RawConnection& connection, const std::string& response) {
  if (response.rfind("HTTP/1.1 ", 0) == 0) return response.substr(9, 3);
  return connection.is_closed() ? "closed" : "silent";
}

AttackResult attack_by_host(const ServerAddress& address) {
  AttackResult result;
  const std::string port = ":" + std::to_string(address.port), own = "Origin: " + address.origin() + "\r\n";
  for (const std::string& host :
       {"evil.example" + port, std::string("127.0.0.1"), std::string("127.0.0.1:1"), "127.0.0.1." + port,
        "127.0.0.1" + port + ".", "127.1" + port, "2130706433" + port, "0x7f.0.0.1" + port, "0.0.0.0" + port,
        "127.0.0.2" + port, "LOCALHOST" + port, "localhost." + port, "[::ffff:127.0.0.1]" + port, "[::]" + port,
        "user@127.0.0.1" + port, "127.0.0.1" + port + ",evil.example", "127.0.0.1" + port + "\t evil.example",
        std::string(), std::string(5000, 'a')})
    get_all(result, address, "Host: " + host + "\r\n" + own, {"421"});
  get_all(result, address, own, {"421"});
  get_all(result, address, "Host: " + address.host() + "\r\nHost: evil.example\r\n" + own, {"421"});
  // The name of another site that leads to this machine by now: the browser thinks that it talks to that site.
  const std::string rebound = "rebound.example" + port;
  get_all(result, address, "Host: " + rebound + "\r\nOrigin: http://" + rebound + "\r\n", {"421"});
  return result;
}

AttackResult attack_by_origin(const ServerAddress& address) {
  AttackResult result;
  const std::string port = std::to_string(address.port);
  for (const std::string& origin :
       {std::string("null"), std::string("http://evil.example"), "https://127.0.0.1:" + port,
        std::string("http://127.0.0.1"), std::string("http://127.0.0.1:1"), "http://127.0.0.1:" + port + "0",
        "http://127.0.0.1:" + port + ".evil.example", "http://127.0.0.1:" + port + "/", "file://127.0.0.1:" + port,
        "http://evil.example#127.0.0.1:" + port, address.origin() + "\r\nOrigin: http://evil.example"})
    for (const char* target : {kTargets[1], kTargets[2]})
      result.add(target + (" from " + origin),
                 answer_to(address, std::string("GET ") + target + " HTTP/1.1\r\nHost: " + address.host() +
                                        "\r\nOrigin: " + origin + "\r\n" + bearer(address) +
                                        upgrade_lines(address, {}) + "\r\n"),
                 {"403"});
  result.add("socket without Origin",
             answer_to(address, std::string("GET ") + kTargets[2] + " HTTP/1.1\r\nHost: " + address.host() + "\r\n" +
                                    upgrade_lines(address, {}) + "\r\n"),
             {"403"});
  return result;
}

AttackResult attack_by_token(const ServerAddress& address, int count) {
  AttackResult result;
  const auto changed = [&](std::size_t place) {
    std::string token = address.token;
    token[place] = token[place] == '0' ? '1' : '0';
    return token;
  };
  const std::vector<std::string> guesses = {changed(0),
                                            changed(31),
                                            changed(15),
                                            {},
                                            address.token.substr(0, 31),
                                            address.token + "0",
                                            std::string(32, '0'),
                                            std::string(10000, '0'),
                                            "Bearer " + address.token};
  for (int i = 0; i < count; ++i)
    for (const std::string& guess : guesses) {
      const HttpReply api = request(address, "GET", "/api/path.json", {{"Authorization", "Bearer " + guess}});
      result.add("API with token " + guess, std::to_string(api.status), {"401"});
      const HttpReply socket = request(address, "GET", kTargets[2],
                                       {{"Origin", address.origin()},
                                        {"Connection", "Upgrade"},
                                        {"Upgrade", "websocket"},
                                        {"Sec-WebSocket-Version", "13"},
                                        {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
                                        {"Sec-WebSocket-Protocol", "dismantle.1, token." + guess}});
      result.add("socket with token " + guess, std::to_string(socket.status), {"401"});
    }
  result.add("the owner", std::to_string(get(address, "/api/path.json").status), {"200"});
  return result;
}

AttackResult attack_by_http(const ServerAddress& address) {
  AttackResult result;
  const std::string host = "Host: " + address.host() + "\r\n", get = "GET / HTTP/1.1\r\n" + host;
  std::string fields = get;
  for (int i = 0; i < 100'000; ++i) fields += "A" + std::to_string(i) + ": b\r\n";
  const std::string post = "POST /api/open?name=a.obj HTTP/1.1\r\n" + host + bearer(address);
  const std::vector<std::string> requests = {std::string("\r\n\r\n"),
                                             std::string("GET\r\n\r\n"),
                                             std::string(1 << 20, 'A'),
                                             "GET /" + std::string(1 << 20, 'a') + " HTTP/1.1\r\n" + host + "\r\n",
                                             get + "A: " + std::string(1 << 20, 'x'),
                                             fields,
                                             "GET / HTTP/9.9\r\n" + host + "\r\n",
                                             "GET  / HTTP/1.1\r\n" + host + "\r\n",
                                             "GET / HTTP/1.1\n" + host + "\n",
                                             get + " folded: a\r\n\r\n",
                                             get + std::string("A\0b: c\r\n\r\n", 10),
                                             "GET http://evil.example/ HTTP/1.1\r\n" + host + "\r\n",
                                             std::string("\x16\x03\x01\x02\x00", 5),
                                             "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
                                             "TRACE / HTTP/1.1\r\n" + host + "\r\n",
                                             "CONNECT evil.example:80 HTTP/1.1\r\n" + host + "\r\n",
                                             "OPTIONS * HTTP/1.1\r\n" + host + "\r\n",
                                             post + "Content-Length: 99999999999999999999\r\n\r\n",
                                             post + "Content-Length: -1\r\n\r\n",
                                             post + "Content-Length: 1\r\nContent-Length: 2\r\n\r\nab",
                                             post + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
                                             post + "Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n",
                                             post + "Content-Length: 5000000000\r\n\r\n"};
  for (const std::string& bytes : requests)
    result.add(bytes.substr(0, 60), answer_to(address, bytes),
               {"400", "403", "404", "405", "411", "413", "421", "closed", "silent"});
  return result;
}

namespace {

/// A frame of a client. @param head the first byte: final and reserved bits, and the opcode
std::string frame(int head, const std::string& payload, bool is_masked = true, std::uint64_t claimed = 0) {
  const std::uint64_t size = claimed > 0 ? claimed : payload.size();
  const int mask_bit = is_masked ? 0x80 : 0;
  std::string bytes(1, static_cast<char>(head));
  if (size < 126) {
    bytes += static_cast<char>(mask_bit | static_cast<int>(size));
  } else {
    const int length = size < 65536 ? 2 : 8;
    bytes += static_cast<char>(mask_bit | (length == 2 ? 126 : 127));
    for (int i = length - 1; i >= 0; --i) bytes += static_cast<char>(size >> (8 * i) & 0xff);
  }
  return bytes + (is_masked ? std::string(4, '\0') : "") + payload;
}

std::string close_frame(int code, const std::string& reason = {}) {
  return frame(0x88, std::string{static_cast<char>(code >> 8), static_cast<char>(code & 0xff)} + reason);
}

/// The code of the close frame among frames of the server; 0 if there is none.
int close_code_in(std::string_view frames) {
  while (frames.size() >= 2) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(frames[i]); };
    std::size_t head = 2, size = byte(1) & 0x7f;
    const std::size_t length = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (frames.size() < head + length) return 0;
    if (length > 0) size = 0;
    for (std::size_t i = 0; i < length; ++i) size = size << 8 | byte(head + i);
    head += length;
    if (frames.size() < head + size) return 0;
    if ((byte(0) & 0x0f) == 8) return size >= 2 ? byte(head) << 8 | byte(head + 1) : 1005;
    frames.remove_prefix(head + size);
  }
  return 0;
}

/// How a socket ended that was sent these frames: "closed 1002", "closed", or "open".
std::string end_of_socket(const ServerAddress& address, const std::string& frames) {
  RawConnection connection(address);
  connection.send(std::string("GET ") + kTargets[2] + " HTTP/1.1\r\nHost: " + address.host() +
                  "\r\nOrigin: " + address.origin() + "\r\n" + upgrade_lines(address, {}) + "\r\n");
  std::string received = connection.receive(std::chrono::milliseconds(50));
  connection.send(frames);
  int code = 0;
  // A busy machine may take a while to answer.
  for (int wait = 0; wait < 20 && code == 0 && !connection.is_closed(); ++wait) {
    received += connection.receive(std::chrono::milliseconds(100));
    const std::size_t body = received.find("\r\n\r\n");
    if (body != std::string::npos) code = close_code_in(std::string_view(received).substr(body + 4));
  }
  if (status_of(connection, received) != "101" || received.find("\r\n\r\n") == std::string::npos) return "no socket";
  if (code > 0) return "closed " + std::to_string(code);
  return connection.is_closed() ? "closed" : "open";
}

}  // namespace

AttackResult attack_by_frames(const ServerAddress& address) {
  AttackResult result;
  const std::string check = R"({"id": 1, "command": "check"})";
  const std::vector<std::string> broken = {"closed 1002", "closed 1007", "closed 1009", "closed"};
  const std::vector<std::pair<const char*, std::string>> frames = {
      {"reserved bit 1", frame(0xc1, check)},
      {"reserved bit 2", frame(0xa1, check)},
      {"reserved bit 3", frame(0x91, check)},
      {"no mask", frame(0x81, check, false)},
      {"fragmented ping", frame(0x09, "x")},
      {"fragmented close", frame(0x08, "")},
      {"long ping", frame(0x89, std::string(126, 'x'))},
      {"reserved opcode 3", frame(0x83, check)},
      {"reserved opcode 7", frame(0x87, check)},
      {"reserved control 11", frame(0x8b, "")},
      {"reserved control 15", frame(0x8f, "")},
      {"continuation of nothing", frame(0x80, check)},
      {"text within text", frame(0x01, "{") + frame(0x81, check)},
      {"text that is not UTF-8", frame(0x81, "\xff\xfe")},
      {"text that is not UTF-8 in its second part", frame(0x01, "\xe2\x82") + frame(0x80, "x")},
      {"length of 2^63", frame(0x82, "x", true, std::uint64_t{1} << 63)},
      {"length of 1 GiB", frame(0x82, "x", true, std::uint64_t{1} << 30)},
      {"message of more than a megabyte", frame(0x82, std::string((1 << 20) + 1, 'x'))},
      {"close with half a code", frame(0x88, "x")},
      {"close 999", close_frame(999)},
      {"close 1005", close_frame(1005)},
      {"close 1006", close_frame(1006)},
      {"close 1015", close_frame(1015)},
      {"close 2999", close_frame(2999)},

      {"close with a reason that is not UTF-8", close_frame(1000, "\xff")}};
  for (const auto& [what, bytes] : frames) result.add(what, end_of_socket(address, bytes), broken);
  result.add("close 5000", end_of_socket(address, close_frame(5000)), {"closed 1002", "closed 5000"});
  std::string parts = frame(0x02, std::string(1 << 16, 'x'));
  for (int i = 0; i < 16; ++i) parts += frame(0x00, std::string(1 << 16, 'x'));
  result.add("parts of more than a megabyte", end_of_socket(address, parts), broken);
  std::string pings;
  for (int i = 0; i < 10'000; ++i) pings += frame(0x89, std::string(125, 'x'));
  result.add("10,000 pings", end_of_socket(address, pings + close_frame(1000)), {"closed 1000", "closed"});
  std::string empty = frame(0x01, "");
  for (int i = 0; i < 10'000; ++i) empty += frame(0x00, "");
  result.add("10,000 empty parts", end_of_socket(address, empty), {"open", "closed"});
  return result;
}

AttackResult attack_by_paths(const ServerAddress& address, const fs::path& root, const fs::path& outside) {
  AttackResult result;
  std::ofstream(outside / "secret.obj") << kSecret << "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::error_code exists;
  fs::create_symlink(outside / "secret.obj", root / "link.obj", exists);
  fs::create_directory_symlink(outside, root / "linked", exists);
  fs::create_symlink(outside / "new.path.json", root / "new.path.json", exists);
  const std::string folder = outside.filename().string(), name = "/secret.obj", whole = outside.string();
  std::vector<std::string> paths = {"../" + folder + name,
                                    "./../" + folder + name,
                                    "x/../../" + folder + name,
                                    "linked" + name,
                                    "link.obj",
                                    whole + name,
                                    "file://" + whole + name,
                                    "~/secret.obj",
                                    "..\\" + folder + "\\secret.obj",
                                    "..%2f" + folder + name,
                                    "%2e%2e/" + folder + name,
                                    "%252e%252e%252f" + folder + name,
                                    "..%c0%af" + folder + name,
                                    "....//" + folder + name,
                                    "block.obj/../../" + folder + name,
                                    "/proc/self/environ",
                                    "/etc/passwd",
                                    std::string("../") + std::string(5000, 'a')};
  Client client(address, "a0000000000000000000000000000003");
  client.state();
  client.command("take_control");
  for (std::string path : paths) {
    const auto refused = [&](const char* what, const Json& reply) {
      result.add(what + (" " + path), reply["ok"] ? "done" : "refused", {"refused"});
    };
    refused("open", client.command("open", {{"root", 0}, {"file", path}}));
    refused("files", client.command("files", {{"root", 0}, {"folder", path}}));
    refused("open_path", client.command("open_path", {{"root", 0}, {"file", path}}));
    if (path.find('/') != std::string::npos)
      refused("save", client.command("save", {{"root", 0}, {"file", path + ".path.json"}}));
    refused("open a sample", client.command("open", {{"sample", path}}));
    for (const char* place : {"/", "/api/export/", "/api/"}) {
      const HttpReply reply = get(address, place + path);
      const bool has_leaked = reply.body.find(kSecret) != std::string::npos || reply.body.find("root:") == 0;
      result.add(place + path, has_leaked ? "leaked" : std::to_string(reply.status), {"400", "404"});
    }
  }
  for (const char* file : {"linked/x.path.json", "new.path.json", "../x.path.json"})
    result.add(file, client.command("save", {{"root", 0}, {"file", file}})["ok"] ? "done" : "refused", {"refused"});
  const auto before = fs::last_write_time(root / "block.obj");
  const std::string cut = std::string("block.obj") + '\0' + ".path.json";  // overwrites block.obj if it ends at the NUL
  for (const char* command : {"open", "save", "open_path"})
    result.add("NUL in a file", client.command(command, {{"root", 0}, {"file", cut}})["ok"] ? "done" : "refused",
               {"refused"});
  if (fs::last_write_time(root / "block.obj") != before) result.failures.push_back("an assembly was overwritten");
  result.add("NUL in the target", std::to_string(get(address, "/%00").status), {"400"});
  std::set<std::string> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(outside)) left.insert(entry.path().filename());
  if (left != std::set<std::string>{"secret.obj"}) result.failures.push_back("something was written outside the root");
  return result;
}

AttackResult attack_by_many_connections(const ServerAddress& address, int count) {
  AttackResult result;
  for (int i = 0; i < count; ++i)
    result.add("a request for the page", std::to_string(request(address, "GET", "/").status), {"200"});
  return result;
}

AttackResult attack_by_many_clients(const ServerAddress& address, int count) {
  AttackResult result;
  for (int i = 0; i < count; ++i) {
    char key[33];
    std::snprintf(key, sizeof key, "%032x", i + 1);
    Client client(address, key);
    client.state();
    result.add("a command", client.command("check")["ok"] ? "done" : "refused", {"done"});
    client.drop();
  }
  return result;
}

AttackResult attack_by_large_commands(const ServerAddress& address, int count) {
  AttackResult result;
  Client client(address, "a0000000000000000000000000000004");
  client.state();
  // A megabyte of the JSON that takes most memory.
  std::string values = "[]";
  while (values.size() < 1'000'000) values += ",[]";
  for (int i = 1; i <= count; ++i)
    client.send_text("{\"id\": " + std::to_string(i) + R"(, "command": "check", "x": [)" + values + "]}");
  for (int i = 1; i <= count; ++i)
    result.add("a command of a megabyte", client.reply(static_cast<std::uint64_t>(i))["ok"] ? "done" : "refused",
               {"done", "refused"});
  return result;
}

}  // namespace dismantle::server::testing_client
