// SPDX-License-Identifier: Apache-2.0
#include "dismantle/isolation/isolated_request.h"

#include "dismantle/core/byte_stream.h"

namespace dismantle {

namespace {

constexpr std::string_view kMark = "dismantle request 1";

}  // namespace

std::string bytes_of(const IsolatedRequest& request) {
  std::string bytes;
  const ByteSink sink = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  ByteWriter writer(sink);
  writer.text(std::string(kMark));
  writer.value(request.parent);
  writer.value(request.limits.memory_bytes);
  writer.value(request.limits.cpu_seconds);
  writer.value<std::uint64_t>(request.readable.size());
  for (const std::filesystem::path& path : request.readable) writer.text(path.native());
  writer.text(request.request);
  return bytes;
}

std::optional<IsolatedRequest> request_from(std::string_view bytes) {
  ByteReader reader({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
  IsolatedRequest request;
  if (reader.text() != kMark) return std::nullopt;
  request.parent = reader.value<std::int64_t>();
  request.limits.memory_bytes = reader.value<std::uint64_t>();
  request.limits.cpu_seconds = reader.value<double>();
  const std::size_t count = reader.count(sizeof(std::uint64_t));
  for (std::size_t i = 0; i < count; ++i) request.readable.emplace_back(reader.text());
  request.request = reader.text();
  if (!reader.ok() || !reader.at_end()) return std::nullopt;
  return request;
}

}  // namespace dismantle
