// SPDX-License-Identifier: Apache-2.0
// Attacks on the server, after each of which it must respond as before.
#include "dismantle/files/read_file.h"
#include "samples/bundled/bundled_sample.h"
#include "tests/server/server_scene.h"

#include <fstream>
#include <random>
#include <thread>

namespace dismantle::server {
namespace {

TEST_F(ServerScene, TellsTheFirstPageWhyAFileWasNotOpenedBeforeItCame) {
  start();
  std::ofstream(root() / "broken.step") << "this is no STEP file";
  ASSERT_TRUE(server_->open_file(root() / "broken.step").ok());
  std::this_thread::sleep_for(std::chrono::seconds(2));
  testing_client::Client client(address());
  // On a busy machine the file may be read still.
  const Json job = client.event_where("job", [](const Json& j) { return j["status"] != "running"; });
  ASSERT_EQ(job["status"], "failed");
  EXPECT_NE(job["error"].get<std::string>().find("broken.step"), std::string::npos) << job;
}

namespace fs = std::filesystem;
using testing_client::Client;
using testing_client::exchange;
using testing_client::Headers;
using testing_client::HttpReply;
using testing_client::kClientKey;
using testing_client::request;

class ServerRobustness : public ServerScene {
 protected:
  void SetUp() override {
    ServerOptions options;
    options.idle_time = std::chrono::minutes(10);  // no client is dropped for silence
    start_with_block_and_wall(std::move(options));
  }
  void TearDown() override { expect_alive(); }

  /// Expects that a new client can drag as usual.
  void expect_alive() const {
    Client client(address(), "aaaaaaaaaaaaaaaabbbbbbbbbbbbbbbb");
    ASSERT_EQ(client.status(), 101u);
    client.state();
    ASSERT_TRUE(client.command("take_control")["ok"]);
    ASSERT_TRUE(client.command("check")["ok"]);
    const std::uint32_t grip = hold(client, 0);
    client.send_binary(target_at(grip, 1, {-1, 0, 0}));
    EXPECT_EQ(client.pose_for_target(1).pose.position.x, -1);
    EXPECT_TRUE(client.command("release")["ok"]);
  }

  /// Uploads a file as the client in control, and waits for the result.
  Json upload(Client& client, const std::string& name, const std::string& bytes) const {
    const HttpReply reply = request(address(), "POST", "/api/open?name=" + name,
                                    {{"Authorization", "Bearer " + address().token}, {"X-Client", kClientKey}}, bytes);
    EXPECT_EQ(reply.status, 202u) << reply.body;
    return end_of_job(client, Json::parse(reply.body).value("job", 0));
  }

  /// Opens a file by the command `open`, and waits for the result.
  static Json open(Client& client, const Json& what) {
    const Json opened = client.command("open", what);
    EXPECT_TRUE(opened["ok"]) << opened;
    return opened["ok"] ? end_of_job(client, opened["job"]) : opened;
  }

  static Json end_of_job(Client& client, int job) {
    return client.event_where("job", [&](const Json& j) { return j["job"] == job && j["status"] != "running"; });
  }
};

TEST_F(ServerRobustness, AnswersAThousandMalformedFramesWithErrors) {
  std::mt19937 random(7);
  int errors = 0;
  for (int round = 0; round < 20; ++round) {
    Client client(address(), kClientKey);
    client.state();
    for (int i = 0; i < 50; ++i) {  // fewer than the number at which the server closes a socket
      std::string bytes(random() % 200, '\0');
      for (char& c : bytes) c = static_cast<char>(random() % 128);
      if (i % 3 == 0) bytes = target_at(1, 1, {1e300, 0, 0});
      if (i % 7 == 0) bytes = encode(TargetMessage{1, 2, {{}, {9, 9, 9, 9}}});
      i % 2 == 0 ? client.send_binary(bytes) : client.send_text("{\"id\":" + std::to_string(random()));
      client.event("error");
      ++errors;
    }
  }
  EXPECT_EQ(errors, 1000);
}

TEST_F(ServerRobustness, ClosesTheSocketOfWhoSendsNothingElse) {
  Client client(address(), kClientKey);
  client.state();
  for (int i = 0; i < 100 && client.is_open(); ++i) client.send_text("{");
  client.wait_for_end();
  EXPECT_EQ(client.close_code(), 1008u);  // policy violation
}

TEST_F(ServerRobustness, TakesJsonOfAnyKindForNoMoreThanItIs) {
  Client client(address(), kClientKey);
  client.state();
  for (const char* text :
       {"[]", "null", "7", "\"hold\"", "{}", "{\"id\":-1,\"command\":\"undo\"}", "{\"id\":1.5,\"command\":\"undo\"}",
        "{\"id\":1,\"command\":[]}", "{\"id\":1,\"command\":null}"}) {
    client.send_text(text);
    client.event("error");
  }
  std::string deep(100000, '[');
  client.send_text(deep);
  client.event("error");
  for (const Json& wrong : {Json(nullptr), Json(-1), Json("x"), Json::array(), Json::object(), Json(1e300)}) {
    for (const char* command : {"hold", "take_out", "put_back", "play", "seek", "set_response", "open", "files", "save",
                                "open_path", "cancel", "free_directions", "hide"}) {
      const Json reply = client.command(command, {{"components", wrong},
                                                  {"direction", wrong},
                                                  {"speed", wrong},
                                                  {"time", wrong},
                                                  {"response", wrong},
                                                  {"sample", wrong},
                                                  {"root", wrong},
                                                  {"file", wrong},
                                                  {"folder", wrong},
                                                  {"job", wrong},
                                                  {"source", wrong}});
      EXPECT_FALSE(reply["ok"]) << command << wrong;
    }
  }
}

TEST_F(ServerRobustness, TakesNoMessageOfMoreThanAMegabyte) {
  Client client(address(), kClientKey);
  client.state();
  try {
    client.send_text(std::string((1 << 20) + 1, ' '));
  } catch (const std::exception&) {
    // closed while sending
  }
  client.wait_for_end();
  EXPECT_FALSE(client.is_open());
  Client other(address(), kClientKey);
  other.state();
  std::string just_fits = "{\"id\":1000,\"command\":\"check\"}";
  just_fits.resize(1 << 20, ' ');
  other.send_text(just_fits);
  EXPECT_TRUE(other.reply(1000)["ok"]);
}

TEST_F(ServerRobustness, DropsAClientThatDoesNotRead) {
  // A folder whose listing is 200 kB long.
  fs::create_directories(root() / "many");
  for (int i = 1000; i < 1800; ++i)
    std::ofstream(root() / "many" / (std::to_string(i) + std::string(200, 'x') + ".obj"));
  Client slow(address(), kClientKey);
  slow.state();
  Client watcher(address(), "cccccccccccccccccccccccccccccccc");
  watcher.state();
  // Each gets a response; few of them are read, and the server must not keep them all.
  for (int i = 1; i <= 2000 && slow.is_open(); ++i)
    slow.send_text(text_of(Json{{"id", i}, {"command", "files"}, {"root", 0}, {"folder", "many"}}));
  const auto left = [](const Json& c) { return c["clients"] == 1; };
  EXPECT_EQ(watcher.event_where("control", left)["clients"], 1);
}

TEST_F(ServerRobustness, OutlivesBrokenHttp) {
  const std::string host = "Host: " + address().host() + "\r\n";
  for (const std::string& bytes :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(100000, 'A'),
        "GET / HTTP/1.1\r\n" + host + "A: " + std::string(100000, 'x'), "GET / HTTP/9.9\r\n" + host + "\r\n",
        "GET  / HTTP/1.1\r\n" + host + "\r\n",
        "POST /api/open HTTP/1.1\r\n" + host + "Content-Length: 99999999999999999999\r\n\r\n",
        "GET / HTTP/1.1\r\n" + host + host + "\r\n", "GET http://evil/ HTTP/1.1\r\n" + host + "\r\n",
        std::string("\x16\x03\x01\x02\x00", 5)})
    EXPECT_EQ(exchange(address(), bytes).find("HTTP/1.1 200"), std::string::npos) << bytes.substr(0, 60);
}

TEST_F(ServerRobustness, ServesNoMoreConnectionsThanItCan) {
  std::vector<std::unique_ptr<testing_client::RawConnection>> silent;
  for (int i = 0; i < 300; ++i) silent.push_back(std::make_unique<testing_client::RawConnection>(address()));
  EXPECT_THROW(request(address(), "GET", "/"), std::exception);
  silent.clear();
  HttpReply reply;
  for (int tries = 0; tries < 100 && reply.status != 200; ++tries) {
    try {
      reply = request(address(), "GET", "/");
    } catch (const std::exception&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  EXPECT_EQ(reply.status, 200u);
}

TEST_F(ServerRobustness, LeavesNobodyOutsideItsFolders) {
  const fs::path secret = folder_.put("secret/plan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  fs::create_symlink(secret, root() / "link.obj");
  fs::create_directory_symlink(folder_ / "secret", root() / "linked");
  fs::create_symlink("block.obj", root() / "alias.obj");
  Client client(address(), kClientKey);
  client.state();
  for (const std::string& file :
       {std::string("../secret/plan.obj"), std::string("link.obj"), std::string("linked/plan.obj"), secret.string(),
        std::string("./../secret/plan.obj"), std::string("sub/../../secret/plan.obj"), std::string("/etc/passwd"),
        std::string("../../../../etc/passwd"), std::string("block.obj/../../secret/plan.obj")})
    EXPECT_FALSE(client.command("open", {{"root", 0}, {"file", file}})["ok"]) << file;
  for (const std::string& folder :
       {std::string(".."), std::string("linked"), std::string("/"), std::string("../secret")})
    EXPECT_FALSE(client.command("files", {{"root", 0}, {"folder", folder}})["ok"]) << folder;
  EXPECT_FALSE(client.command("save", {{"root", 0}, {"file", "linked/x.path.json"}})["ok"]);
  EXPECT_FALSE(fs::exists(folder_ / "secret/x.path.json"));
  fs::create_symlink(folder_ / "secret/y.path.json", root() / "y.path.json");
  EXPECT_FALSE(client.command("save", {{"root", 0}, {"file", "y.path.json"}})["ok"]);

  const Json list = client.command("files", {{"root", 0}, {"folder", ""}})["entries"];
  std::vector<std::string> names;
  for (const Json& entry : list) names.push_back(entry["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"alias.obj", "block.obj"}));
  EXPECT_EQ(open(client, {{"root", 0}, {"file", "alias.obj"}})["status"], "done");
}

TEST_F(ServerRobustness, OpensAnUploadAndCleansUpBehindIt) {
  Client client(address(), kClientKey);
  client.state();
  const std::string obj = *read_file(root() / "block.obj", 1 << 20);
  EXPECT_EQ(upload(client, "uploaded%20parts.obj", obj)["status"], "done");
  EXPECT_EQ(client.event_where("model", [](const Json& m) { return m["number"] == 2; })["name"], "uploaded parts.obj");
  // It stays for as long as it may be opened again.
  EXPECT_EQ(open(client, {{"root", 0}, {"file", "block.obj"}})["status"], "done");
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::temp_directory_path()))
    for (const char* place : {"", "1", "2"}) EXPECT_FALSE(fs::exists(entry.path() / place / "uploaded parts.obj"));
}

TEST_F(ServerRobustness, OpensTheAssemblyAgainInAnotherUnit) {
  Client client(address(), kClientKey);
  client.state();
  EXPECT_EQ(upload(client, "again.obj", *read_file(root() / "block.obj", 1 << 20))["status"], "done");
  const Json before = client.event_where("model", [](const Json& m) { return m["name"] == "again.obj"; });
  EXPECT_FALSE(client.command("open_again", {{"units", "parsec"}})["ok"]);
  const Json again = client.command("open_again", {{"units", "m"}});
  ASSERT_TRUE(again["ok"]) << again;
  EXPECT_EQ(end_of_job(client, again["job"])["status"], "done");
  const Json after = client.event_where("model", [](const Json& m) { return m["units"] == "m"; });
  EXPECT_EQ(after["name"], "again.obj");
  EXPECT_DOUBLE_EQ(after["bounds"][1][0].get<double>(), 1000 * before["bounds"][1][0].get<double>());
}

TEST_F(ServerRobustness, TakesAnUploadOfMegabytes) {
  Client client(address(), kClientKey);
  client.state();
  const std::string obj = *read_file(root() / "block.obj", 1 << 20) + std::string(std::size_t{3} << 20, '\n');
  EXPECT_EQ(upload(client, "large.obj", obj)["status"], "done");
}

TEST_F(ServerRobustness, RefusesAnUploadThatIsTooLargeBeforeItHasCome) {
  Client client(address(), kClientKey);
  client.state();
  const std::string head = " HTTP/1.1\r\nHost: " + address().host() + "\r\nAuthorization: Bearer " + address().token +
                           "\r\nX-Client: " + kClientKey + "\r\nContent-Length: ";
  for (const std::string target : {"/api/open?name=a.obj", "/api/guide?name=a.path.json"})
    for (const std::string length : {"1073741825", "9999999999999"}) {
      const std::string request = "POST " + target + head + length + "\r\n\r\nv 0 0 0";
      EXPECT_EQ(testing_client::exchange(address(), request).substr(0, 12), "HTTP/1.1 413") << target << " " << length;
    }
}

TEST_F(ServerRobustness, RefusesUploadsOfOthersAndWithoutAName) {
  Headers headers{{"Authorization", "Bearer " + address().token}};
  EXPECT_EQ(request(address(), "POST", "/api/open?name=a.obj", headers, "v").status, 403u)
      << "nobody is in control yet";
  Client client(address(), kClientKey);
  client.state();
  EXPECT_EQ(request(address(), "POST", "/api/open?name=a.obj", headers, "v").status, 403u);
  headers["X-Client"] = "somebody";
  EXPECT_EQ(request(address(), "POST", "/api/open?name=a.obj", headers, "v").status, 403u);
  headers["X-Client"] = kClientKey;
  EXPECT_EQ(request(address(), "POST", "/api/open", headers, "v").status, 400u);
  EXPECT_EQ(request(address(), "POST", "/api/open?name=..", headers, "v").status, 400u);
  EXPECT_EQ(request(address(), "POST", "/api/open?name=.bashrc", headers, "v").status, 400u);
  EXPECT_EQ(request(address(), "POST", "/api/elsewhere?name=a", headers, "v").status, 404u);
  EXPECT_EQ(request(address(), "POST", "/api/guide?name=a.path.json", headers, "{\"format\": 7}").status, 422u);
}

TEST_F(ServerRobustness, OutlivesHostileFiles) {
  Client client(address(), kClientKey);
  client.state();
  // A buffer and an accessor that claim 10 GB.
  const std::string claims =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":10000000000,"uri":"data:application/octet-stream;base64,AAAA"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":10000000000}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":800000000}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]})";
  Json job = upload(client, "huge.gltf", claims);
  EXPECT_EQ(job["status"], "failed");
  EXPECT_NE(job["error"], "");
  // Truncated STEP, nonsense, and a real file with scrambled references.
  std::string step = *bundled_sample_step("tooling");
  EXPECT_EQ(upload(client, "cut.step", step.substr(0, step.size() / 2))["status"], "failed");
  EXPECT_EQ(upload(client, "nonsense.step", std::string(1 << 16, '('))["status"], "failed");
  std::mt19937 random(3);
  const std::size_t data = step.find("DATA;");
  for (int i = 0; i < 4000; ++i) {
    char& c = step[data + random() % (step.size() - data - 100)];
    if (c >= '0' && c <= '9') c = static_cast<char>('0' + random() % 10);
  }
  upload(client, "scrambled.step", step);  // any result
  EXPECT_EQ(upload(client, "program.exe", "MZ")["status"], "failed");
  // Back to the scene of expect_alive().
  EXPECT_EQ(open(client, {{"root", 0}, {"file", "block.obj"}})["status"], "done");
}

TEST_F(ServerRobustness, CancelsAnImport) {
  Client client(address(), kClientKey);
  client.state();
  const Json job = client.command("open", {{"sample", "lathe"}});
  ASSERT_TRUE(job["ok"]) << job;
  EXPECT_FALSE(client.command("open", {{"sample", "robot"}})["ok"]);  // one at a time
  ASSERT_TRUE(client.command("cancel", {{"job", job["job"]}})["ok"]);
  EXPECT_EQ(end_of_job(client, job["job"])["status"], "cancelled");
  EXPECT_FALSE(client.command("cancel", {{"job", job["job"]}})["ok"]);
}

TEST_F(ServerRobustness, RemembersRecentFilesBelowItsRoots) {
  Client client(address(), kClientKey);
  client.state();
  const Json recent = client.command("recent");
  ASSERT_EQ(recent["recent"].size(), 1u) << recent;
  EXPECT_EQ(recent["recent"][0]["name"], "block.obj");
  EXPECT_EQ(open(client, {{"recent", 0}})["status"], "done");
  EXPECT_FALSE(client.command("open", {{"recent", 5}})["ok"]);
}

}  // namespace
}  // namespace dismantle::server
