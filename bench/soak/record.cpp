// SPDX-License-Identifier: Apache-2.0
#include "bench/soak/record.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/json_text.h"

#include <filesystem>
#include <sstream>

namespace dismantle::soak {

namespace {

/// The numbers as ranges [first, last].
JsonValue ranges_of(const std::set<std::uint64_t>& numbers) {
  JsonValue ranges = JsonValue::array();
  for (const std::uint64_t number : numbers) {
    if (!ranges.empty() && ranges.back().at(1) == number - 1)
      ranges.back().at(1) = number;
    else
      ranges.push_back({number, number});
  }
  return ranges;
}

std::string to_line(const std::string& assembly, const std::set<std::uint64_t>& done, const BatchResult& r) {
  JsonValue bins = JsonValue::array();
  for (const auto& [bin, count] : r.times.bins()) bins.push_back({bin, count});
  JsonValue line = {{"assembly", assembly},
                    {"batches", ranges_of(done)},
                    {"steps", r.steps},
                    {"reached", r.reached},
                    {"violations", r.violations},
                    {"audits_cut", r.audits_cut},
                    {"straight_motions", r.straight_motions},
                    {"stuck", r.stuck},
                    {"front", r.front},
                    {"longest_us", r.longest_us},
                    {"engine_seconds", r.engine_seconds},
                    {"audit_seconds", r.audit_seconds},
                    {"times", bins}};
  if (!r.message.empty()) line["message"] = r.message;
  return json_line(line);
}

BatchResult result_in(const JsonValue& line) {
  BatchResult r;
  line.at("steps").get_to(r.steps);
  line.at("reached").get_to(r.reached);
  line.at("violations").get_to(r.violations);
  line.at("audits_cut").get_to(r.audits_cut);
  line.at("straight_motions").get_to(r.straight_motions);
  line.at("stuck").get_to(r.stuck);
  line.at("front").get_to(r.front);
  line.at("longest_us").get_to(r.longest_us);
  line.at("engine_seconds").get_to(r.engine_seconds);
  line.at("audit_seconds").get_to(r.audit_seconds);
  for (const JsonValue& bin : line.at("times")) r.times.add(bin.at(0).get<int>(), bin.at(1).get<std::size_t>());
  r.message = line.value("message", std::string());
  return r;
}

Error failed(const std::string& file, const std::string& why) {
  return {ErrorKind::Failed, "the record " + file + " cannot be used (" + why + "); name another one"};
}

}  // namespace

Record::Record(Record&& other) noexcept
    : file_(std::move(other.file_)), out_(std::move(other.out_)), entries_(std::move(other.entries_)) {}

Result<Record> Record::open(const std::string& file, std::uint64_t seed, int targets) {
  Record record;
  record.file_ = file;
  if (file.empty()) return record;
  const std::string settings = json_line({{"seed", seed}, {"targets", targets}});
  if (std::filesystem::exists(file))
    if (const Result<Done> read = record.read(settings); !read) return read.error();
  if (const Result<Done> written = record.rewrite(settings); !written) return written.error();
  record.out_.open(file, std::ios::app);
  if (!record.out_) return failed(file, "it cannot be written");
  return record;
}

Result<Done> Record::read(const std::string& settings) {
  std::ifstream in(file_);
  std::ostringstream text;
  text << in.rdbuf();
  std::string whole = text.str();
  whole.erase(whole.rfind('\n') + 1);  // npos + 1 is 0
  std::istringstream lines(whole);
  std::string line;
  if (std::getline(lines, line) && line != settings) return failed(file_, "it has other settings: " + line);
  try {
    while (std::getline(lines, line)) {
      const JsonValue value = JsonValue::parse(line);
      Entry& entry = entries_[value.at("assembly")];
      BatchResult result = result_in(value);
      for (const JsonValue& range : value.at("batches"))
        for (auto batch = range.at(0).get<std::uint64_t>(); batch <= range.at(1).get<std::uint64_t>(); ++batch)
          result.batches += entry.done.insert(batch).second ? 1 : 0;
      entry.sum.add(result);
    }
  } catch (const JsonValue::exception& exception) {
    return failed(file_, exception.what());
  }
  return Done{};
}

Result<Done> Record::rewrite(const std::string& settings) {
  std::string text = settings + "\n";
  for (const auto& [assembly, entry] : entries_) text += to_line(assembly, entry.done, entry.sum) + "\n";
  return write_file(file_, text);
}

bool Record::has(const std::string& assembly, std::uint64_t batch) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(assembly);
  return found != entries_.end() && found->second.done.count(batch) > 0;
}

Result<Done> Record::add(const std::string& assembly, std::uint64_t batch, const BatchResult& result) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[assembly];
  entry.done.insert(batch);
  entry.sum.add(result);
  if (file_.empty()) return Done{};
  out_ << to_line(assembly, {batch}, result) << std::endl;
  if (!out_) return failed(file_, "it cannot be written");
  return Done{};
}

BatchResult Record::of(const std::string& assembly) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(assembly);
  return found == entries_.end() ? BatchResult{} : found->second.sum;
}

}  // namespace dismantle::soak
