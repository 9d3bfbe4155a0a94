// SPDX-License-Identifier: Apache-2.0
// Files that are opened together, over a real socket.
#include "tests/server/server_scene.h"

#include "dismantle/files/read_file.h"

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::HttpReply;
using testing_client::kClientKey;
using testing_client::request;

using Files = std::vector<std::pair<std::string, std::string>>;

std::string packed(const Files& files) {
  std::string body;
  for (const auto& [path, bytes] : files) body += Json{{"path", path}, {"bytes", bytes.size()}}.dump() + "\n" + bytes;
  return body;
}

class ServerUpload : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }
  HttpReply post(const std::string& name, const std::string& body) const {
    return request(address(), "POST", "/api/open_files?name=" + name,
                   {{"Authorization", "Bearer " + address().token}, {"X-Client", kClientKey}}, body);
  }
  /// The model that is open after files were uploaded.
  Json opened(Client& client, const std::string& name, const Files& files) const {
    client.state();  // the block is open
    const HttpReply reply = post(name, packed(files));
    EXPECT_EQ(reply.status, 202u) << reply.body;
    const int job = Json::parse(reply.body).value("job", 0);
    const Json last =
        client.event_where("job", [&](const Json& j) { return j["job"] == job && j["status"] != "running"; });
    EXPECT_EQ(last["status"], "done") << last;
    return client.event_where("model", [](const Json& m) { return m["name"] != "block.obj"; });
  }
  std::string cube(const std::string& name) const {
    const std::filesystem::path file = folder_ / (name + ".obj");
    const Assembly assembly = scenes::assembly({scenes::component(name, scenes::box({0, 0, 0}, {10, 10, 10}))});
    EXPECT_TRUE(write_assembly(file, assembly).ok());
    return *read_file(file, 1 << 20);
  }
};

TEST_F(ServerUpload, OpensMeshesOfAFolder) {
  Client client(address());
  const Json model =
      opened(client, "vice", {{"vice/a.obj", cube("a")}, {"vice/b.obj", cube("b")}, {"vice/c.obj", cube("c")}});
  EXPECT_EQ(model["name"], "vice");
  EXPECT_EQ(model["components"].size(), 3u);
  EXPECT_EQ(model["components"][2]["shape"], 0);
}

TEST_F(ServerUpload, OpensAUrdfWithItsMeshes) {
  const std::string urdf =
      "<robot name=\"arm\"><link name=\"base\"><visual><geometry><mesh filename=\"../meshes/base.obj\"/></geometry>"
      "</visual></link></robot>";
  Client client(address());
  const Json model = opened(client, "arm", {{"arm/urdf/arm.urdf", urdf}, {"arm/meshes/base.obj", cube("base")}});
  EXPECT_EQ(model["name"], "arm.urdf");
  EXPECT_EQ(model["components"].size(), 1u);
}

TEST_F(ServerUpload, RefusesWhatIsMalformedOrNotClear) {
  Client client(address());
  client.state();
  const std::string mesh = cube("a");
  for (const Files& files :
       {Files{}, Files{{"../a.obj", mesh}}, Files{{"/etc/a.obj", mesh}}, Files{{"x/../../a.obj", mesh}},
        Files{{".bashrc", mesh}}, Files{{"", mesh}}, Files{{"a.txt", mesh}}, Files{{"a.urdf", "x"}, {"b.urdf", "x"}},
        Files{{"x/a.obj", mesh}, {"y/b.obj", mesh}}}) {
    const HttpReply reply = post("", packed(files));
    EXPECT_EQ(reply.status, 409u) << reply.body;
  }
  for (const std::string& body : {std::string("no JSON\n"), std::string("{\"path\": 7, \"bytes\": 1}\nx"),
                                  std::string("{\"path\": \"a.obj\", \"bytes\": 99}\nx"),
                                  std::string("{\"path\": \"a.obj\", \"bytes\": -1}\nx"), std::string(10000, '{')})
    EXPECT_EQ(post("", body).status, 409u) << body.substr(0, 40);
  EXPECT_EQ(client.state()["components"].size(), 2u);
}

}  // namespace
}  // namespace dismantle::server
