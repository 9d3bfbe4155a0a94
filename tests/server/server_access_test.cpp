// SPDX-License-Identifier: Apache-2.0
// Access rules: docs/wire.md.
#include "tests/server/server_scene.h"

#include <cstdio>
#include <fstream>
#include <set>
#include <tuple>

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::get;
using testing_client::Headers;
using testing_client::HttpReply;
using testing_client::request;

class ServerAccess : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }
  Headers bearer() const { return {{"Authorization", "Bearer " + address().token}}; }
};

TEST_F(ServerAccess, GivesThePageToWhoeverIsOnThisMachine) {
  const HttpReply reply = request(address(), "GET", "/");
  EXPECT_EQ(reply.status, 200u);
  EXPECT_EQ(reply.headers.at("Content-Type"), "text/html; charset=utf-8");
  EXPECT_NE(reply.body.find("<html"), std::string::npos);
}

TEST_F(ServerAccess, SendsSecurityHeadersWithEveryResponse) {
  for (const char* target : {"/", "/nothing.js", "/api/model.glb"}) {
    const HttpReply reply = request(address(), "GET", target);
    EXPECT_EQ(reply.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(reply.headers.at("Cross-Origin-Opener-Policy"), "same-origin");
    EXPECT_EQ(reply.headers.at("Cross-Origin-Embedder-Policy"), "require-corp");
    EXPECT_NE(reply.headers.at("Content-Security-Policy").find("default-src 'self'"), std::string::npos);
  }
}

TEST_F(ServerAccess, AnswersAWrongHostWith421BeforeAnythingElse) {
  for (const char* target : {"/", "/api/model.glb", "/session?client=00112233445566778899aabbccddeeff"}) {
    Headers headers = bearer();
    headers["Host"] = "rebound.example:" + std::to_string(address().port);
    EXPECT_EQ(request(address(), "GET", target, headers).status, 421u) << target;
  }
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Host", "evil.example"}}).status(), 421u);
}

TEST_F(ServerAccess, AnswersAnotherOriginWith403) {
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Origin", "http://evil.example"}}).status(), 403u);
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Origin", ""}}).status(), 403u);
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Origin", "http://127.0.0.1:1"}}).status(), 403u);
  Headers headers = bearer();
  headers["Origin"] = "http://evil.example";
  EXPECT_EQ(request(address(), "GET", "/api/path.json", headers).status, 403u);
}

TEST_F(ServerAccess, AnswersNoTokenWith401) {
  EXPECT_EQ(request(address(), "GET", "/api/path.json").status, 401u);
  EXPECT_EQ(request(address(), "GET", "/api/path.json", {{"Authorization", "Bearer 0"}}).status, 401u);
  EXPECT_EQ(request(address(), "POST", "/api/open?name=a.stl", {}, "solid").status, 401u);
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Sec-WebSocket-Protocol", "dismantle.1"}}).status(), 401u);
  const std::string wrong = "dismantle.1, token." + std::string(32, '0');
  EXPECT_EQ(Client(address(), testing_client::kClientKey, {{"Sec-WebSocket-Protocol", wrong}}).status(), 401u);
}

TEST_F(ServerAccess, LetsInWhoHasAllThree) {
  Client client(address());
  EXPECT_EQ(client.status(), 101u);
  EXPECT_EQ(client.protocol(), "dismantle.1");
  EXPECT_EQ(client.event("hello")["roots"].size(), 1u);
  client.state();
  EXPECT_EQ(get(address(), "/api/path.json").status, 200u);
}

TEST_F(ServerAccess, GivesExportsOfWhatIsOpenToWhoeverHasTheToken) {
  Client client(address());
  client.state();
  EXPECT_EQ(request(address(), "GET", "/api/export/animation.glb").status, 401u);
  const HttpReply glb = get(address(), "/api/export/animation.glb");
  EXPECT_EQ(glb.status, 200u);
  EXPECT_EQ(glb.body.substr(0, 4), "glTF");
  const HttpReply page = get(address(), "/api/export/page.html?reverse=1");
  EXPECT_EQ(page.status, 200u);
  EXPECT_EQ(page.body.find("<!DOCTYPE html>"), 0u);
  EXPECT_EQ(page.headers.at("Content-Type"), "application/octet-stream") << "it is downloaded, never displayed";
  EXPECT_NE(get(address(), "/api/export/bom.csv").body.find(",block,"), std::string::npos);
  EXPECT_EQ(Json::parse(get(address(), "/api/export/bom.json").body)["items"].size(), 2u);
}

TEST_F(ServerAccess, NamesDownloadsAfterFilesOfAnyName) {
  const std::string disposition = "Content-Disposition";
  Client client(address());
  client.state();
  EXPECT_EQ(get(address(), "/api/path.json").headers.at(disposition), "attachment; filename=\"block.path.json\"");
  for (const auto& [name, ascii, encoded] :
       {std::tuple("a\"; x=y \\.obj", "a_; x=y _", "a%22%3B%20x%3Dy%20%5C"),
        std::tuple("Getriebegeh\u00e4use 100%.obj", "Getriebegeh__use 100_", "Getriebegeh%C3%A4use%20100%25"),
        std::tuple("a\r\nSet-Cookie: b.obj", "a__Set-Cookie: b", "a__Set-Cookie%3A%20b")}) {
    std::filesystem::copy_file(root() / "block.obj", root() / name);
    ASSERT_TRUE(server_->open_file(root() / name).ok());
    client.event_where("job", [](const Json& j) { return j["job"] > 1 && j["status"] == "done"; });
    const HttpReply reply = get(address(), "/api/path.json");
    EXPECT_EQ(reply.headers.at(disposition), std::string("attachment; filename=\"") + ascii +
                                                 ".path.json\"; filename*=UTF-8''" + encoded + ".path.json");
    EXPECT_EQ(reply.headers.count("Set-Cookie"), 0u);
  }
}

TEST_F(ServerAccess, SaysWhyItHasNoExport) {
  Client client(address());
  client.state();
  for (const char* file : {"moves.csv", "path.json"}) {
    const HttpReply reply = get(address(), std::string("/api/export/") + file);
    EXPECT_EQ(reply.status, 409u) << file;
    EXPECT_NE(reply.body.find("nothing was moved yet"), std::string::npos) << reply.body;
  }
  EXPECT_EQ(get(address(), "/api/export/moves.csv?source=guide").status, 409u);
  EXPECT_EQ(get(address(), "/api/export/secrets.txt").status, 404u);
  EXPECT_EQ(get(address(), "/api/export/").status, 404u);
}

TEST_F(ServerAccess, CountsWhatItRefused) {
  request(address(), "GET", "/api/path.json");
  Client client(address());
  client.state();
  EXPECT_EQ(client.command("metrics")["refused"], 1);
}

TEST_F(ServerAccess, RefusesClientsWithoutAKey) {
  for (const char* key : {"", "short", "0011223344556677889g", "../../../../../../etc"})
    EXPECT_EQ(Client(address(), key).status(), 400u) << key;
}

TEST_F(ServerAccess, KnowsNoOtherMethods) {
  EXPECT_EQ(request(address(), "DELETE", "/").status, 405u);
  EXPECT_EQ(request(address(), "PUT", "/index.html").status, 405u);
}

TEST_F(ServerAccess, SendsNoBodyForHead) {
  const std::string head = "HEAD / HTTP/1.1\r\nHost: " + address().host() + "\r\n\r\n";
  const std::string response = testing_client::exchange(address(), head);
  EXPECT_EQ(response.rfind("HTTP/1.1 405 ", 0), 0u) << response;
  EXPECT_NE(response.find("\r\nAllow: GET, POST\r\n"), std::string::npos) << response;
  EXPECT_EQ(response.find("\r\n\r\n") + 4, response.size()) << response;
}

TEST_F(ServerAccess, AnswersAnIncompleteHandshakeAsOtherErrors) {
  const Headers complete{
      {"Origin", address().origin()},  {"Connection", "Upgrade"},
      {"Upgrade", "websocket"},        {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
      {"Sec-WebSocket-Version", "13"}, {"Sec-WebSocket-Protocol", "dismantle.1, token." + address().token}};
  const auto status_without = [&](const char* name, const char* value) {
    Headers headers = complete;
    headers[name] = value;
    const HttpReply reply = request(address(), "GET", "/session?client=" + testing_client::kClientKey, headers);
    EXPECT_EQ(reply.headers.at("Content-Type"), "application/json");
    EXPECT_EQ(reply.headers.at("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(reply.headers.count("Sec-WebSocket-Protocol"), 0u);
    EXPECT_NE(Json::parse(reply.body)["error"].get<std::string>().find("; correct the client"), std::string::npos);
    return reply.status;
  };
  EXPECT_EQ(status_without("Sec-WebSocket-Key", ""), 400u);
  EXPECT_EQ(status_without("Sec-WebSocket-Version", ""), 400u);
  EXPECT_EQ(status_without("Sec-WebSocket-Version", "8"), 426u);
}

TEST_F(ServerAccess, LeadsNowhereOutsideThePage) {
  for (const char* target : {"/../CMakeLists.txt", "/..%2f..%2fetc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
                             "/index.html/../../etc/passwd", "/.git/config"})
    EXPECT_EQ(request(address(), "GET", target).status, 404u) << target;
  EXPECT_EQ(request(address(), "GET", "/%00").status, 400u);
  EXPECT_EQ(request(address(), "GET", "/%zz").status, 400u);
}

TEST_F(ServerAccess, ListensOnTheLoopbackOnly) {
  // The kernel's local addresses in state LISTEN (0A) on our port: only 127.0.0.1 and ::1.
  char port[8];
  std::snprintf(port, sizeof port, ":%04X", address().port);
  std::set<std::string> found;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream in(table);
    std::string slot, local, remote, state, rest;
    while (in >> slot >> local >> remote >> state && std::getline(in, rest))
      if (state == "0A" && local.find(port) != std::string::npos) found.insert(local.substr(0, local.find(':')));
  }
  const std::set<std::string> loopback = {"0100007F", "00000000000000000000000001000000"};
  EXPECT_FALSE(found.empty());
  for (const std::string& local : found) EXPECT_EQ(loopback.count(local), 1u) << local;
}

}  // namespace
}  // namespace dismantle::server
