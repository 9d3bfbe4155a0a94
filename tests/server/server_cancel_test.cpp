// SPDX-License-Identifier: Apache-2.0
// Jobs that are cancelled at every stage: nothing is half done, and the next job works.
#include "apps/server/search.h"
#include "dismantle/files/read_file.h"
#include "dismantle/session/timeline.h"
#include "samples/bundled/bundled_sample.h"
#include "tests/planner/plan_scenes.h"
#include "tests/server/server_scene.h"

#include <algorithm>
#include <set>

namespace dismantle::server {
namespace {

namespace fs = std::filesystem;
using testing_client::Client;
using testing_client::get;
using testing_client::HttpReply;
using testing_client::kClientKey;
using testing_client::request;

/// The number of steps that a stage of a plan shows to the user.
std::size_t steps_shown(std::string_view stage) {
  const std::size_t comma = stage.find(", ");
  return comma == std::string_view::npos ? 0 : std::stoul(std::string(stage.substr(comma + 2)));
}

/// Runs a search with cancellation at a report of progress. @return the number of reports
std::size_t search_cancelled_at(const SearchRequest& request, std::size_t cancel_at) {
  std::size_t reports = 0, shown = 0;
  const Result<SearchResult> result = run_search(request, [&](std::string_view stage, double) {
    if (reports <= cancel_at) shown = steps_shown(stage);
    EXPECT_LE(shown, request.snapshot->assembly.components.size()) << stage;
    return ++reports <= cancel_at;
  });
  const bool is_cancelled = reports > cancel_at;
  if (!result) {
    EXPECT_TRUE(is_cancelled);
    EXPECT_EQ(shown, 0u) << "at report " << cancel_at;
    EXPECT_EQ(result.error().message, "cancelled");
    return reports;
  }
  EXPECT_EQ(result->cancelled, is_cancelled);
  EXPECT_GE(result->steps, shown) << "at report " << cancel_at;
  EXPECT_EQ(result->path.moves.size(), result->steps);
  EXPECT_TRUE(Timeline::of_path(request.snapshot->assembly, result->path).ok());
  EXPECT_TRUE(audit_path(request.snapshot->assembly, result->path).holds()) << "at report " << cancel_at;
  return reports;
}

/// Cancels a plan at some of the reports of a whole one, the first and the last ones among them.
void expect_kept(const Assembly& assembly, const std::vector<ComponentId>& targets, std::size_t samples) {
  const Session session(assembly, *classify_pairs(assembly, {}));
  SearchRequest request;
  request.snapshot = std::make_shared<const SessionSnapshot>(assembled_snapshot(session));
  request.targets = targets;
  const std::size_t all = search_cancelled_at(request, ~std::size_t{0});
  std::set<std::size_t> points = {0, 1, 2, all - 1};
  for (std::size_t i = 0; i < samples; ++i) points.insert(i * all / samples);
  for (const std::size_t point : points) search_cancelled_at(request, point);
}

TEST(CancelledPlan, KeepsTheStepsThatItHasShown) {
  expect_kept(scenes::stack_in_tube(5), {}, 25);
  expect_kept(scenes::framed_dovetail(), {}, 25);
}

TEST(CancelledPlan, KeepsTheStepsThatItHasShownForTargets) {
  expect_kept(scenes::stack_in_tube(5), {ComponentId(3)}, 25);
  expect_kept(scenes::framed_dovetail(), {ComponentId(0)}, 25);
}

/// A server with a folder for temporary files of its own, which must be empty at the end but for what is open.
class ServerCancel : public ServerScene {
 protected:
  ServerCancel() {
    if (const char* before = getenv("TMPDIR")) before_ = before;
    fs::create_directories(temporary());
    setenv("TMPDIR", temporary().c_str(), 1);
  }
  ~ServerCancel() override { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }
  fs::path temporary() const { return folder_ / "tmp"; }

  /// The files of uploads and samples that are on the disk.
  std::size_t stored() const {
    const auto is_file = [](const fs::directory_entry& entry) { return entry.is_regular_file(); };
    return static_cast<std::size_t>(
        std::count_if(fs::recursive_directory_iterator(temporary()), fs::recursive_directory_iterator(), is_file));
  }

  /// Cancels a job after some of its events. @return its last event
  static Json cancelled(Client& client, int job, int events) {
    Json last;
    for (int i = 0; i < events; ++i) {
      last = client.event_where("job", [&](const Json& j) { return j["job"] == job; });
      if (last["status"] != "running") return last;
    }
    const Json reply = client.command("cancel", {{"job", job}});
    last = client.event_where("job", [&](const Json& j) { return j["job"] == job && j["status"] != "running"; });
    EXPECT_TRUE(reply["ok"] || last["status"] == "done") << "only a job that has ended cannot be cancelled";
    return last;
  }

  /// More events than a job has.
  static constexpr int kAll = 1'000'000;
  /// Gives a command that starts a job, and cancels it at several points; then lets it end.
  template <class AtEnd>
  static void cancel_at_all_points(Client& client, const std::string& command, const Json& arguments,
                                   const AtEnd& at_end, const std::vector<int>& points = {0, 1, 2, 3, 5, 8, 13, kAll}) {
    for (const int events : points) {
      const Json reply = client.command(command, arguments);
      ASSERT_TRUE(reply["ok"]) << reply;
      const Json last = cancelled(client, reply["job"], events);
      ASSERT_TRUE(last["status"] == "done" || (last["status"] == "cancelled" && events < kAll)) << last;
      at_end(last);
      if (last["status"] == "done") return;
    }
  }

  std::string before_;
};

TEST_F(ServerCancel, OfAnImportKeepsWhatIsOpen) {
  start_with_block_and_wall();
  Client client(address());
  client.state();
  drag(client, hold(client, 0), {}, {0, 5, 0}, 5);
  client.command("release");
  const std::string before = get(address(), "/api/path.json").body;
  cancel_at_all_points(client, "open", {{"sample", "tooling"}},
                       [&](const Json& last) {
                         if (last["status"] == "done") return;
                         EXPECT_EQ(get(address(), "/api/path.json").body, before);
                         EXPECT_EQ(stored(), 0u);
                         EXPECT_TRUE(client.command("check")["ok"]);
                       },
                       {0, 1, 3, 8, kAll});
  EXPECT_EQ(stored(), 1u) << "it may be opened again";
  const Json opened = client.event_where("model", [](const Json& m) { return m["number"] == 2; });
  EXPECT_EQ(opened["name"], "tooling.step");
  cancel_at_all_points(client, "open_again", {{"units", "cm"}}, [&](const Json&) { EXPECT_EQ(stored(), 1u); },
                       {2, kAll});
  server_.reset();
  EXPECT_TRUE(fs::is_empty(temporary()));
}

TEST_F(ServerCancel, OfASearchKeepsTheStateAndThePlanSoFar) {
  std::filesystem::create_directories(root());
  ASSERT_TRUE(write_assembly(root() / "block.obj", scenes::stack_in_tube(8)).ok());
  start();
  ASSERT_TRUE(server_->open_file(root() / "block.obj").ok());
  Client client(address());
  client.state();
  const Json components = client.state()["components"];
  cancel_at_all_points(client, "why", {{"components", {4}}}, [&](const Json&) {});
  cancel_at_all_points(client, "plan", Json::object(), [&](const Json& last) {
    const Json done = client.command("close_guide");
    EXPECT_TRUE(done["ok"]);
    EXPECT_EQ(client.state()["components"], components) << last;
    const Json search = client.state()["search"];
    EXPECT_TRUE(search.is_null() || search["kind"] == "why") << "what blocks a component is still known";
  });
  cancel_at_all_points(client, "find_path", {{"components", {4}}}, [&](const Json& last) {
    if (last["status"] == "done") return;
    EXPECT_EQ(client.state()["components"], components) << last;
    EXPECT_TRUE(client.state()["automatic"].is_null());
  });
}

TEST_F(ServerCancel, OfInstructionsKeepsThoseMadeBefore) {
  start_with_block_and_wall();
  Client client(address());
  client.state();
  drag(client, hold(client, 0), {}, {0, 40, 0}, 10);
  client.command("release");
  EXPECT_EQ(get(address(), "/api/instructions").status, 404u);
  for (const char* format : {"html", "pdf"}) {
    const HttpReply before = get(address(), "/api/instructions");
    cancel_at_all_points(client, "instructions", {{"format", format}}, [&](const Json& last) {
      if (last["status"] == "done") return;
      const HttpReply now = get(address(), "/api/instructions");
      EXPECT_EQ(now.status, before.status);
      EXPECT_TRUE(now.body == before.body);
    });
    EXPECT_EQ(get(address(), "/api/instructions").status, 200u);
  }
}

TEST_F(ServerCancel, OfAnExportByLeavingKeepsTheNextOne) {
  start_with_block_and_wall();
  Client client(address());
  client.state();
  for (int i = 0; i < 20; ++i) {
    testing_client::RawConnection leaving(address());
    leaving.send("GET /api/export/animation.glb HTTP/1.1\r\nHost: " + address().host() + "\r\nAuthorization: Bearer " +
                 address().token + "\r\n\r\n");
  }
  EXPECT_EQ(get(address(), "/api/export/animation.glb").body.substr(0, 4), "glTF");
}

TEST_F(ServerCancel, OfAnUploadByLeavingLeavesNothing) {
  start_with_block_and_wall();
  Client client(address());
  client.state();
  const std::string mesh = *read_file(root() / "block.obj", 1 << 20);
  for (const std::size_t part : {std::size_t{0}, mesh.size() / 2, mesh.size() - 1}) {
    testing_client::RawConnection leaving(address());
    leaving.send("POST /api/open?name=a.obj HTTP/1.1\r\nHost: " + address().host() + "\r\nAuthorization: Bearer " +
                 address().token + "\r\nX-Client: " + kClientKey +
                 "\r\nContent-Length: " + std::to_string(mesh.size()) + "\r\n\r\n" + mesh.substr(0, part));
    leaving.receive(std::chrono::milliseconds(50));
  }
  for (int tries = 0; tries < 100 && stored() > 0; ++tries) client.idle(std::chrono::milliseconds(20));
  EXPECT_EQ(stored(), 0u);
  EXPECT_EQ(request(address(), "POST", "/api/open?name=a.obj",
                    {{"Authorization", "Bearer " + address().token}, {"X-Client", kClientKey}}, mesh)
                .status,
            202u);
}

}  // namespace
}  // namespace dismantle::server
