// SPDX-License-Identifier: Apache-2.0
// Compares the recognition of fasteners with a table that was made by looking at the components.
//
//   judge_fasteners TABLE.csv FOLDER...             recall, precision and share of right sizes, with and without names
//   judge_fasteners --list ASSEMBLY...              what is found, a row for each shape
//
// FOLDERs are searched for the assemblies of the table. Columns of the table: assembly, component (the first of its
// shape), count (of the components of this shape), kind ("none" for an assembly without fasteners), diameter_mm,
// length_mm, drive, key. Components of these assemblies that the table does not have are no fasteners.
#include "dismantle/fasteners/find_fasteners.h"
#include "dismantle/files/csv_text.h"
#include "dismantle/files/read_file.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/surface/equal_shapes.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace dismantle;
namespace fs = std::filesystem;

struct Row {
  std::string component, kind, drive;
  double diameter = 0, length = 0, key = 0;
};

struct Score {
  std::size_t expected = 0, found = 0, false_alarms = 0, sizes = 0, sizes_right = 0, drives = 0, drives_right = 0;
};

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

std::map<std::string, std::vector<Row>> read_table(const std::string& text) {
  std::map<std::string, std::vector<Row>> rows;
  std::size_t at = text.find('\n') + 1;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::vector<std::string> f = fields_of(text.substr(at, end - at));
    at = end + 1;
    if (f.size() < 8) continue;
    const auto number = [](const std::string& s) { return s.empty() ? 0 : std::stod(s); };
    rows[f[0]];
    if (f[3] != "none") rows[f[0]].push_back({f[1], f[3], f[6], number(f[4]), number(f[5]), number(f[7])});
  }
  return rows;
}

bool near(double a, double b) {
  return std::abs(a - b) <= std::max(0.11, 0.011 * b);
}

void judge(const Assembly& assembly, const std::vector<Row>& rows, FastenerEvidence evidence, Score& score) {
  const std::vector<std::optional<Fastener>> found = find_fasteners(assembly, {}, evidence);
  const std::vector<ComponentId> firsts = first_of_shape(assembly);
  std::map<ComponentId, const Row*> expected;
  for (const Row& row : rows) {
    const std::optional<ComponentId> c = assembly.find(row.component);
    if (!c)
      std::printf("  the table's '%s' is no component\n", row.component.c_str());
    else
      expected[firsts[c->value]] = &row;
  }
  std::set<std::uint32_t> told;
  for (std::uint32_t c = 0; c < found.size(); ++c) {
    const auto at = expected.find(firsts[c]);
    const Row* row = at == expected.end() ? nullptr : at->second;
    const char* name = assembly.components[c].name.c_str();
    const bool is_new = told.insert(firsts[c].value).second;
    if (row == nullptr) {
      if (found[c] && is_new) std::printf("  false: %s is no %s\n", name, fastener_text(*found[c]).c_str());
      score.false_alarms += found[c].has_value();
      continue;
    }
    ++score.expected;
    if (!found[c] || kind_name(found[c]->kind) != row->kind) {
      if (is_new)
        std::printf("  missed: %s is a %s, not a %s\n", name, row->kind.c_str(),
                    found[c] ? kind_name(found[c]->kind) : "-");
      score.false_alarms += found[c].has_value();
      continue;
    }
    ++score.found;
    if (row->diameter > 0) {
      ++score.sizes;
      const bool right =
          near(found[c]->diameter, row->diameter) && (row->length == 0 || near(found[c]->length, row->length));
      score.sizes_right += right;
      if (!right && is_new)
        std::printf("  size: %s is %g x %g, not %g x %g\n", name, row->diameter, row->length, found[c]->diameter,
                    found[c]->length);
    }
    if (!row->drive.empty()) {
      ++score.drives;
      const bool right = drive_name(found[c]->drive) == row->drive &&
                         (row->key == 0 || std::abs(found[c]->drive_size - row->key) < 0.01);
      score.drives_right += right;
      if (!right && is_new)
        std::printf("  drive: %s has %s %g, not %s %g\n", name, row->drive.c_str(), row->key,
                    drive_name(found[c]->drive), found[c]->drive_size);
    }
  }
}

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 100 : 100.0 * static_cast<double>(part) / static_cast<double>(all);
}

void print(const char* what, const Score& s) {
  std::printf("%s: %zu fasteners, recall %.1f%%, precision %.1f%% (%zu false), size right %.1f%%, drive right %.1f%%\n",
              what, s.expected, share(s.found, s.expected), share(s.found, s.found + s.false_alarms), s.false_alarms,
              share(s.sizes_right, s.sizes), share(s.drives_right, s.drives));
}

int list(int count, char** files) {
  for (int i = 0; i < count; ++i) {
    const Result<Assembly> assembly = load_assembly(files[i], {});
    if (!assembly) {
      std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
      return 2;
    }
    const std::vector<ComponentId> firsts = first_of_shape(*assembly);
    std::map<ComponentId, std::size_t> counts;
    for (const ComponentId c : firsts) ++counts[c];
    const auto with = find_fasteners(*assembly), without = find_fasteners(*assembly, {}, FastenerEvidence::ShapeOnly);
    std::printf("## %s\n", files[i]);
    for (const auto& [c, number] : counts) {
      const auto text = [](const std::optional<Fastener>& f) {
        return f ? fastener_text(*f) + " [" + tool_text(*f) + (f->thread_is_modelled ? ", thread" : "") + "]" : "-";
      };
      const Vec3 size = assembled_bounds((*assembly)[c]).size();
      std::printf("%3zu x %-40.40s %6.4g x %6.4g x %6.4g | %s | %s\n", number, (*assembly)[c].name.c_str(), size.x,
                  size.y, size.z, text(with[c.value]).c_str(), text(without[c.value]).c_str());
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string(argv[1]) == "--list") return list(argc - 2, argv + 2);
  if (argc < 3) {
    std::fprintf(stderr, "usage: judge_fasteners TABLE.csv FOLDER... | --list ASSEMBLY...\n");
    return 2;
  }
  const Result<std::string> text = read_file(argv[1], 1 << 20);
  if (!text) {
    std::fprintf(stderr, "%s\n", text.error().message.c_str());
    return 2;
  }
  Score with, without;
  for (const auto& [name, rows] : read_table(*text)) {
    std::string file;
    for (int i = 2; i < argc && file.empty(); ++i)
      if (fs::exists(fs::path(argv[i]) / name)) file = (fs::path(argv[i]) / name).string();
    if (file.empty()) {
      std::printf("%s: not found, left out\n", name.c_str());
      continue;
    }
    const Result<Assembly> assembly = load_assembly(file, {});
    if (!assembly) {
      std::fprintf(stderr, "%s\n", assembly.error().message.c_str());
      return 2;
    }
    std::printf("%s, with names\n", name.c_str());
    judge(*assembly, rows, FastenerEvidence::ShapeAndName, with);
    std::printf("%s, by shape\n", name.c_str());
    judge(*assembly, rows, FastenerEvidence::ShapeOnly, without);
  }
  print("with names", with);
  print("by shape", without);
  return 0;
}
