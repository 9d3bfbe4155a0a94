// SPDX-License-Identifier: Apache-2.0
#include "dismantle/loading/load_assembly.h"

#include "dismantle/assembly/duplicates.h"
#include "dismantle/files/file_cache.h"
#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/files/text_name.h"
#include "dismantle/files/text_scan.h"
#include "dismantle/formats/import/assembly_builder.h"
#include "dismantle/formats/import/file_formats.h"
#include "dismantle/formats/import/mesh_source.h"
#include "dismantle/formats/import/referenced_file.h"
#include "dismantle/formats/import/units.h"
#include "dismantle/loading/estimated_deflection.h"
#include "dismantle/loading/import_budget.h"
#include "dismantle/loading/reader_messages.h"
#include "dismantle/loading/reader_program.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <stdexcept>

namespace dismantle {

namespace fs = std::filesystem;

namespace {

/// Increased whenever the same file and options give another assembly, or a reader's answer another layout.
constexpr int kImportVersion = 4;

/// "STEP", or what a folder is read as.
std::string format_name(const FormatEntry* entry) {
  return entry != nullptr ? std::string(entry->name) : "a folder of meshes";
}

/// What reads a file, for users.
std::string reader_name(const FormatEntry* entry) {
  if (entry == nullptr || !entry->by_cad_kernel || entry->format == FileFormat::Urdf) return "its reader";
  return entry->format == FileFormat::Collada ? "Assimp" : "the CAD kernel";
}

/// The size of a file, or of all in a folder.
std::uint64_t size_on_disk(const fs::path& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) return fs::file_size(file, error);
  std::uint64_t sum = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(file, error))
    if (entry.is_regular_file(error)) sum += entry.file_size(error);
  return sum;
}

/// Bytes of other files that a model's budget counts, at most: a small file may lie among large ones.
constexpr std::uint64_t kMostOfLinks = std::uint64_t{64} << 20;

/// The size of a file with all to which it may refer.
std::uint64_t size_with_links(const fs::path& file, const FormatEntry* entry) {
  if (entry == nullptr || !entry->has_links) return size_on_disk(file);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return size_on_disk(file) + std::min(size_on_disk(folder), kMostOfLinks);
}

/// The Error for a reader that ended without an answer.
Error failure(const fs::path& file, const FormatEntry* entry, const IsolatedResult& result) {
  const auto unreadable = [&](const std::string& why_and_advice) {
    return unreadable_as(file, format_name(entry), {ErrorKind::Unreadable, why_and_advice});
  };
  switch (result.ending) {
    case IsolatedEnding::Refused:
      return result.error;
    case IsolatedEnding::OutOfMemory:
      return unreadable(
          "it takes more memory than files of its size do; simplify or split it, or allow more with --import-memory");
    case IsolatedEnding::OutOfTime:
    case IsolatedEnding::Silent:
      return unreadable(
          "it takes longer than files of its size do; simplify or split it, or allow more with --import-time");
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
  return unreadable(reader_name(entry) + " crashed on it" +
                    (result.signal ? ", signal " + std::to_string(result.signal) : std::string()) +
                    "; check it in the program that wrote it");
}

/// Runs the reader of a file and returns its answer.
Result<std::string> answer_of_reader(const fs::path& file, const FormatEntry* entry, const ImportOptions& options) {
  const ReaderProgram kind = entry != nullptr && entry->by_cad_kernel ? ReaderProgram::Cad : ReaderProgram::Meshes;
  IsolatedProgram program;
  program.file = find_reader(kind);
  if (program.file.empty())
    return Error{ErrorKind::Failed, file.string() +
                                        " cannot be read (the program that reads models, dismantle-read, is not where "
                                        "dismantle is); install dismantle again"};
  program.request = bytes_of(ReaderRequest{DISMANTLE_VERSION, file, options});
  program.readable = reference_folders(file, options);
  program.readable.push_back(file);
  const IsolationLimits limits = import_budget(entry, size_with_links(file, entry), options);
  const IsolatedResult result = run_isolated(program, limits, options.progress);
  if (result.ending != IsolatedEnding::Done) return failure(file, entry, result);
  return std::string(reinterpret_cast<const char*>(result.bytes.data()), result.bytes.size());
}

/// All that the result depends on, linked files apart.
std::string cache_key(const fs::path& file, const FormatEntry& entry, const std::string& content,
                      const ImportOptions& options) {
  const auto number = [](double value) {
    char digits[32];
    return std::string(digits, static_cast<std::size_t>(std::snprintf(digits, sizeof digits, "%a", value)));
  };
  std::string key(entry.name);
  const bool by_folder = entry.format == FileFormat::Urdf;  // the same text refers to other meshes elsewhere
  for (const std::string& part :
       {std::to_string(kImportVersion), std::string(DISMANTLE_VERSION), std::string(DISMANTLE_CAD_LIBRARIES), content,
        file.stem().string(), by_folder ? fs::absolute(file).parent_path().native() : std::string(), options.units,
        number(options.deflection), number(options.angular_deflection),
        std::to_string(static_cast<int>(options.solids)), std::to_string(options.limits.triangles),
        std::to_string(options.limits.components)})
    key += '\n' + part;
  return key;
}

/// True if every linked file is as it was, and may still be read, or may still not.
bool is_current(std::string_view answer, const fs::path& file, const ImportOptions& options) {
  const std::optional<std::vector<LinkedFile>> files = linked_files_in(answer);
  const std::vector<fs::path> folders = reference_folders(file, options);
  return files && std::all_of(files->begin(), files->end(), [&](const LinkedFile& linked) {
           const bool is_there = referenced_file(linked.file, file.parent_path(), folders).ok();
           if (!is_there || linked.sha256.empty()) return !is_there && linked.sha256.empty();
           const Result<std::string> now = read_file(linked.file, options.limits.file_bytes);
           return now && sha256(*now) == linked.sha256;
         });
}

/// The assembly of a file, from the cache or its reader.
Result<Assembly> read(const fs::path& file, const FormatEntry* entry, const ImportOptions& options) {
  if (!report_progress(options.progress, "reading", 0)) return cancelled();
  const bool is_kept = entry != nullptr && entry->by_cad_kernel && !options.cache_folder.empty();
  const FileCache cache(is_kept ? options.cache_folder : fs::path(), is_kept ? kCacheBytes : 0);
  std::string key, content;
  if (is_kept) {
    const Result<std::string> bytes = read_file(file, options.limits.file_bytes);
    if (!bytes) return bytes.error();
    content = sha256(*bytes);
    key = cache_key(file, *entry, content, options);
    const std::string kept = cache.find(key).value_or("");
    if (is_current(kept, file, options))
      if (std::optional<Assembly> assembly = assembly_in(kept)) {
        assembly->source_file = file.filename().string();
        return std::move(*assembly);
      }
  }
  const Result<std::string> answer = answer_of_reader(file, entry, options);
  if (!answer) return answer.error();
  std::optional<Assembly> assembly = assembly_in(*answer);
  const std::optional<std::vector<LinkedFile>> linked = linked_files_in(*answer);
  if (!assembly || !linked) return failure(file, entry, {IsolatedEnding::Crashed, 0, {}, {}});
  // Not if the file changed between the two readings. The hash of a FreeCAD document covers those that it links to.
  const bool has_own_hash = linked->empty() || (entry != nullptr && entry->format == FileFormat::Urdf);
  if (is_kept && (!has_own_hash || assembly->source_sha256 == content)) cache.keep(key, *answer);
  return std::move(*assembly);
}

/// The format of a file; null for a folder. Errors: Unreadable.
Result<const FormatEntry*> format_to_read(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  if (fs::is_directory(status)) return static_cast<const FormatEntry*>(nullptr);
  if (!fs::exists(status))
    return Error{ErrorKind::Unreadable, file.string() + " cannot be read (no such file); check the path"};
  const FormatEntry* entry = format_of(file);
  if (entry != nullptr) return entry;
  const std::string extension = lower_case(file.extension().string());
  return Error{ErrorKind::Unreadable,
               file.string() + " cannot be read (" +
                   (extension.empty() ? "it has no file extension"
                                      : "dismantle cannot read files with the extension " + in_quotes(extension)) +
                   "); convert it to " + format_names() + ", or give a folder of meshes"};
}

/// Names from files may contain any bytes; after this they are safe in JSON and on a terminal.
void clean_names(Assembly& assembly) {
  for (TreeNode& node : assembly.tree) node.name = clean_name(node.name);
  for (Component& component : assembly.components) component.name = clean_name(component.name);
  make_names_unique(assembly.components);
}

/// Estimates the deflection where the reader does not know it, or only that of primitives among the meshes.
void estimate_deflection(Assembly& assembly, const FormatEntry* format) {
  const bool has_primitives =
      format != nullptr && (format->format == FileFormat::Urdf || format->format == FileFormat::Vrml);
  if (assembly.deflection > 0 && !has_primitives) return;
  const double estimate = estimated_deflection(assembly);
  if (!(estimate > assembly.deflection)) return;
  assembly.deflection = estimate;
  assembly.deflection_is_estimated = true;
}

}  // namespace

Result<Assembly> load_assembly(const fs::path& file, const ImportOptions& options) {
  if (!options.units.empty())
    if (const Result<double> known = millimetres_per_unit(options.units); !known) return known.error();
  try {
    const Result<const FormatEntry*> format = format_to_read(file);
    if (!format) return format.error();
    Result<Assembly> assembly = read(file, *format, options);
    if (!assembly) return assembly;
    if (const Result<Done> sane = check_coordinates(*assembly); !sane) return sane.error();
    clean_names(*assembly);
    estimate_deflection(*assembly, *format);
    if (options.drop_duplicates) {
      std::vector<ComponentId> duplicates;
      for (const Duplicate& d : find_duplicates(*assembly)) duplicates.push_back(d.component);
      remove_components(*assembly, duplicates);
    }
    return assembly;
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::Failed, file.string() + " cannot be loaded (out of memory); simplify it or free memory"};
  } catch (const std::length_error&) {
    return Error{ErrorKind::Failed, file.string() + " cannot be loaded (out of memory); simplify it or free memory"};
  }
}

}  // namespace dismantle
