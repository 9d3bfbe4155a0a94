// SPDX-License-Identifier: Apache-2.0
// The disk is full, or a folder cannot be written.
#include "dismantle/audit/audit_path.h"
#include "dismantle/documents/path_file.h"
#include "tests/faults/fault_scene.h"
#include "tests/faults/killed_server.h"
#include "tests/support/test_data.h"

#include <csignal>

namespace dismantle::faults {
namespace {

namespace fs = std::filesystem;
using server::Json;
using server::testing_client::Client;

/// Every file ends at 512 bytes, as it would on a disk with no more room.
SpawnOptions full_disk() {
  SpawnOptions limits;
  limits.max_file_bytes = 512;
  return limits;
}

SpawnOptions printing_to(const fs::path& file) {
  SpawnOptions options;
  options.out = file;
  return options;
}

class FullDisk : public FaultScene {};
class UnwritableFolder : public FaultScene {};

/// Commands that write one output, which is added to them.
const std::vector<std::pair<std::vector<std::string>, std::string>> kWriters = {
    {{"convert", "stack.dasm", "-o"}, "a.dasm"},
    {{"convert", "stack.dasm", "-o"}, "a.obj"},
    {{"convert", "stack.dasm", "-o"}, "a.glb"},
    {{"convert", "stack.dasm", "-o"}, "a.stl"},
    {{"convert", "stack.dasm", "-o"}, "a.ply"},
    {{"convert", "stack.dasm", "-o"}, "a_folder"},
    {{"plan", "stack.dasm", "-o"}, "a.path.json"},
    {{"render", "stack.dasm", "-o"}, "a.png"},
    {{"check", "stack.dasm", "--html"}, "a.html"},
    {{"export", "stack.dasm", "stack.path.json", "-o"}, "a.html"},
    {{"export", "stack.dasm", "stack.path.json", "-o"}, "a.glb"},
    {{"export", "stack.dasm", "stack.path.json", "-o"}, "a.pdf"},
    {{"export", "stack.dasm", "stack.path.json", "-o"}, "instructions.html"},
    {{"sample", "lathe", "-o"}, "a.step"}};

TEST_F(FullDisk, IsAnErrorOfEveryCommandThatWrites) {
  for (auto [arguments, output] : kWriters) {
    arguments.push_back("out/" + output);
    SCOPED_TRACE(arguments[0] + " " + output);
    expect_failure(run(arguments, full_disk()), "cannot be written (File too large)");
    EXPECT_EQ(outputs(), FolderContents{});
    EXPECT_TRUE(fs::is_empty(folder_ / "out")) << "nothing half-written is left";
  }
}

TEST_F(FullDisk, LeavesEarlierOutputsAlone) {
  for (auto [arguments, output] : kWriters) {
    if (fs::path(output).extension().empty()) continue;  // folders are never replaced
    arguments.push_back("out/" + output);
    SCOPED_TRACE(arguments[0] + " " + output);
    const FolderContents before = {{output, "earlier\n"}};
    restore(folder_ / "out", before);
    expect_failure(run(arguments, full_disk()), "cannot be written (File too large)");
    EXPECT_EQ(outputs(), before);
  }
}

TEST_F(FullDisk, IsAnErrorOfABatchWhichGoesOnLater) {
  const std::vector<std::string> batch = fault_commands(folder_.path(), "batch")[0].arguments;
  const CommandEnd full = run(batch, full_disk());
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_NE(full.err.find("cannot be written (File too large)"), std::string::npos) << full.err;
  EXPECT_NE(full.err.find("the batch is incomplete (see above); start it again to continue"), std::string::npos)
      << full.err;
  EXPECT_EQ(outputs(), FolderContents{});
  const CommandEnd again = run(batch);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out.find("(done before)"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "out/.batch"));
}

TEST_F(FullDisk, IsAnErrorWhereTheOutputIsPrinted) {
  DISMANTLE_NEED("/dev/full");
  const std::vector<std::vector<std::string>> printers = {{"info", "stack.dasm"},
                                                          {"info", "stack.dasm", "--json"},
                                                          {"check", "stack.dasm", "--json"},
                                                          {"audit", "stack.dasm", "stack.path.json", "--json"},
                                                          {"plan", "--help"},
                                                          {"--version"}};
  for (const std::vector<std::string>& arguments : printers) {
    SCOPED_TRACE(arguments.front() + " " + arguments.back());
    expect_failure(run(arguments, printing_to("/dev/full")),
                   "the standard output cannot be written (No space left on device)");
  }
}

TEST_F(FullDisk, LeavesTheCacheOfModelsWithoutAnEntry) {
  fs::copy_file(fs::path(DISMANTLE_SOURCE_DIR) / "tests/formats/chamfer.step", folder_ / "chamfer.step");
  const std::vector<std::string> info = {"info", "chamfer.step", "--json"};
  const auto entries = [&] {
    std::size_t count = 0;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "cache", ignored))
      count += entry.is_regular_file() ? 1 : 0;
    return count;
  };
  SpawnOptions limits = full_disk();
  limits.out = "/dev/null";
  const CommandEnd full = run(info, limits);
  EXPECT_EQ(full.exit_code, 0) << full.err;
  EXPECT_EQ(full.err, "");
  EXPECT_EQ(entries(), 0u);

  const CommandEnd first = run(info);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(entries(), 1u);
  // What is there is used, whether or not there is room for more.
  EXPECT_EQ(run(info, limits).exit_code, 0);
  EXPECT_EQ(entries(), 1u);
  const CommandEnd again = run(info);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(again.out, first.out);
}

TEST_F(FullDisk, DoesNotTakeTheFileOfACommandThatCannotPrint) {
  DISMANTLE_NEED("/dev/full");
  ASSERT_EQ(run({"convert", "stack.dasm", "-o", "out/whole.dasm"}).exit_code, 0);
  expect_failure(run({"convert", "stack.dasm", "-o", "out/a.dasm"}, printing_to("/dev/full")), "No space left");
  EXPECT_EQ(outputs()["a.dasm"], outputs()["whole.dasm"]);
}

TEST_F(FullDisk, EndsTheJournalOfASessionButNotTheSession) {
  const KilledServer server(folder_ / "viewer");
  KillDice dice(5);
  {
    SpawnOptions limits;
    limits.max_file_bytes = 8192;  // some hundred poses
    const auto viewer = server.start(limits);
    Client client(viewer->address());
    client.state();
    for (std::size_t poses = 0; poses < 300;) poses += drag_randomly(client, dice, 0.2).size();
    const Json log = client.event("log");
    EXPECT_EQ(log["text"],
              "this session is no longer stored (its journal cannot be written: is the disk full?); save "
              "the recording");
    EXPECT_TRUE(client.command("release")["ok"]);
    EXPECT_GT(drag_randomly(client, dice, 0.05).size(), 1u) << "the session goes on";
    const Json saved = client.command("save", {{"root", 0}, {"file", "full.path.json"}});
    EXPECT_FALSE(saved["ok"]) << saved;
    EXPECT_FALSE(fs::exists(server.folder() / "root/full.path.json"));
    viewer->end(SIGKILL);
  }
  const auto viewer = server.start();
  Client client(viewer->address());
  EXPECT_TRUE(client.state()["resumed"]);
  const Result<Path> path =
      parse_path(server::testing_client::get(viewer->address(), "/api/path.json").body, "recording");
  ASSERT_TRUE(path.ok());
  std::size_t frames = 0;
  for (const Move& move : path->moves) frames += move.frames.size();
  EXPECT_GT(frames, 50u) << "what was stored before the disk was full";
  EXPECT_TRUE(audit_path(server.assembly(), *path).holds());
}

TEST_F(UnwritableFolder, IsAnErrorOfEveryCommandThatWrites) {
  folder_.put("a_file", "not a folder");
  for (auto [arguments, output] : kWriters) {
    arguments.push_back("a_file/" + output);
    SCOPED_TRACE(arguments[0] + " " + output);
    expect_failure(run(arguments), "cannot be written (Not a directory");
  }
  for (const std::string output : {"/proc/a.dasm", "/proc/a_folder", "missing/a.dasm", "missing/a_folder"})
    expect_failure(run({"convert", "stack.dasm", "-o", output}), output + " cannot be written (");
  EXPECT_EQ(bytes_of(folder_ / "a_file"), "not a folder");
}

TEST_F(UnwritableFolder, OfTheCacheDoesNotMatter) {
  const FaultCommand import = fault_commands(folder_.path(), "import")[0];
  folder_.put("cache", "not a folder");
  for (int k = 0; k < 2; ++k) {
    const CommandEnd end = run(import.arguments);
    EXPECT_EQ(end.exit_code, 0) << end.err;
    EXPECT_EQ(end.err, "");
  }
}

TEST_F(UnwritableFolder, OfTheJournalIsSaidByTheViewerWhichGoesOn) {
  const KilledServer server(folder_ / "viewer");
  folder_.put("viewer/state", "not a folder");
  const auto viewer = server.start();
  Client client(viewer->address());
  client.state();
  const std::string text = client.event("log")["text"];
  EXPECT_NE(text.find("cannot be written (Not a directory); a crash would lose this session"), std::string::npos)
      << text;
  KillDice dice(6);
  EXPECT_GT(drag_randomly(client, dice, 0.05).size(), 1u);
}

}  // namespace
}  // namespace dismantle::faults
