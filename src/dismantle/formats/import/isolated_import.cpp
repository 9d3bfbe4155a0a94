// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/import/isolated_import.h"

#include "dismantle/assembly/assembly_bytes.h"
#include "dismantle/files/file_cache.h"
#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/import/mesh_source.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>

namespace dismantle {

namespace {

constexpr std::size_t kShaDigits = 64;

// The bytes that the child sends and the cache keeps: the length of the list of linked files (eight bytes, native
// order); the list, for each a hash, the path, and a zero; the assembly.

std::string list_of(const std::vector<LinkedFile>& files) {
  std::string list;
  for (const LinkedFile& linked : files) list += linked.sha256 + linked.file.string() + '\0';
  return list;
}

/// The list at the start of the bytes; none if they are too short.
std::optional<std::string_view> linked_list(std::string_view bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, bytes.data(), sizeof size);
  if (size > bytes.size() - sizeof size) return std::nullopt;
  return bytes.substr(sizeof size, size);
}

std::optional<Assembly> assembly_in(std::string_view bytes) {
  const std::optional<std::string_view> list = linked_list(bytes);
  if (!list) return std::nullopt;
  const std::string_view rest = bytes.substr(sizeof(std::uint64_t) + list->size());
  return assembly_from_bytes({reinterpret_cast<const std::byte*>(rest.data()), rest.size()});
}

/// The linked files of an assembly's bytes; none if the bytes are malformed.
std::optional<std::vector<LinkedFile>> linked_files(std::string_view bytes) {
  std::optional<std::string_view> list = linked_list(bytes);
  if (!list) return std::nullopt;
  std::vector<LinkedFile> files;
  while (!list->empty()) {
    const std::size_t end = list->find('\0');
    if (end == std::string_view::npos || end < kShaDigits) return std::nullopt;
    files.push_back({list->substr(kShaDigits, end - kShaDigits), std::string(list->substr(0, kShaDigits))});
    list->remove_prefix(end + 1);
  }
  return files;
}

/// True if every linked file is as it was.
bool is_current(std::string_view bytes, const ImportOptions& options) {
  const std::optional<std::vector<LinkedFile>> files = linked_files(bytes);
  return files && std::all_of(files->begin(), files->end(), [&](const LinkedFile& linked) {
           const Result<std::string> now = read_file(linked.file, options.limits.file_bytes);
           return now && sha256(*now) == linked.sha256;
         });
}

/// The hash of a file and of those that it links to.
std::string hash_of(const std::string& content, const std::vector<LinkedFile>& linked_files) {
  if (linked_files.empty()) return content;
  std::string all = content;
  for (const LinkedFile& linked : linked_files) all += linked.sha256;
  return sha256(all);
}

/// Runs in the child.
Result<Done> import_into_line(const IsolatedImport& importer, ImportOptions options, IsolatedLine& line) {
  options.progress = [&line](std::string_view stage, double fraction) {
    line.report(stage, fraction);
    return true;
  };
  const Result<ImportedAssembly> imported = importer.import(options);
  if (!imported) return imported.error();
  const std::string list = list_of(imported->linked_files);
  const std::uint64_t size = list.size();
  line.write(&size, sizeof size);
  line.write(list.data(), list.size());
  write_assembly_bytes(imported->assembly, [&line](const void* data, std::size_t count) { line.write(data, count); });
  return Done{};
}

/// The Error for a child process that failed.
Error failure(const std::filesystem::path& file, const IsolatedImport& importer, const IsolatedResult& result) {
  const auto unreadable = [&](std::string_view why, std::string_view advice) {
    return unreadable_as(file, importer.format, why, advice);
  };
  switch (result.ending) {
    case IsolatedEnding::Refused: {
      const std::string& message = result.error.message;  // "<why>; <what to do>"
      const std::size_t split = std::min(message.rfind("; "), message.size());
      const std::string advice = split < message.size() ? message.substr(split + 2) : "check the file";
      return unreadable(message.substr(0, split), advice);
    }
    case IsolatedEnding::OutOfMemory:
      return unreadable("it needs more memory than there is", "mesh it with a larger deflection or split it");
    case IsolatedEnding::OutOfTime:
      return unreadable(importer.reader + " computed for hours without an end", "simplify or split it");
    case IsolatedEnding::Silent:
      return unreadable(importer.reader + " made no progress for minutes", "simplify or split it");
    case IsolatedEnding::Cancelled:
      return cancelled();
    case IsolatedEnding::NotStarted:
      return {ErrorKind::Failed, file.string() +
                                     " cannot be read (the system gave no process for it); close other programs and "
                                     "try again"};
    case IsolatedEnding::Done:
    case IsolatedEnding::Crashed:
      break;
  }
  return unreadable(
      importer.reader + " crashed on it" + (result.signal ? ", signal " + std::to_string(result.signal) : ""),
      "check it in the program that wrote it");
}

/// All that the result depends on, linked files apart.
std::string cache_key(const std::filesystem::path& file, const std::string& content, const IsolatedImport& importer,
                      const ImportOptions& options) {
  const auto number = [](double value) {
    char digits[32];
    return std::string(digits, static_cast<std::size_t>(std::snprintf(digits, sizeof digits, "%a", value)));
  };
  std::string key = importer.format;
  for (const std::string& part :
       {importer.version, content, file.stem().string(), options.units, number(options.deflection),
        number(options.angular_deflection), std::to_string(static_cast<int>(options.solids)),
        std::to_string(options.limits.triangles), std::to_string(options.limits.components)})
    key += '\n' + part;
  return key;
}

}  // namespace

Error unreadable_as(const std::filesystem::path& file, std::string_view format, std::string_view why,
                    std::string_view advice) {
  return {ErrorKind::Unreadable, file.string() + " cannot be read as " + std::string(format) + " (" + std::string(why) +
                                     "); " + std::string(advice)};
}

Result<Assembly> import_isolated(const std::filesystem::path& file, std::string_view bytes,
                                 const IsolatedImport& importer, const ImportOptions& options) {
  if (!report_progress(options.progress, "reading", 0)) return cancelled();
  const std::string content = sha256(bytes);
  const FileCache cache(options.cache_folder, options.cache_folder.empty() ? 0 : kCacheBytes);
  const std::string key = cache_key(file, content, importer, options);
  const std::string kept = cache.find(key).value_or("");
  std::string_view imported = kept;
  IsolatedResult result;
  std::optional<Assembly> assembly;
  if (is_current(imported, options)) assembly = assembly_in(imported);
  if (!assembly) {
    const auto work = [&](IsolatedLine& line) { return import_into_line(importer, options, line); };
    result = run_isolated(work, importer.limits, options.progress);
    if (result.ending != IsolatedEnding::Done) return failure(file, importer, result);
    imported = {reinterpret_cast<const char*>(result.bytes.data()), result.bytes.size()};
    assembly = assembly_in(imported);
    if (!assembly || !linked_files(imported)) return failure(file, importer, {IsolatedEnding::Crashed, 0, {}, {}});
    cache.keep(key, imported);
  }
  assembly->source_file = file.filename().string();
  assembly->source_sha256 = hash_of(content, *linked_files(imported));
  return std::move(*assembly);
}

}  // namespace dismantle
