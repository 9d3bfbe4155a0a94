// SPDX-License-Identifier: Apache-2.0
// Files that are opened together, over a real socket.
#include "tests/server/server_scene.h"

#include "dismantle/files/read_file.h"

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::HttpReply;
using testing_client::kClientKey;
using testing_client::RawConnection;
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

/// A tetrahedron with edges of 10 mm, in COLLADA.
std::string collada_tetrahedron() {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>"
         "<asset><unit meter='0.001'/></asset><library_geometries><geometry id='g'><mesh><source id='p'>"
         "<float_array id='pa' count='12'>0 0 0 10 0 0 0 10 0 0 0 10</float_array><technique_common>"
         "<accessor source='#pa' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/>"
         "<param name='Z' type='float'/></accessor></technique_common></source><vertices id='v'>"
         "<input semantic='POSITION' source='#p'/></vertices><triangles count='4'>"
         "<input semantic='VERTEX' source='#v' offset='0'/><p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id='s'><node><instance_geometry url='#g'/></node>"
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

TEST_F(ServerUpload, OpensAUrdfWithColladaMeshesAndSeveralVisuals) {
  if (const Result<Assembly> alone = load_assembly(folder_.put("alone.dae", collada_tetrahedron())); !alone) {
    ASSERT_NE(alone.error().message.find("built without Assimp"), std::string::npos) << alone.error().message;
    GTEST_SKIP() << "there is no Assimp";
  }
  const auto visual = [](const std::string& mesh, const std::string& rgba) {
    return "<visual><geometry><mesh filename=\"package://arm/meshes/" + mesh +
           "\"/></geometry><material name=\"\"><color rgba=\"" + rgba + "\"/></material></visual>";
  };
  const std::string urdf = "<robot name=\"arm\"><link name=\"base\">" + visual("servo.dae", "0 0 0 1") +
                           visual("servo.dae", "1 1 0 1") + visual("plate.obj", "1 0 0 1") + "</link></robot>";
  Client client(address());
  const Json model = opened(client, "arm",
                            {{"arm/urdf/arm.urdf", urdf},
                             {"arm/meshes/servo.dae", collada_tetrahedron()},
                             {"arm/meshes/plate.obj", cube("plate")}});
  EXPECT_EQ(model["name"], "arm.urdf");
  ASSERT_EQ(model["components"].size(), 3u);
  EXPECT_EQ(model["components"][1]["name"], "servo#2");
}

TEST_F(ServerUpload, RefusesMoreFoldersThanFiles) {
  // Each file has 100 folders of its own.
  std::string deep;
  for (int i = 0; i < 99; ++i) deep += "/d";
  Files files;
  for (int i = 0; i < 300; ++i) files.emplace_back(std::to_string(i) + deep + "/a.obj", "");
  Client client(address());
  client.state();
  const HttpReply reply = post("", packed(files));
  EXPECT_EQ(reply.status, 409u);
  EXPECT_NE(reply.body.find("too many files and folders"), std::string::npos) << reply.body;
}

TEST_F(ServerUpload, RefusesWhatIsMalformedOrNotClear) {
  Client client(address());
  client.state();
  const std::string mesh = cube("a");
  for (const Files& files :
       {Files{}, Files{{"../a.obj", mesh}}, Files{{"/etc/a.obj", mesh}}, Files{{"x/../../a.obj", mesh}},
        Files{{".bashrc", mesh}}, Files{{std::string("a.obj\0.txt", 10), mesh}}, Files{{"", mesh}},
        Files{{"a.txt", mesh}}, Files{{"a.urdf", "x"}, {"b.urdf", "x"}}, Files{{"x/a.obj", mesh}, {"y/b.obj", mesh}}}) {
    const HttpReply reply = post("", packed(files));
    EXPECT_EQ(reply.status, 409u) << reply.body;
  }
  for (const std::string& body : {std::string("no JSON\n"), std::string("{\"path\": 7, \"bytes\": 1}\nx"),
                                  std::string("{\"path\": \"a.obj\", \"bytes\": 99}\nx"),
                                  std::string("{\"path\": \"a.obj\", \"bytes\": -1}\nx"), std::string(10000, '{')})
    EXPECT_EQ(post("", body).status, 409u) << body.substr(0, 40);
  EXPECT_EQ(client.state()["components"].size(), 2u);
}

/// A client may upload 100 kB, and all together 150 kB.
class ServerUploadLimits : public ServerScene {
 protected:
  void SetUp() override {
    ServerOptions options;
    options.uploads = {100'000, 150'000, 0};
    start_with_block_and_wall(std::move(options));
  }
  /// The start of an upload as it goes over the socket.
  std::string head(std::size_t bytes, const std::string& target = "/api/open?name=a.obj",
                   const std::string& key = kClientKey) const {
    return "POST " + target + " HTTP/1.1\r\nHost: " + address().host() + "\r\nAuthorization: Bearer " +
           address().token + "\r\nX-Client: " + key + "\r\nContent-Length: " + std::to_string(bytes) + "\r\n\r\n";
  }
  std::string refusal(const std::string& request) const {
    const std::string reply = testing_client::exchange(address(), request);
    return reply.substr(0, 12) == "HTTP/1.1 507" ? reply : "";
  }
};

TEST_F(ServerUploadLimits, HoldBeforeAnythingIsSent) {
  Client client(address());
  client.state();
  EXPECT_NE(refusal(head(100'001)).find("the uploads of this page would take more than"), std::string::npos);
  EXPECT_NE(refusal(head(50'001, "/api/open_files?name=a")), "") << "it is there twice while it is unpacked";
  RawConnection open(address());
  open.send(head(90'000) + "v 0 0 0\n");
  EXPECT_EQ(open.receive(), "") << "it waits for the rest";
  EXPECT_NE(refusal(head(20'000)), "");
  const std::string other = "ffeeddccbbaa99887766554433221100";
  Client second(address(), other);
  second.state();
  ASSERT_TRUE(second.command("take_control")["ok"]);
  EXPECT_NE(refusal(head(70'000, "/api/open?name=a.obj", other)).find("all uploads together"), std::string::npos);
}

TEST_F(ServerUploadLimits, AreToldToAClientThatSendsOn) {
  Client client(address());
  client.state();
  const HttpReply reply = request(address(), "POST", "/api/open?name=a.obj",
                                  {{"Authorization", "Bearer " + address().token}, {"X-Client", kClientKey}},
                                  std::string(std::size_t{50} << 20, '\n'));
  EXPECT_EQ(reply.status, 507u);
}

TEST_F(ServerUploadLimits, AreReleasedWhenTheClientLeaves) {
  Client client(address());
  client.state();
  {
    RawConnection open(address());
    open.send(head(90'000) + "v 0 0 0\n");
    open.receive();
  }
  bool is_free = false;
  for (int tries = 0; tries < 100 && !is_free; ++tries) {
    RawConnection again(address());
    again.send(head(90'000));
    is_free = again.receive(std::chrono::milliseconds(50)).empty();
  }
  EXPECT_TRUE(is_free);
}

TEST_F(ServerUploadLimits, LetsOneUploadFollowAnother) {
  Client client(address());
  client.state();
  const std::string mesh = *read_file(root() / "block.obj", 1 << 20) + std::string(40'000, '\n');
  for (int i = 0; i < 5; ++i) {
    const HttpReply reply = request(address(), "POST", "/api/open?name=a.obj",
                                    {{"Authorization", "Bearer " + address().token}, {"X-Client", kClientKey}}, mesh);
    ASSERT_EQ(reply.status, 202u) << reply.body;
    const int job = Json::parse(reply.body).value("job", 0);
    const auto is_over = [&](const Json& j) { return j["job"] == job && j["status"] != "running"; };
    EXPECT_EQ(client.event_where("job", is_over)["status"], "done");
  }
}

TEST_F(ServerUploadLimits, TakeNoUploadWithoutALength) {
  Client client(address());
  client.state();
  std::string chunked = head(0);
  chunked.replace(chunked.find("Content-Length: 0"), 17, "Transfer-Encoding: chunked");
  EXPECT_EQ(testing_client::exchange(address(), chunked + "1\r\nv\r\n").substr(0, 12), "HTTP/1.1 411");
}

}  // namespace
}  // namespace dismantle::server
