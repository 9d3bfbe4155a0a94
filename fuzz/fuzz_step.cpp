// SPDX-License-Identifier: Apache-2.0
// STEP, IGES and BREP files the whole way: load_assembly(), the reader program in its confined process, its messages,
// the assembly. What a file does to OpenCASCADE ends the reader, and is an Error here; what it does to our own code is
// a finding, in the reader, too, where that is built with sanitizers.
#include "dismantle/isolation/confinement.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/loading/reader_program.h"
#include "fuzz/cad_change.h"
#include "fuzz/fuzz_input.h"
#include "fuzz/own_folder.h"

#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace {

using namespace dismantle;
namespace fs = std::filesystem;

// The sanitizers make the reader slower; they do not let its memory be limited.
constexpr double kSeconds = kUnderSanitizer ? 12 : 4;          // processor time of the reader
constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;      // of the reader [bytes]
constexpr std::uint64_t kPrograms = std::uint64_t{256} << 20;  // what is mapped and no memory of its own [bytes]
constexpr double kMoreSeconds = 2;                             // until the system ends it
constexpr double kDeflection = 0.2;  // coarse: what is fuzzed is the reading, not the meshing [mm]
constexpr std::size_t kTriangles = 200'000, kComponents = 1000;

/// The folders of this target: inputs, and what readers and parent take for that of temporary files.
struct Folders {
  fuzz::OwnFolder own;
  fs::path inputs = own.folder("inputs"), temporary = own.folder("temporary"), reports = own.folder("reports");

  Folders() {
    setenv("TMPDIR", temporary.c_str(), 1);
    // Of the reader: this process has read its own.
    const std::string log = "log_path=" + (reports / "report").string();
    setenv("ASAN_OPTIONS", (log + ":detect_leaks=0:allocator_may_return_null=1:hard_rss_limit_mb=2048").c_str(), 1);
    setenv("UBSAN_OPTIONS", (log + ":print_stacktrace=1").c_str(), 1);
    fuzz::require(!find_reader(ReaderProgram::Cad).empty(), "the program dismantle-read-cad, which must be built");
  }
};

std::size_t entries_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// The processes of this one; libFuzzer has one for itself.
std::string children() {
  std::ifstream in("/proc/thread-self/children");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

double seconds_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

std::uint64_t memory_of_children() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
}

/// True if the first frame of a sanitizer's report that is neither its own nor the C library's is of our code.
bool blames_us(const std::string& report) {
  std::istringstream lines(report);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t name = line.find(" in ");
    if (line.find("    #") != 0 || name == std::string::npos) continue;
    const std::string frame = line.substr(name + 4);
    if (frame.find("dismantle::") != std::string::npos) return true;
    const bool is_runtime = frame.starts_with("__") || frame.find("compiler-rt") != std::string::npos ||
                            frame.find("libc.so") != std::string::npos ||
                            frame.find("libstdc++") != std::string::npos || frame.starts_with("std::") ||
                            frame.starts_with("operator ");
    if (!is_runtime) return false;
  }
  return report.find("runtime error:") != std::string::npos;
}

/// Looks through the reports of sanitizers in readers, and removes them.
void require_no_report_of_us(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path());
    const std::string report{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const bool is_ours = blames_us(report);
    if (is_ours) std::fputs(report.c_str(), stderr);
    fs::remove(entry.path());
    fuzz::require(!is_ours, "a reader whose own code is sound");
  }
}

void require_valid(const Result<Assembly>& assembly) {
  fuzz::require_sound(assembly);
  if (!assembly) {
    fuzz::require(assembly.error().kind == ErrorKind::Unreadable, "a file that is to blame");
    fuzz::require(assembly.error().message.find("; ") != std::string::npos, "a sentence that says what to do");
    return fuzz::require_clean(assembly.error().message);
  }
  std::set<std::string_view> names;
  std::size_t triangles = 0;
  for (const TreeNode& node : assembly->tree) fuzz::require_clean(node.name);
  for (const Component& component : assembly->components) {
    fuzz::require_clean(component.name);
    fuzz::require(names.insert(component.name).second, "names that differ");
    triangles += component.mesh->faces.size();
  }
  fuzz::require(names.size() <= kComponents && triangles <= kTriangles, "no more than the limits allow");
}

const char* file_name_of(std::string_view text) {
  switch (fuzz::cad_text_of(text)) {
    case fuzz::CadText::Iges:
      return "input.igs";
    case fuzz::CadText::Brep:
      return "input.brep";
    case fuzz::CadText::Step:
      break;
  }
  return "input.step";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folders folders;
  const std::string_view text = fuzz::text_of(data, size);
  const fs::path file = folders.inputs / file_name_of(text);
  std::ofstream(file, std::ios::binary) << text;
  ImportOptions options;
  options.deflection = kDeflection;
  options.limits.cpu_seconds = kSeconds;
  options.limits.memory_bytes = kMemory;
  options.limits.triangles = kTriangles;
  options.limits.components = kComponents;
  const std::size_t descriptors = entries_in("/proc/self/fd");
  const double before = seconds_of_children();
  const std::string others = children();

  require_valid(load_assembly(file, options));

  fuzz::require(children() == others, "a reader that has ended");
  fuzz::require(entries_in("/proc/self/fd") == descriptors, "no files that stay open");
  fuzz::require(seconds_of_children() - before < kSeconds + kMoreSeconds, "the limit of processor time");
  if (!kUnderSanitizer) fuzz::require(memory_of_children() < kMemory + kPrograms, "the limit of memory");
  require_no_report_of_us(folders.reports);
  fs::remove(file);
  fuzz::require(entries_in(folders.inputs) + entries_in(folders.temporary) == 0, "nothing that is left behind");
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  return dismantle::fuzz::mutate_text<dismantle::fuzz::CadChange>(data, size, max_size, seed);
}
