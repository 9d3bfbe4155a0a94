// SPDX-License-Identifier: Apache-2.0
#include "dismantle/formats/step/read_step.h"

#include "dismantle/files/file_cache.h"
#include "dismantle/files/isolated_process.h"
#include "dismantle/files/read_file.h"
#include "dismantle/files/sha256.h"
#include "dismantle/formats/import/assembly_bytes.h"
#include "dismantle/formats/import/units.h"
#include "dismantle/formats/step/step_import.h"

#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <Standard_Version.hxx>
#include <algorithm>
#include <cstdio>
#include <new>
#include <string_view>

namespace dismantle {

namespace {

constexpr std::string_view kFirstKeyword = "ISO-10303-21";
constexpr std::string_view kLastKeyword = "END-ISO-10303-21";
constexpr std::size_t kSearchedForKeyword = 4096;  // bytes at either end of the file

Error unreadable(const std::filesystem::path& file, std::string_view why, std::string_view advice) {
  return {ErrorKind::Unreadable,
          file.string() + " cannot be read as STEP (" + std::string(why) + "); " + std::string(advice)};
}

/// Done if the text has the header and trailer of a STEP file, else an Error that says what is wrong.
Result<Done> check_frame(const std::filesystem::path& file, std::string_view text) {
  const std::string_view head = text.substr(0, kSearchedForKeyword);
  if (head.substr(0, 2) == "\x1f\x8b") return unreadable(file, "it is compressed with gzip", "unpack it first");
  if (head.substr(0, 4) == "PK\x03\x04") return unreadable(file, "it is a zip archive", "unpack it first");
  if (head.find(kFirstKeyword) == std::string_view::npos)
    return unreadable(file, "it does not begin with ISO-10303-21", "check that it is a STEP file");
  const std::string_view tail = text.substr(text.size() - std::min(text.size(), kSearchedForKeyword));
  if (tail.find(kLastKeyword) == std::string_view::npos)
    return unreadable(file, "it ends too early: END-ISO-10303-21 is missing", "get the whole file or export it again");
  return Done{};
}

/// Runs in the child.
Result<Done> import_into_line(std::string_view text, const std::string& name, ImportOptions options,
                              IsolatedLine& line) {
  options.progress = [&line](std::string_view stage, double fraction) {
    line.report(stage, fraction);
    return true;
  };
  try {
    const Result<Assembly> assembly = import_step(text, name, options);
    if (!assembly) return assembly.error();
    write_assembly_bytes(*assembly, [&line](const void* data, std::size_t size) { line.write(data, size); });
    return Done{};
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    const char* text_of_failure = failure.GetMessageString();
    return Error{ErrorKind::Unreadable, "the CAD kernel gave up on it: " + std::string(failure.DynamicType()->Name()) +
                                            " " + (text_of_failure ? text_of_failure : "") +
                                            "; check it in the program that wrote it"};
  }
}

/// The Error for a child process that failed.
Error failure(const std::filesystem::path& file, const IsolatedResult& result) {
  switch (result.ending) {
    case IsolatedEnding::Refused: {
      const std::string& message = result.error.message;  // "<why>; <what to do>"
      const std::size_t split = std::min(message.rfind("; "), message.size());
      const std::string advice = split < message.size() ? message.substr(split + 2) : "check the file";
      return unreadable(file, message.substr(0, split), advice);
    }
    case IsolatedEnding::OutOfMemory:
      return unreadable(file, "it needs more memory than there is", "mesh it with a larger deflection or split it");
    case IsolatedEnding::OutOfTime:
      return unreadable(file, "the CAD kernel computed for hours without an end", "simplify or split it");
    case IsolatedEnding::Silent:
      return unreadable(file, "the CAD kernel made no progress for minutes", "simplify or split it");
    case IsolatedEnding::Cancelled:
      return {ErrorKind::Failed, "cancelled"};
    case IsolatedEnding::NotStarted:
      return {ErrorKind::Failed, file.string() +
                                     " cannot be read (the system gave no process for it); close other programs and "
                                     "try again"};
    default:
      return unreadable(file,
                        result.signal ? "the CAD kernel crashed on it, signal " + std::to_string(result.signal)
                                      : std::string("the CAD kernel crashed on it"),
                        "check it in the program that wrote it");
  }
}

/// Increased whenever the same file and options give another assembly, or its bytes another layout.
constexpr int kImportVersion = 2;

/// All that the result of import_step depends on.
std::string cache_key(const std::string& content, const std::string& name, const ImportOptions& options) {
  const auto number = [](double value) {
    char digits[32];
    return std::string(digits, static_cast<std::size_t>(std::snprintf(digits, sizeof digits, "%a", value)));
  };
  std::string key = "STEP";
  for (const std::string& part :
       {std::to_string(kImportVersion), std::string(DISMANTLE_VERSION), std::string(OCC_VERSION_COMPLETE), content,
        name, options.units, number(options.deflection), number(options.angular_deflection),
        std::to_string(static_cast<int>(options.solids)), std::to_string(options.limits.triangles),
        std::to_string(options.limits.components)})
    key += '\n' + part;
  return key;
}

Span<const std::byte> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

std::string_view text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Result<Assembly> read_step(const std::filesystem::path& file, const ImportOptions& options) {
  if (!options.units.empty())
    if (const Result<double> known = millimetres_per_unit(options.units); !known) return known.error();
  const Result<std::string> text = read_file(file, options.limits.file_bytes);
  if (!text) return text.error();
  if (const Result<Done> frame = check_frame(file, *text); !frame) return frame.error();

  if (!report_progress(options.progress, "reading", 0)) return Error{ErrorKind::Failed, "cancelled"};
  const std::string content = sha256(*text), name = file.stem().string();
  const FileCache cache(options.cache_folder, options.cache_folder.empty() ? 0 : kCacheBytes);
  const std::string key = cache_key(content, name, options);
  std::optional<Assembly> assembly;
  if (const std::optional<std::string> kept = cache.find(key)) assembly = assembly_from_bytes(bytes_of(*kept));
  if (!assembly) {
    IsolationLimits limits;
    limits.memory_bytes = kStepMemoryBase + kStepMemoryPerByte * text->size();
    limits.cpu_seconds = kStepCpuSeconds;
    limits.silence_seconds = kStepSilenceSeconds;
    const auto work = [&](IsolatedLine& line) { return import_into_line(*text, name, options, line); };
    const IsolatedResult result = run_isolated(work, limits, options.progress);
    if (result.ending != IsolatedEnding::Done) return failure(file, result);
    assembly = assembly_from_bytes(result.bytes);
    if (!assembly) return failure(file, {IsolatedEnding::Crashed, 0, {}, {}});
    cache.keep(key, text_of(result.bytes));
  }
  assembly->source_file = file.filename().string();
  assembly->source_sha256 = content;
  return std::move(*assembly);
}

}  // namespace dismantle
