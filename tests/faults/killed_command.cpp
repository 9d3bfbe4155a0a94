// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/killed_command.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace dismantle::faults {

namespace fs = std::filesystem;
using server::testing_client::processes_with;
using server::testing_client::SpawnedProgram;
using server::testing_client::SpawnOptions;

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string new_mark() {
  static std::atomic<int> count{0};
  return "DISMANTLE_FAULTS=" + std::to_string(getpid()) + "-" + std::to_string(++count);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

/// Number of items of a batch that have their result.
std::size_t finished_items(const FolderContents& contents) {
  std::size_t count = 0;
  for (const auto& [name, bytes] : contents)
    count += name.front() != '.' && fs::path(name).filename() == "result.json" ? 1 : 0;
  return count;
}

}  // namespace

void check_processes_left(KillRow& row, const std::string& variable) {
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::vector<pid_t> left = processes_with(variable);
  while (!left.empty() && seconds_since(start) < kMaxAfterlife) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    left = processes_with(variable);
  }
  for (const pid_t process : left) {
    row.violate(row.processes_left, "process " + std::to_string(process) + " lives on");
    ::kill(process, SIGKILL);
  }
}

KilledCommand::KilledCommand(fs::path folder, FaultCommand command)
    : folder_(std::move(folder)), command_(std::move(command)), mark_(new_mark()) {
  prepare(false, false);
  const CommandEnd first = run();
  reference_ = contents_of(out());
  filled_cache_ = contents_of(cache());
  seconds_ = first.seconds;
  exit_code_ = first.exit_code;
  if (exit_code_ != 0 || reference_.empty())
    throw std::runtime_error(command_.kind + " failed undisturbed: " + first.err);
  for (const auto& [name, bytes] : reference_) {
    bool is_redone = false;
    for (const std::string& start : command_.redone) is_redone |= name.compare(0, start.size(), start) == 0;
    if (!is_redone) earlier_[name] = command_.redone.empty() ? "an earlier output\n" : bytes;
  }
  for (const bool with_earlier : {false, true}) {
    prepare(with_earlier, true);
    if (run().exit_code != exit_code_ || !equals_reference(contents_of(out())))
      throw std::runtime_error(command_.kind + " gives different results");
  }
}

SpawnOptions KilledCommand::options() const {
  SpawnOptions marked;
  marked.environment = {mark_, "SOURCE_DATE_EPOCH=1700000000"};
  return in_folder(folder_, marked);
}

CommandEnd KilledCommand::run() const {
  return run_command(command_.arguments, options());
}

void KilledCommand::prepare(bool with_earlier, bool with_cache) const {
  restore(out(), with_earlier ? earlier_ : FolderContents{});
  restore(cache(), with_cache ? filled_cache_ : FolderContents{});
  restore(temporary(), {});
}

bool KilledCommand::depends_on_run(const std::string& name) const {
  for (const std::string& file : command_.run_dependent)
    if (fs::path(name).filename() == file) return true;
  return false;
}

bool KilledCommand::is_whole(const std::string& name, const std::string& bytes) const {
  if (depends_on_run(name)) return !bytes.empty() && bytes.back() == '\n';
  return bytes == reference_.at(name);
}

bool KilledCommand::equals_reference(const FolderContents& contents) const {
  for (const auto& [name, bytes] : reference_)
    if (const auto found = contents.find(name); found == contents.end() || !is_whole(name, found->second)) return false;
  return true;
}

/// Outputs are absent, as they were before, or whole; files of one subfolder are there all or not at all.
void KilledCommand::check_outputs(KillRow& row, const FolderContents& after, bool had_earlier) const {
  std::set<fs::path> folders;
  for (const auto& [name, bytes] : after)
    if (reference_.count(name) > 0) folders.insert(fs::path(name).parent_path());
  for (const auto& [name, bytes] : reference_) {
    const auto found = after.find(name), before = earlier_.find(name);
    const bool was_there = had_earlier && before != earlier_.end();
    const fs::path subfolder = fs::path(name).parent_path();
    if (found == after.end()) {
      if (was_there) row.violate(row.damaged, name + " is gone");
      if (!was_there && !subfolder.empty() && folders.count(subfolder) > 0)
        row.violate(row.half_written, name + " is missing in its folder");
    } else if (!is_whole(name, found->second) && !(was_there && found->second == before->second)) {
      const std::string length = " has " + std::to_string(found->second.size()) + " bytes that are not its own";
      row.violate(was_there ? row.damaged : row.half_written, name + length);
    }
  }
}

void KilledCommand::check_rerun(KillRow& row, const FolderContents& after) const {
  const CommandEnd again = run();
  if (again.exit_code != exit_code_) {
    row.violate(row.failed_reruns, "the repetition ended with " + std::to_string(again.exit_code) + ": " + again.err);
  } else if (!equals_reference(contents_of(out()))) {
    row.violate(row.failed_reruns, "the repetition gave another result");
  } else if (command_.kind == "batch" && count_of(again.out, "(done before)") != finished_items(after)) {
    row.violate(row.failed_reruns, "the repetition did again what was done: " + again.out);
  }
}

void KilledCommand::count_files_left(KillRow& row) const {
  const auto count = [&row](const std::string& name) {
    ++row.files_left;
    row.names_left.insert(without_digits(name));
  };
  for (const auto& [name, bytes] : contents_of(out()))
    if (reference_.count(name) == 0) count("out/" + name);
  for (const auto& [name, bytes] : contents_of(temporary())) count("tmp/" + name);
  for (const auto& [name, bytes] : contents_of(cache()))
    if (fs::path(name).extension() == ".tmp") count("cache/" + name);
}

void KilledCommand::kill_once(KillRow& row, KillDice& dice) const {
  ++row.kills;
  const bool had_earlier = dice.toss(), had_cache = dice.between(0, 1) < 0.25;
  prepare(had_earlier, had_cache);
  {
    SpawnedProgram program(command_.arguments, options());
    row.before_end += program.wait_for(dice.moment(seconds_)) ? 0 : 1;
    dice.toss() ? program.signal(SIGKILL) : program.signal_group(SIGKILL);
  }
  check_processes_left(row, mark_);
  const FolderContents after = contents_of(out());
  check_outputs(row, after, had_earlier);
  check_rerun(row, after);
  count_files_left(row);
}

}  // namespace dismantle::faults
