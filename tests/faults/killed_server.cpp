// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/killed_server.h"

#include "dismantle/audit/audit_path.h"
#include "dismantle/documents/path_file.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/write_assembly.h"
#include "tests/faults/folder_contents.h"
#include "tests/faults/killed_command.h"
#include "tests/planner/plan_scenes.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

namespace dismantle::faults {

namespace fs = std::filesystem;
using server::Json;
using server::testing_client::Client;
using server::testing_client::SpawnOptions;
using server::testing_client::ViewerProcess;

namespace {

constexpr std::uint32_t kHighestBox = 3;  ///< Component of the stack; the tube is 0.
constexpr double kSameNumber = 1e-9;
constexpr double kDragSeconds = 1;

bool are_equal(const Pose& a, const Pose& b) {
  const Quat &p = a.rotation, &q = b.rotation;
  return max_abs(a.position - b.position) < kSameNumber && std::abs(p.w - q.w) < kSameNumber &&
         std::abs(p.x - q.x) < kSameNumber && std::abs(p.y - q.y) < kSameNumber && std::abs(p.z - q.z) < kSameNumber;
}

/// A thread that sends SIGKILL after some time.
class Killer {
 public:
  Killer(ViewerProcess& viewer, double seconds, bool whole_group)
      : thread_([this, &viewer, seconds, whole_group] {
          std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
          killed_ = std::chrono::steady_clock::now();
          whole_group ? viewer.program().signal_group(SIGKILL) : viewer.program().signal(SIGKILL);
        }) {}
  ~Killer() { wait(); }
  Killer(const Killer&) = delete;
  Killer& operator=(const Killer&) = delete;
  /// Waits for the kill. @return when it was
  std::chrono::steady_clock::time_point wait() {
    if (thread_.joinable()) thread_.join();
    return killed_;
  }

 private:
  std::chrono::steady_clock::time_point killed_;
  std::thread thread_;
};

std::string recording_of(const ViewerProcess& viewer) {
  return server::testing_client::get(viewer.address(), "/api/path.json").body;
}

}  // namespace

double loss_of(const std::vector<AcknowledgedPose>& poses, const Path& path,
               std::chrono::steady_clock::time_point killed) {
  const std::vector<Frame> none;
  const std::vector<Frame>& frames = path.moves.empty() ? none : path.moves.back().frames;
  for (const AcknowledgedPose& pose : poses) {
    const bool is_there = are_equal(pose.pose, {}) || std::any_of(frames.begin(), frames.end(), [&](const Frame& f) {
                            return are_equal(f.pose, pose.pose);
                          });
    if (!is_there) return std::chrono::duration<double>(killed - pose.at).count();
  }
  return 0;
}

Json end_of_job(Client& client, const Json& reply) {
  if (!reply["ok"].get<bool>()) throw std::runtime_error(reply.dump());
  return client.event_where("job", [&](const Json& j) { return j["job"] == reply["job"] && j["status"] != "running"; });
}

std::vector<AcknowledgedPose> drag_randomly(Client& client, KillDice& dice, double seconds) {
  std::vector<AcknowledgedPose> poses;
  const std::chrono::steady_clock::time_point end =
      std::chrono::steady_clock::now() +
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
  try {
    const Json held = client.command("hold", {{"components", {kHighestBox}}});
    if (!held["ok"]) throw std::logic_error("the box cannot be held");
    Vec3 position;
    for (std::uint32_t number = 1; std::chrono::steady_clock::now() < end; ++number) {
      position.x = std::clamp(position.x + dice.between(-0.5, 0.5), -2.0, 2.0);
      position.z = std::clamp(position.z + dice.between(-0.4, 0.6), -2.0, 30.0);
      client.send_binary(
          server::encode(server::TargetMessage{held["grip"].get<std::uint32_t>(), number, {position, {}}}));
      const server::PoseMessage pose = client.pose_for_target(number);
      poses.push_back({std::chrono::steady_clock::now(), pose.pose});
    }
  } catch (const std::runtime_error&) {  // the server is gone
  }
  return poses;
}

KilledServer::KilledServer(fs::path folder) : folder_(std::move(folder)) {
  fs::create_directories(folder_ / "root");
  mark_ = "DISMANTLE_FAULTS=" + std::to_string(getpid()) + "-server";
  const Result<Done> written = write_assembly(stack(), scenes::stack_in_tube(static_cast<int>(kHighestBox)));
  if (!written) throw std::runtime_error(written.error().message);
  fs::copy_file(fs::path(DISMANTLE_SOURCE_DIR) / "samples/tooling.step", folder_ / "root/tooling.step",
                fs::copy_options::overwrite_existing);
  Result<Assembly> read = load_assembly(stack());
  if (!read) throw std::runtime_error(read.error().message);
  assembly_ = std::move(*read);
}

std::unique_ptr<ViewerProcess> KilledServer::start(SpawnOptions limits) const {
  limits.environment.push_back(mark_);
  limits.own_group = true;
  return std::make_unique<ViewerProcess>(stack(), folder_, limits);
}

Json KilledServer::start_job(Client& client, Job job) {
  return job == Job::Plan ? client.command("plan") : client.command("open", {{"root", 0}, {"file", "tooling.step"}});
}

void KilledServer::remember_durations() {
  for (const Job job : {Job::Plan, Job::Open}) {
    double& seconds = seconds_[static_cast<int>(job)];
    if (seconds > 0) continue;
    fs::remove_all(folder_ / "state");
    const auto viewer = start();
    Client client(viewer->address());
    client.state();
    const std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
    const Json end = end_of_job(client, start_job(client, job));
    if (end["status"] != "done") throw std::runtime_error("a job failed undisturbed: " + end.dump());
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  }
}

void KilledServer::kill_during_drag(KillRow& row, KillDice& dice) {
  ++row.kills;
  fs::remove_all(folder_ / "state");
  std::vector<AcknowledgedPose> poses;
  std::chrono::steady_clock::time_point killed;
  {
    const auto viewer = start();
    Client client(viewer->address());
    client.state();
    const double moment = dice.moment(kDragSeconds);
    Killer killer(*viewer, moment, dice.toss());
    poses = drag_randomly(client, dice, kDragSeconds);
    row.before_end += client.is_open() ? 0 : 1;
    killed = killer.wait();
    viewer->end(SIGKILL);
  }
  check_processes_left(row, mark_);
  check_restart(row, poses, killed, {});
  count_files_left(row);
}

void KilledServer::kill_during_search(KillRow& row, KillDice& dice) {
  remember_durations();
  ++row.kills;
  fs::remove_all(folder_ / "state");
  const Job job = dice.toss() ? Job::Plan : Job::Open;
  std::string recording;
  {
    const auto viewer = start();
    Client client(viewer->address());
    client.state();
    while (recording.empty() || Json::parse(recording)["moves"].empty()) {
      drag_randomly(client, dice, 0.05);
      client.command("release");
      recording = recording_of(*viewer);
    }
    const double moment = dice.moment(seconds_[static_cast<int>(job)]);
    Killer killer(*viewer, moment, dice.toss());
    bool has_ended = false;
    try {
      end_of_job(client, start_job(client, job));
      has_ended = true;
    } catch (const std::runtime_error&) {  // the server is gone
    }
    row.before_end += has_ended ? 0 : 1;
    killer.wait();
    viewer->end(SIGKILL);
  }
  check_processes_left(row, mark_);
  check_restart(row, {}, {}, recording);
  count_files_left(row);
}

void KilledServer::check_restart(KillRow& row, const std::vector<AcknowledgedPose>& poses,
                                 std::chrono::steady_clock::time_point killed, const std::string& recording) const {
  try {
    const auto viewer = start();
    Client client(viewer->address());
    const Json state = client.state();
    // A job that has opened another file has ended the session in order.
    const bool is_resumed = state["resumed"].get<bool>() || (state["resumable"].get<bool>() && !recording.empty() &&
                                                             client.command("resume")["ok"].get<bool>());
    const bool has_moved =
        std::any_of(poses.begin(), poses.end(), [](const AcknowledgedPose& pose) { return !are_equal(pose.pose, {}); });
    if (!is_resumed && (has_moved || !recording.empty())) row.violate(row.failed_reruns, "the session was not resumed");
    const std::string text = recording_of(*viewer);
    const Result<Path> path = parse_path(text, "recording");
    if (!path || !audit_path(assembly_, *path).holds()) {
      row.violate(row.half_written, "the recording is not valid");
    } else if (!recording.empty() && text != recording) {
      row.violate(row.damaged, "the recording is another one");
    } else if (const double loss = loss_of(poses, *path, killed); loss > row.longest_loss) {
      row.longest_loss = loss;
      if (loss > kMaxLoss) row.violate(row.damaged, "a pose is lost that is " + std::to_string(loss) + " s old");
    }
    viewer->end(SIGTERM);
  } catch (const std::exception& error) {
    row.violate(row.failed_reruns, std::string("the viewer does not start again: ") + error.what());
  }
}

void KilledServer::count_files_left(KillRow& row) const {
  const auto count = [&row](const std::string& name) {
    ++row.files_left;
    row.names_left.insert(without_digits(name));
  };
  for (const auto& [name, bytes] : contents_of(folder_ / "tmp")) count("tmp/" + name);
  for (const auto& [name, bytes] : contents_of(folder_ / "state")) {
    const fs::path extension = fs::path(name).extension();
    if (extension != ".journal" && extension != ".previous" && fs::path(name).filename() != "recent.json")
      count("state/" + name);
  }
}

}  // namespace dismantle::faults
