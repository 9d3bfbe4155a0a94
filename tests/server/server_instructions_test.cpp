// SPDX-License-Identifier: Apache-2.0
// Work instructions for a page, over a real socket.
#include "tests/server/server_scene.h"

namespace dismantle::server {
namespace {

using testing_client::Client;
using testing_client::get;
using testing_client::HttpReply;

class ServerInstructions : public ServerScene {
 protected:
  void SetUp() override { start_with_block_and_wall(); }
  static void move_block(Client& client) {
    client.state();
    const std::uint32_t grip = hold(client, 0);
    drag(client, grip, {}, {0, 40, 0}, 10);
    ASSERT_TRUE(client.command("release")["ok"]);
  }
  static Json make(Client& client, const Json& arguments) {
    const Json reply = client.command("instructions", arguments);
    EXPECT_TRUE(reply["ok"]) << reply;
    return client.event_where("job",
                              [&](const Json& j) { return j["job"] == reply["job"] && j["status"] != "running"; });
  }
};

TEST_F(ServerInstructions, AreAPageOrAPdfWithATitleBlock) {
  Client client(address());
  move_block(client);
  EXPECT_EQ(get(address(), "/api/instructions").status, 404u);
  EXPECT_EQ(make(client, {{"product", "Press"}, {"number", "D-7"}, {"author", "A. Fitter"}})["status"], "done");
  const HttpReply page = get(address(), "/api/instructions");
  EXPECT_EQ(page.status, 200u);
  EXPECT_NE(page.body.find("<h1>Disassembly of Press</h1>"), std::string::npos);
  for (const char* text : {"D-7", "A. Fitter", "size: A4"}) EXPECT_NE(page.body.find(text), std::string::npos) << text;

  make(client, {{"format", "pdf"}, {"paper", "letter"}});
  const HttpReply pdf = get(address(), "/api/instructions");
  EXPECT_EQ(pdf.body.substr(0, 5), "%PDF-");
  EXPECT_EQ(pdf.headers.at("Content-Type"), "application/pdf");
  EXPECT_NE(pdf.body.find("612 792"), std::string::npos);
}

TEST_F(ServerInstructions, NameTheFileAndGoBothWays) {
  Client client(address());
  move_block(client);
  make(client, {{"reverse", true}});
  EXPECT_NE(get(address(), "/api/instructions").body.find("<h1>Assembly of block</h1>"), std::string::npos);
}

TEST_F(ServerInstructions, AreRefusedWithoutMovesOrWithWrongMembers) {
  Client client(address());
  client.state();
  EXPECT_NE(client.command("instructions")["error"].get<std::string>().find("nothing was moved"), std::string::npos);
  move_block(client);
  const std::string long_text(2000, 'x');
  for (const Json& wrong :
       {Json{{"format", "docx"}}, Json{{"paper", "a0"}}, Json{{"reverse", 1}}, Json{{"source", "dream"}},
        Json{{"author", 7}}, Json{{"product", long_text}}, Json{{"source", "guide"}}})
    EXPECT_FALSE(client.command("instructions", wrong)["ok"]) << wrong;
}

TEST_F(ServerInstructions, AreForgottenWithTheAssembly) {
  Client client(address());
  move_block(client);
  make(client, {});
  EXPECT_EQ(get(address(), "/api/instructions").status, 200u);
  ASSERT_TRUE(client.command("open_again", {{"units", "cm"}})["ok"]);
  client.event_where("model", [](const Json& m) { return m["units"] == "cm"; });
  EXPECT_EQ(get(address(), "/api/instructions").status, 404u);
}

}  // namespace
}  // namespace dismantle::server
