// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/claim_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

namespace dismantle::batch {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

constexpr double kRenewalsPerLease = 10;

fs::path link_of(const fs::path& base, int attempt) {
  return base.string() + ".claim." + std::to_string(attempt);
}

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// Start time of a process in ticks since boot: distinguishes processes with the same id. Empty if there is no such
/// process, "ended" if it has ended and its parent has not asked for that yet, which may take forever.
std::string start_of(const std::string& pid) {
  const std::string stat = first_line("/proc/" + pid + "/stat");
  std::istringstream fields(stat.substr(stat.rfind(')') + 1));  // the process name before may contain anything
  std::string state, field;
  fields >> state;
  for (int k = 1; k < 20; ++k) fields >> field;
  return state == "Z" || state == "X" ? "ended" : field;
}

/// Identifies this boot of the machine and the container: the scope in which process ids are valid.
std::string this_machine() {
  std::error_code ignored;
  return first_line("/proc/sys/kernel/random/boot_id") + "," + fs::read_symlink("/proc/self/ns/pid", ignored).string();
}

std::string this_process() {
  const std::string pid = std::to_string(::getpid());
  return this_machine() + " " + pid + " " + start_of(pid);
}

/// True if the owner has certainly ended.
bool is_dead(const std::string& owner) {
  std::istringstream words(owner);
  std::string machine, pid, start;
  words >> machine >> pid >> start;
  if (machine != this_machine()) return false;
  const bool gone = ::kill(static_cast<pid_t>(std::atoi(pid.c_str())), 0) != 0 && errno == ESRCH;
  const std::string start_now = start_of(pid);
  return gone || (!start_now.empty() && start_now != start);
}

std::string owner_of(const fs::path& link) {
  std::error_code ignored;
  return fs::read_symlink(link, ignored).string();
}

/// True for a folder ITEM.old.PROCESS.TIME, which remove_result() makes.
bool is_replaced_result(const fs::directory_entry& entry) {
  std::error_code ignored;
  fs::path name = entry.path().filename();
  for (int k = 0; k < 2; ++k, name = name.stem())
    if (const std::string number = name.extension().string();
        number.size() < 2 || number.find_first_not_of("0123456789", 1) != std::string::npos)
      return false;
  return name.extension() == ".old" && entry.is_directory(ignored) && !entry.is_symlink(ignored);
}

/// The number N of FOLDER/ITEM.claim.N, if that is the name of a claim on the item of `base`.
std::optional<int> attempt_of(const std::string& name, const fs::path& base) {
  const std::string prefix = base.filename().string() + ".claim.";
  if (name.compare(0, prefix.size(), prefix) != 0) return {};
  const std::string number = name.substr(prefix.size());
  if (number.empty() || number.size() > 9 || number.find_first_not_of("0123456789") != std::string::npos) return {};
  return std::stoi(number);
}

/// The latest attempt at an item, 0 if there is none. A killed process may have removed the first ones only.
int latest_attempt(const fs::path& base) {
  int latest = 0;
  std::error_code error;
  for (fs::directory_iterator i(base.parent_path(), error), end; !error && i != end; i.increment(error))
    latest = std::max(latest, attempt_of(i->path().filename().string(), base).value_or(0));
  return latest;
}

/// Time at which a link was created or touched last.
fs::file_time_type change_of(const fs::path& link) {
  struct stat status {};
  if (::lstat(link.c_str(), &status) != 0) return {};
  return fs::file_time_type(std::chrono::seconds(status.st_mtim.tv_sec) +
                            std::chrono::nanoseconds(status.st_mtim.tv_nsec));
}

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

}  // namespace

Claim::Claim(fs::path base, int attempt, std::string owner)
    : base_(std::move(base)), attempt_(attempt), owner_(std::move(owner)), renewed_(Clock::now()) {}

fs::path Claim::scratch_folder(int attempt) const {
  return link_of(base_, attempt).string() + ".work";
}

void Claim::renew(double lease_seconds) {
  if (seconds_since(renewed_) < lease_seconds / kRenewalsPerLease) return;
  renewed_ = Clock::now();
  ::utimensat(AT_FDCWD, link_of(base_, attempt_).c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
}

bool Claim::is_held() const {
  return owner_of(link_of(base_, attempt_)) == owner_ && !fs::is_symlink(link_of(base_, attempt_ + 1));
}

void Claim::release() {
  std::error_code ignored;
  for (int attempt = 1; attempt <= attempt_; ++attempt) {
    fs::remove_all(scratch_folder(attempt), ignored);
    if (attempt < attempt_ || owner_of(link_of(base_, attempt)) == owner_) fs::remove(link_of(base_, attempt), ignored);
  }
}

ClaimFolder::ClaimFolder(fs::path folder, double lease_seconds)
    : folder_(std::move(folder)), lease_seconds_(lease_seconds), owner_(this_process()) {}

bool ClaimFolder::is_expired(const std::string& item, int attempt, const fs::path& link) {
  if (is_dead(owner_of(link))) return true;
  const fs::file_time_type changed = change_of(link);
  Seen& seen = seen_[item];
  if (seen.attempt != attempt || seen.changed != changed) seen = {attempt, changed, Clock::now()};
  return seconds_since(seen.since) > lease_seconds_;
}

std::optional<Claim> ClaimFolder::try_claim(const std::string& item) {
  const fs::path base = folder_ / item;
  int attempt = latest_attempt(base) + 1;
  while (fs::is_symlink(link_of(base, attempt))) ++attempt;
  if (attempt > 1 && !is_expired(item, attempt - 1, link_of(base, attempt - 1))) return {};

  const fs::path link = link_of(base, attempt);
  // A network file system may create the link and, when the request is repeated, report that it exists.
  const int failure = ::symlink(owner_.c_str(), link.c_str()) == 0 ? 0 : errno;
  std::error_code ignored;
  if (failure == ENOENT) fs::create_directories(folder_, ignored);  // for the next attempt
  if (failure != 0 && (failure != EEXIST || owner_of(link) != owner_)) return {};
  return Claim(base, attempt, owner_);
}

void ClaimFolder::remove_abandoned() const {
  std::vector<fs::path> abandoned;
  std::error_code error, ignored;
  for (fs::directory_iterator i(folder_, error), end; !error && i != end; i.increment(error)) {
    const bool is_dead_claim = i->is_symlink(ignored) && is_dead(owner_of(i->path()));
    if (is_dead_claim) abandoned.push_back(i->path().string() + ".work");
    if (is_dead_claim || is_replaced_result(*i)) abandoned.push_back(i->path());
  }
  for (const fs::path& one : abandoned) fs::remove_all(one, ignored);
}

}  // namespace dismantle::batch
