// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_line.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>

namespace dismantle {

namespace {

constexpr std::size_t kHeaderSize = 1 + sizeof(std::uint64_t);
constexpr std::size_t kLargestPayload = std::size_t{1} << 20;
constexpr std::size_t kLongestStage = 1000;
constexpr double kReportInterval = 0.05;  // [s], between two reports of one stage
constexpr int kExitUnheard = 19;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void write_all(int descriptor, const std::byte* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(descriptor, data, size);
    if (count < 0 && errno != EINTR) _exit(kExitUnheard);
    if (count <= 0) continue;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
}

}  // namespace

void IsolatedLine::send(LineMessage kind, const void* data, std::size_t size) {
  std::byte header[kHeaderSize];
  const std::uint64_t length = size;
  header[0] = static_cast<std::byte>(kind);
  std::memcpy(&header[1], &length, sizeof length);
  write_all(descriptor_, header, sizeof header);
  write_all(descriptor_, static_cast<const std::byte*>(data), size);
}

void IsolatedLine::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  const double now = seconds_now();
  if (stage == last_stage_ && now - last_report_ < kReportInterval) return;
  last_stage_ = stage;
  last_report_ = now;
  std::string payload(sizeof fraction, '\0');
  std::memcpy(payload.data(), &fraction, sizeof fraction);
  payload += stage.substr(0, kLongestStage);
  send(LineMessage::Report, payload.data(), payload.size());
}

void IsolatedLine::write(const void* data, std::size_t size) {
  const std::lock_guard lock(mutex_);
  const auto* bytes = static_cast<const std::byte*>(data);
  for (std::size_t offset = 0; offset < size; offset += kLargestPayload)
    send(LineMessage::Bytes, bytes + offset, std::min(kLargestPayload, size - offset));
}

void IsolatedLine::refuse(const Error& error) {
  const std::lock_guard lock(mutex_);
  std::string payload(1, static_cast<char>(error.kind));
  payload += error.message.substr(0, kLargestPayload / 2);
  send(LineMessage::Refusal, payload.data(), payload.size());
}

void IsolatedLine::finish() {
  const std::lock_guard lock(mutex_);
  send(LineMessage::End, nullptr, 0);
}

bool IsolatedLineReader::take(const std::byte* data, std::size_t size) {
  pending_.insert(pending_.end(), data, data + size);
  std::size_t offset = 0;
  while (pending_.size() - offset >= kHeaderSize) {
    const auto kind = static_cast<std::uint8_t>(pending_[offset]);
    std::uint64_t length = 0;
    std::memcpy(&length, &pending_[offset + 1], sizeof length);
    if (length > kLargestPayload) return false;
    if (pending_.size() - offset - kHeaderSize < length) break;
    if (!take_message(kind, pending_.data() + offset + kHeaderSize, length)) return false;
    offset += kHeaderSize + length;
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(offset));
  return true;
}

bool IsolatedLineReader::take_message(std::uint8_t kind, const std::byte* payload, std::size_t length) {
  const char* text = reinterpret_cast<const char*>(payload);
  switch (static_cast<LineMessage>(kind)) {
    case LineMessage::Report: {
      double fraction = 0;
      if (length < sizeof fraction || length > sizeof fraction + kLongestStage) return false;
      std::memcpy(&fraction, payload, sizeof fraction);
      fraction_ = std::isfinite(fraction) ? fraction : -1;
      stage_.assign(text + sizeof fraction, length - sizeof fraction);
      return true;
    }
    case LineMessage::Bytes:
      bytes_.insert(bytes_.end(), payload, payload + length);
      return true;
    case LineMessage::Refusal:
      if (length < 1 || static_cast<std::uint8_t>(payload[0]) > static_cast<std::uint8_t>(ErrorKind::Failed))
        return false;
      error_ = {static_cast<ErrorKind>(payload[0]), std::string(text + 1, length - 1)};
      return refused_ = true;
    case LineMessage::End:
      return ended_ = true;
  }
  return false;
}

}  // namespace dismantle
