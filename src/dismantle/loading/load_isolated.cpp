// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_isolated.h"

#include "dismantle/assembly/assembly_bytes.h"
#include "dismantle/files/isolated_process.h"
#include "dismantle/formats/cad/read_cad.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/loading/load_assembly.h"

namespace dismantle {

namespace fs = std::filesystem;

namespace {

bool is_collada_file(const fs::path& file) {
  const FormatEntry* entry = format_of(file);
  return entry != nullptr && entry->format == FileFormat::Collada;
}

std::uint64_t size_on_disk(const fs::path& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) return fs::file_size(file, error);
  std::uint64_t sum = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(file, error))
    if (entry.is_regular_file(error)) sum += entry.file_size(error);
  return sum;
}

/// Runs in the child.
Result<Done> load_into_line(const fs::path& file, ImportOptions options, IsolatedLine& line) {
  options.progress = [&line](std::string_view stage, double fraction) {
    line.report(stage, fraction);
    return true;
  };
  const Result<Assembly> assembly = load_assembly(file, options);
  if (!assembly) return assembly.error();
  write_assembly_bytes(*assembly, [&line](const void* data, std::size_t size) { line.write(data, size); });
  return Done{};
}

/// The Error for a child process that failed.
Error failure(const fs::path& file, const IsolatedResult& result) {
  const auto unreadable = [&](const std::string& why, const std::string& advice) {
    return Error{ErrorKind::Unreadable, file.string() + " cannot be read (" + why + "); " + advice};
  };
  switch (result.ending) {
    case IsolatedEnding::Refused:
      return result.error;
    case IsolatedEnding::OutOfMemory:
      return unreadable("it needs more memory than a file of its size should", "check the file");
    case IsolatedEnding::OutOfTime:
    case IsolatedEnding::Silent:
      return unreadable("its reader came to no end", "simplify or split it");
    case IsolatedEnding::Cancelled:
      return {ErrorKind::Failed, "cancelled"};
    case IsolatedEnding::NotStarted:
      return {ErrorKind::Failed, file.string() + " cannot be read (the system gave no process); close something"};
    case IsolatedEnding::Done:
    case IsolatedEnding::Crashed:
      break;
  }
  return unreadable("its reader crashed", "check the file in the program that wrote it");
}

}  // namespace

Result<Assembly> load_isolated(const fs::path& file, const ImportOptions& options) {
  if (is_cad_file(file) || is_collada_file(file)) return load_assembly(file, options);  // it isolates itself
  IsolationLimits limits;
  limits.memory_bytes = kMeshMemoryBase + kMeshMemoryPerByte * size_on_disk(file);
  limits.cpu_seconds = kMeshCpuSeconds;
  const auto work = [&](IsolatedLine& line) { return load_into_line(file, options, line); };
  const IsolatedResult result = run_isolated(work, limits, options.progress);
  if (result.ending != IsolatedEnding::Done) return failure(file, result);
  std::optional<Assembly> assembly = assembly_from_bytes(result.bytes);
  if (!assembly) return failure(file, {});
  return std::move(*assembly);
}

}  // namespace dismantle
