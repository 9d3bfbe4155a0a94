// SPDX-License-Identifier: Apache-2.0
#include "apps/server/hub.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace dismantle::server {
namespace {

/// Listens to an engine without a model: there is nothing to hear.
struct DeafListener final : EngineListener {
  void on_pose(std::string) override {}
  void on_event(EngineEvent) override {}
};

/// Files of which there are none; the command `files` has a reply of a given size.
struct FakeCommands final : ServerCommands {
  std::size_t reply_bytes = 10;
  bool knows(std::string_view command) const override { return command == "files"; }
  bool needs_control(std::string_view) const override { return false; }
  Result<Json> execute(const Json&) override { return Json{{"entries", std::string(reply_bytes, 'x')}}; }
};

/// A socket that is dropped when it is sent more texts than there is room for.
class FakeSocket final : public ClientSocket {
 public:
  FakeSocket(Hub& hub, std::string key) : hub_(hub), key_(std::move(key)) { hub_.connect(key_, *this); }
  ~FakeSocket() override { leave(); }
  FakeSocket(const FakeSocket&) = delete;
  FakeSocket& operator=(const FakeSocket&) = delete;

  void send_text(SharedText text) override {
    if (room_ == 0) return leave();
    --room_;
    last_ = std::move(text);
  }
  void send_pose(SharedText) override {}
  void close(CloseReason reason) override { closed_ = reason; }
  void set_room(int room) { room_ = room; }
  const std::string& last() const { return *last_; }
  std::optional<CloseReason> closed() const { return closed_; }

 private:
  void leave() {
    if (std::exchange(is_connected_, false)) hub_.disconnect(key_, *this);
  }

  Hub& hub_;
  std::string key_;
  int room_ = 1'000'000;
  bool is_connected_ = true;
  SharedText last_;
  std::optional<CloseReason> closed_;
};

class HubTest : public testing::Test {
 protected:
  HubTest() { hub_.set_hello({{"event", "hello"}}); }
  static std::string files_command(int id) { return text_of(Json{{"id", id}, {"command", "files"}}); }

  DeafListener listener_;
  Jobs jobs_{[](const JobUpdate&) {}};
  EngineLoop engine_{listener_, *Roots::create({}), {}, jobs_};
  FakeCommands commands_;
  Hub hub_{engine_, commands_, [](const std::function<void()>&) {}};
};

TEST_F(HubTest, OutlivesAClientThatIsDroppedByItsLastMalformedMessage) {
  FakeSocket socket(hub_, "a");
  for (int i = 1; i < 100; ++i) hub_.receive_text("a", "{");
  EXPECT_FALSE(socket.closed());
  socket.set_room(0);
  hub_.receive_text("a", "{");
  EXPECT_FALSE(socket.closed()) << "it is gone already";
  EXPECT_EQ(hub_.client_count(), 0u);
}

TEST_F(HubTest, ClosesTheSocketAfterAHundredMalformedMessages) {
  FakeSocket socket(hub_, "a");
  for (int i = 1; i <= 100; ++i) hub_.receive_binary("a", "x");
  EXPECT_EQ(socket.closed(), CloseReason::Malformed);
}

TEST_F(HubTest, RemembersALimitedNumberOfClientsThatLeft) {
  FakeSocket first(hub_, "first");
  for (int i = 0; i < 2000; ++i) FakeSocket(hub_, "client " + std::to_string(i));
  EXPECT_EQ(hub_.client_count(), 1u);
  EXPECT_LE(hub_.absent_count(), 300u);
  EXPECT_TRUE(hub_.is_in_control("first"));
}

TEST_F(HubTest, ForgetsThoseWhoLeftFirst) {
  FakeSocket controller(hub_, "controller");
  const auto visit = [&](const std::string& key) {
    const FakeSocket socket(hub_, key);
    hub_.receive_text(key, files_command(1));
  };
  visit("old");
  for (int i = 0; i < 2000; ++i) FakeSocket(hub_, "client " + std::to_string(i));
  visit("new");
  FakeSocket back(hub_, "new");
  hub_.receive_text("new", files_command(1));
  EXPECT_NE(back.last().find("xxx"), std::string::npos) << "the reply was kept";
  EXPECT_LE(hub_.replies().bytes(), kReplyOverhead + 100) << "that of the other one was not";
}

TEST_F(HubTest, KeepsALimitedAmountOfReplies) {
  commands_.reply_bytes = std::size_t{1} << 20;
  for (int i = 0; i < 40; ++i) {
    const std::string key = "client " + std::to_string(i);
    FakeSocket socket(hub_, key);
    for (int id = 1; id <= 2; ++id) hub_.receive_text(key, files_command(id));
  }
  EXPECT_LE(hub_.replies().bytes(), std::size_t{64} << 20);
  EXPECT_GE(hub_.replies().bytes(), std::size_t{60} << 20);
}

TEST_F(HubTest, TakesNoJsonThatIsNestedTooDeeply) {
  FakeSocket socket(hub_, "a");
  const auto nested = [](std::size_t depth) {
    return R"({"id": 1, "command": "check", "x": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  hub_.receive_text("a", nested(400'000));
  EXPECT_NE(socket.last().find("was not understood"), std::string::npos);
  hub_.receive_text("a", R"({"id": 1, "command": "files", "x": "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[\"[["})");
  EXPECT_NE(socket.last().find("xxx"), std::string::npos) << "these are only text";
}

TEST(ReplyStore, ForgetsTheOldestFirst) {
  ReplyStore store({3, 4 * kReplyOverhead + 1000});
  const auto text = [](std::size_t size) { return std::make_shared<const std::string>(size, 'x'); };
  for (std::uint64_t id = 1; id <= 4; ++id) store.add_pending("a", id);
  EXPECT_FALSE(store.find("a", 1)) << "one more than a client may have";
  EXPECT_EQ(store.find("a", 2), SharedText()) << "pending";
  store.set("a", 2, text(900));
  store.add_pending("b", 7);
  store.set("b", 7, text(500));
  EXPECT_FALSE(store.find("a", 2));
  EXPECT_TRUE(store.find("a", 3));
  EXPECT_EQ((*store.find("b", 7))->size(), 500u);
  store.set("a", 2, text(10));  // no longer there
  store.forget("b");
  EXPECT_FALSE(store.find("b", 7));
  store.forget("a");
  EXPECT_EQ(store.bytes(), 0u);
}

}  // namespace
}  // namespace dismantle::server
