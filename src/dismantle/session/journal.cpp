// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/journal.h"

#include "dismantle/session/journal_records.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <thread>

namespace dismantle {

namespace {

/// Interval of flushes to the disk.
constexpr std::chrono::milliseconds kFlushInterval{500};

Error cannot_write(const std::filesystem::path& file, const std::string& why) {
  return {ErrorKind::Failed, file.string() + " cannot be written (" + why + "); a crash would lose this session"};
}

}  // namespace

/// An open file, and the thread that flushes it.
class Journal::Impl {
 public:
  explicit Impl(int descriptor) : descriptor_(descriptor), flusher_([this] { flush_now_and_then(); }) {}

  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
    }
    wake_.notify_one();
    flusher_.join();
    ::close(descriptor_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void write(const std::string& record) {
    std::size_t done = 0;
    while (done < record.size() && !has_failed_) {
      const ssize_t count = ::write(descriptor_, record.data() + done, record.size() - done);
      if (count > 0) done += static_cast<std::size_t>(count);
      if (count < 0 && errno != EINTR) has_failed_ = true;
    }
    is_dirty_ = true;
  }

  bool has_failed() const { return has_failed_; }

 private:
  void flush_now_and_then() {
    std::unique_lock lock(mutex_);
    for (bool is_last = false; !is_last;) {
      is_last = wake_.wait_for(lock, kFlushInterval, [this] { return is_ending_; });
      if (!is_dirty_.exchange(false)) continue;
      lock.unlock();
      if (fdatasync(descriptor_) != 0) has_failed_ = true;
      lock.lock();
    }
  }

  int descriptor_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_ending_ = false;
  std::atomic<bool> is_dirty_ = false, has_failed_ = false;
  std::thread flusher_;
};

Journal::Journal(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::~Journal() = default;

Result<std::unique_ptr<Journal>> Journal::create(const std::filesystem::path& file, const JournalHeader& header) {
  Result<std::unique_ptr<Journal>> journal = go_on(file, {});
  if (journal) (*journal)->impl_->write(header_record(header));
  return journal;
}

Result<std::unique_ptr<Journal>> Journal::go_on(const std::filesystem::path& file, const JournalContents& contents) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) return cannot_write(file, std::strerror(errno));
  const auto whole = static_cast<off_t>(contents.whole_bytes);
  const bool is_ours = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (!is_ours || ftruncate(descriptor, whole) != 0 || lseek(descriptor, whole, SEEK_SET) != whole) {
    const std::string why = is_ours ? std::strerror(errno) : "another viewer has it open";
    ::close(descriptor);
    return cannot_write(file, why);
  }
  return std::unique_ptr<Journal>(new Journal(std::make_unique<Impl>(descriptor)));
}

void Journal::begin(const SessionEntry& entry) {
  impl_->write(begin_record(entry));
}

void Journal::add_frames(Span<const Frame> frames) {
  DISMANTLE_EXPECT(!frames.empty());
  impl_->write(frames_record(frames));
}

void Journal::end(const SessionEntry& entry) {
  impl_->write(end_record(entry));
}

void Journal::drop() {
  impl_->write(plain_record(JournalRecord::Drop));
}

void Journal::undo() {
  impl_->write(plain_record(JournalRecord::Undo));
}

void Journal::redo() {
  impl_->write(plain_record(JournalRecord::Redo));
}

void Journal::reset() {
  impl_->write(plain_record(JournalRecord::Reset));
}

void Journal::replace(Span<const SessionEntry> entries, std::size_t done_count) {
  impl_->write(replace_record(entries, done_count));
}

void Journal::close() {
  impl_->write(plain_record(JournalRecord::Close));
}

bool Journal::has_failed() const {
  return impl_->has_failed();
}

}  // namespace dismantle
