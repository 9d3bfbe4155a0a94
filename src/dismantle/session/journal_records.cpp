// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/journal_records.h"

#include "dismantle/files/byte_order.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dismantle {

namespace {

constexpr std::uint32_t kVersion = 3;
/// Its records of entries list pairs of components at their ends, which are not used. Version 2 is version 3 without
/// Replace.
constexpr std::uint32_t kVersionWithPairs = 1;
constexpr std::string_view kMagic = "dismantle-journal";
constexpr std::size_t kHeadBytes = 8;  // length and hash

/// FNV-1a hash: detects torn and stale bytes.
std::uint32_t hash_of(std::string_view bytes) {
  std::uint32_t hash = 2166136261u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

/// Writes the payload of a record.
class Payload {
 public:
  explicit Payload(JournalRecord kind) { bytes_ += static_cast<char>(kind); }

  template <class T>
  Payload& number(T value) {
    const auto raw = little_endian_bytes(value);
    bytes_.append(raw.data(), raw.size());
    return *this;
  }
  Payload& text(std::string_view value) {
    count(value.size());
    bytes_ += value;
    return *this;
  }
  Payload& bytes(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  Payload& count(std::size_t value) { return number(static_cast<std::uint32_t>(value)); }
  Payload& frame(const Frame& f) {
    for (const double v : {f.time, f.pose.position.x, f.pose.position.y, f.pose.position.z, f.pose.rotation.w,
                           f.pose.rotation.x, f.pose.rotation.y, f.pose.rotation.z})
      number(v);
    return *this;
  }
  std::string record() const {
    const auto length = little_endian_bytes(static_cast<std::uint32_t>(bytes_.size()));
    const auto hash = little_endian_bytes(hash_of(bytes_));
    return std::string(length.data(), length.size()) + std::string(hash.data(), hash.size()) + bytes_;
  }

 private:
  std::string bytes_;
};

/// Reads a payload; missing bytes make it fail.
class Source {
 public:
  explicit Source(std::string_view bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  bool is_at_end() const { return bytes_.empty(); }
  template <class T>
  T number() {
    if (bytes_.size() < sizeof(T)) ok_ = false;
    if (!ok_) return {};
    const T value = number_at<T>(bytes_.data(), std::endian::little);
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  /// A count of items of at least `bytes` each.
  std::size_t count(std::size_t bytes) {
    const auto value = number<std::uint32_t>();
    if (value > bytes_.size() / bytes) ok_ = false;
    return ok_ ? value : 0;
  }
  std::string text() {
    const std::size_t size = count(1);
    std::string value(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
    return value;
  }
  ComponentId component(std::size_t component_count) {
    const auto value = number<std::uint32_t>();
    if (value >= component_count) ok_ = false;
    return ComponentId(value);
  }
  Frame frame() {
    double v[8];
    for (double& one : v) one = number<double>();
    return {v[0], {{v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}}};
  }
  /// All that is left.
  std::string_view rest() { return std::exchange(bytes_, {}); }
  void skip_pairs() {
    for (std::size_t left = count(8); left > 0; --left) number<std::uint64_t>();
  }

 private:
  std::string_view bytes_;
  bool ok_ = true;
};

/// Largest difference of a rotation's length from 1, and of the poses at the end of an entry and the start of the next
/// one, relative to their size: far more than rounding.
constexpr double kPoseTolerance = 1e-6;

bool is_finite(const Frame& f) {
  const auto& [p, q] = f.pose;
  return std::isfinite(f.time + p.x + p.y + p.z + q.w + q.x + q.y + q.z);
}

bool is_near(const Pose& a, const Pose& b) {
  const Quat &p = a.rotation, &q = b.rotation;
  const double cosine = std::abs(p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z);
  return length(a.position - b.position) <= kPoseTolerance * (1 + length(a.position)) && cosine >= 1 - kPoseTolerance;
}

/// Why the frames of an entry from a given one on are invalid; empty if they are valid.
std::string problem_of(const std::vector<Frame>& frames, std::size_t from) {
  for (std::size_t i = from; i < frames.size(); ++i) {
    const Quat& q = frames[i].pose.rotation;
    if (!is_finite(frames[i])) return "a pose is not finite";
    if (std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) > kPoseTolerance)
      return "a rotation is not of unit length";
    if (i > 0 && frames[i].time < frames[i - 1].time) return "the times of a motion descend";
  }
  return {};
}

/// A record, taken off the begin of some bytes.
struct TakenRecord {
  std::string_view payload;   // empty where the record is not whole
  bool is_unchanged = false;  // its hash is right
};

TakenRecord take_record(std::string_view& bytes) {
  if (bytes.size() <= kHeadBytes) return {};
  const auto length = number_at<std::uint32_t>(bytes.data(), std::endian::little);
  const auto hash = number_at<std::uint32_t>(bytes.data() + 4, std::endian::little);
  if (length == 0 || length > bytes.size() - kHeadBytes) return {};
  const std::string_view payload = bytes.substr(kHeadBytes, length);
  bytes.remove_prefix(kHeadBytes + length);
  return {payload, hash_of(payload) == hash};
}

/// Replays the records.
class JournalReplay {
 public:
  bool take(std::string_view payload) {
    const bool is_valid = replay(payload);
    if (!is_valid && contents_.invalid.empty()) contents_.invalid = "it is malformed";
    return is_valid;
  }
  void set_invalid(std::string why) { contents_.invalid = std::move(why); }

  bool has_header() const { return has_header_; }
  /// Ends an entry that was in progress when the records ended.
  JournalContents finish() {
    contents_.is_open = open_ && has_effect(*open_);
    end_open();
    return std::move(contents_);
  }

 private:
  bool replay(std::string_view payload) {
    Source in(payload.substr(1));
    const auto kind = static_cast<JournalRecord>(payload[0]);
    if (kind == JournalRecord::Header) return take_header(in);
    if (!has_header_) return false;
    contents_.is_closed = false;
    switch (kind) {
      case JournalRecord::Begin:
        return begin(in);
      case JournalRecord::Frames:
        return add_frames(in);
      case JournalRecord::End:
        return end(in);
      case JournalRecord::Drop:
        return drop();
      case JournalRecord::Undo:
        end_open();
        return undo();
      case JournalRecord::Redo:
        end_open();
        return redo();
      case JournalRecord::Reset:
        contents_.entries.clear();
        contents_.done_count = 0;
        open_.reset();
        poses_.clear();
        return true;
      case JournalRecord::Replace:
        return replace(in.rest());
      case JournalRecord::Close:
        return contents_.is_closed = true;
      case JournalRecord::Header:
        break;
    }
    return false;
  }

  bool replace(std::string_view records) {
    JournalReplay whole;
    whole.contents_.header = contents_.header;
    whole.has_header_ = true;
    while (!records.empty()) {
      const TakenRecord record = take_record(records);
      const bool is_nested = !record.payload.empty() && record.payload[0] == static_cast<char>(JournalRecord::Replace);
      if (!record.is_unchanged || is_nested) return false;
      if (!whole.replay(record.payload)) return refuse(std::move(whole.contents_.invalid));
    }
    *this = std::move(whole);
    return true;
  }

  bool undo() {
    if (contents_.done_count == 0) return false;
    const SessionEntry& entry = contents_.entries[--contents_.done_count];
    put(entry, entry.frames.front().pose);
    return true;
  }

  bool redo() {
    if (contents_.done_count == contents_.entries.size()) return false;
    const SessionEntry& entry = contents_.entries[contents_.done_count++];
    put(entry, entry.frames.back().pose);
    return true;
  }

  void put(const SessionEntry& entry, const Pose& pose) {
    for (const ComponentId c : entry.components) poses_[c] = pose;
  }

  bool refuse(std::string why) {
    contents_.invalid = std::move(why);
    return false;
  }

  /// There is no record of its end, as the process ended.
  void end_open() {
    if (open_ && has_effect(*open_)) {
      contents_.entries.resize(contents_.done_count);
      put(*open_, open_->frames.back().pose);
      contents_.entries.push_back(std::move(*open_));
      ++contents_.done_count;
    }
    open_.reset();
  }

  bool take_header(Source& in) {
    if (has_header_ || in.text() != kMagic) return false;
    const auto version = in.number<std::uint32_t>();
    if (version < kVersionWithPairs || version > kVersion) return false;
    has_pairs_ = version == kVersionWithPairs;
    JournalHeader& h = contents_.header;
    h.assembly_name = in.text();
    h.assembly_sha256 = in.text();
    h.component_count = in.number<std::uint32_t>();
    h.tolerance = in.number<double>();
    return has_header_ = in.ok() && in.is_at_end();
  }

  bool begin(Source& in) {
    const std::size_t all = contents_.header.component_count;
    SessionEntry entry;
    entry.label = in.text();
    entry.components.resize(in.count(5));
    for (ComponentId& c : entry.components) c = in.component(all);
    for (std::size_t i = 0; i < entry.components.size(); ++i)
      entry.removed_before.push_back(in.number<std::uint8_t>() != 0);
    entry.frames = {in.frame()};
    if (has_pairs_) in.skip_pairs();
    if (!in.ok() || !in.is_at_end() || entry.components.empty()) return false;
    if (std::string problem = problem_of(entry.frames, 0); !problem.empty()) return refuse(std::move(problem));
    end_open();
    for (const ComponentId c : entry.components) {
      const auto known = poses_.find(c);
      if (!is_near(known == poses_.end() ? Pose{} : known->second, entry.frames[0].pose))
        return refuse("a motion does not start where its components are");
    }
    open_ = std::move(entry);
    return true;
  }

  bool add_frames(Source& in) {
    const std::size_t count = in.count(sizeof(double) * 8);
    if (!open_ || !in.ok()) return false;
    const std::size_t before = open_->frames.size();
    for (std::size_t i = 0; i < count; ++i) open_->frames.push_back(in.frame());
    std::string problem = problem_of(open_->frames, before);
    if (problem.empty() && in.is_at_end()) return true;
    open_->frames.resize(before);
    return refuse(problem.empty() ? "it is malformed" : std::move(problem));
  }

  bool end(Source& in) {
    const auto removed = in.number<std::uint8_t>();
    if (has_pairs_) in.skip_pairs();
    if (!open_ || !in.ok() || !in.is_at_end()) return false;
    if (removed != 0) open_->removed_after = removed == 2;
    end_open();
    return true;
  }

  bool drop() {
    const bool was_open = open_.has_value();
    open_.reset();
    return was_open;
  }

  std::optional<SessionEntry> open_;
  JournalContents contents_;
  std::map<ComponentId, Pose> poses_;  ///< Of the components that were moved.
  bool has_header_ = false, has_pairs_ = false;
};

}  // namespace

std::string header_record(const JournalHeader& h) {
  return Payload(JournalRecord::Header)
      .text(kMagic)
      .number(kVersion)
      .text(h.assembly_name)
      .text(h.assembly_sha256)
      .number(h.component_count)
      .number(h.tolerance)
      .record();
}

std::string begin_record(const SessionEntry& entry) {
  Payload out(JournalRecord::Begin);
  out.text(entry.label).count(entry.components.size());
  for (const ComponentId c : entry.components) out.number(c.value);
  for (const bool removed : entry.removed_before) out.number(static_cast<std::uint8_t>(removed));
  return out.frame(entry.frames.front()).record();
}

std::string frames_record(Span<const Frame> frames) {
  Payload out(JournalRecord::Frames);
  out.count(frames.size());
  for (const Frame& f : frames) out.frame(f);
  return out.record();
}

std::string end_record(const SessionEntry& entry) {
  const int removed = entry.removed_after ? 1 + static_cast<int>(*entry.removed_after) : 0;
  return Payload(JournalRecord::End).number(static_cast<std::uint8_t>(removed)).record();
}

std::string replace_record(Span<const SessionEntry> entries, std::size_t done_count) {
  Payload out(JournalRecord::Replace);
  for (const SessionEntry& entry : entries) {
    out.bytes(begin_record(entry));
    if (has_moved(entry)) out.bytes(frames_record({entry.frames.data() + 1, entry.frames.size() - 1}));
    out.bytes(end_record(entry));
  }
  for (std::size_t i = done_count; i < entries.size(); ++i) out.bytes(plain_record(JournalRecord::Undo));
  return out.record();
}

std::string plain_record(JournalRecord kind) {
  return Payload(kind).record();
}

std::optional<JournalContents> parse_journal(std::string_view bytes) {
  JournalReplay replay;
  std::string_view left = bytes;
  std::size_t whole = 0;
  for (TakenRecord record = take_record(left); !record.payload.empty(); record = take_record(left)) {
    if (!record.is_unchanged) replay.set_invalid("its bytes were changed");
    if (!record.is_unchanged || !replay.take(record.payload)) break;
    whole = bytes.size() - left.size();
  }
  if (!replay.has_header()) return {};
  JournalContents contents = replay.finish();
  contents.whole_bytes = whole;
  return contents;
}

}  // namespace dismantle
