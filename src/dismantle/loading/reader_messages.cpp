// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/reader_messages.h"

#include "dismantle/assembly/assembly_bytes.h"

#include <cstring>

namespace dismantle {

namespace {

ByteSink appending_to(std::string& bytes) {
  return [&bytes](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
}

ByteReader reader_of(std::string_view bytes) {
  return ByteReader({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
}

/// An answer begins with the length of the list of linked files (eight bytes, native order) and the list.
std::optional<std::string_view> linked_list(std::string_view answer) {
  std::uint64_t size = 0;
  if (answer.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, answer.data(), sizeof size);
  if (size > answer.size() - sizeof size) return std::nullopt;
  return answer.substr(sizeof size, size);
}

}  // namespace

std::string bytes_of(const ReaderRequest& request) {
  std::string bytes;
  const ByteSink sink = appending_to(bytes);
  ByteWriter writer(sink);
  const ImportOptions& o = request.options;
  writer.text(request.version);
  writer.text(request.file.native());
  writer.text(o.units);
  writer.value(o.deflection);
  writer.value(o.angular_deflection);
  writer.value(static_cast<std::uint8_t>(o.solids));
  writer.value<std::uint64_t>(o.limits.file_bytes);
  writer.value<std::uint64_t>(o.limits.triangles);
  writer.value<std::uint64_t>(o.limits.components);
  writer.value<std::uint64_t>(o.reference_folders.size());
  for (const std::filesystem::path& folder : o.reference_folders) writer.text(folder.native());
  return bytes;
}

std::optional<ReaderRequest> reader_request_from(std::string_view bytes) {
  ByteReader reader = reader_of(bytes);
  ReaderRequest request;
  ImportOptions& o = request.options;
  request.version = reader.text();
  request.file = reader.text();
  o.units = reader.text();
  o.deflection = reader.value<double>();
  o.angular_deflection = reader.value<double>();
  o.solids = reader.value<std::uint8_t>() == static_cast<std::uint8_t>(Solids::Join) ? Solids::Join : Solids::Split;
  o.limits.file_bytes = reader.value<std::uint64_t>();
  o.limits.triangles = reader.value<std::uint64_t>();
  o.limits.components = reader.value<std::uint64_t>();
  const std::size_t folders = reader.count(sizeof(std::uint64_t));
  for (std::size_t i = 0; i < folders; ++i) o.reference_folders.emplace_back(reader.text());
  if (!reader.ok() || !reader.at_end()) return std::nullopt;
  return request;
}

void write_answer(const ImportedAssembly& imported, const ByteSink& sink) {
  std::string list;
  const ByteSink to_list = appending_to(list);
  ByteWriter entries(to_list);
  entries.value<std::uint64_t>(imported.linked_files.size());
  for (const LinkedFile& linked : imported.linked_files) {
    entries.text(linked.file.native());
    entries.text(linked.sha256);
  }
  ByteWriter(sink).text(list);
  write_assembly_bytes(imported.assembly, sink);
}

std::optional<std::vector<LinkedFile>> linked_files_in(std::string_view answer) {
  const std::optional<std::string_view> list = linked_list(answer);
  if (!list) return std::nullopt;
  ByteReader reader = reader_of(*list);
  std::vector<LinkedFile> files(reader.count(2 * sizeof(std::uint64_t)));
  for (LinkedFile& linked : files) {
    linked.file = reader.text();
    linked.sha256 = reader.text();
  }
  if (!reader.ok() || !reader.at_end()) return std::nullopt;
  return files;
}

std::optional<Assembly> assembly_in(std::string_view answer) {
  const std::optional<std::string_view> list = linked_list(answer);
  if (!list) return std::nullopt;
  const std::string_view rest = answer.substr(sizeof(std::uint64_t) + list->size());
  return assembly_from_bytes({reinterpret_cast<const std::byte*>(rest.data()), rest.size()});
}

}  // namespace dismantle
