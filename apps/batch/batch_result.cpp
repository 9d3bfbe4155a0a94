// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/batch_result.h"

#include "dismantle/files/atomic_file.h"
#include "dismantle/files/read_file.h"

#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dismantle::batch {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t kMaxResultBytes = std::size_t{1} << 20;
constexpr int kMoveAttempts = 10;

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The JSON object in a file; empty if there is none.
Json read_json(const fs::path& file) {
  const Result<std::string> text = read_file(file, kMaxResultBytes);
  Json json = text ? Json::parse(*text, nullptr, false) : Json();
  return json.is_object() ? json : Json::object();
}

/// A text member; empty if it is missing.
std::string text_in(const Json& object, const char* name) {
  const auto member = object.find(name);
  return member != object.end() && member->is_string() ? member->get<std::string>() : std::string();
}

fs::path folder_of(const BatchJob& job, const BatchItem& item) {
  return job.output / item.folder;
}

/// A field of a row, with tabs and line breaks replaced by spaces.
std::string tsv_field(const Json& value) {
  std::string text;
  if (value.is_string()) text = value.get<std::string>();
  if (!value.is_string() && !value.is_null()) text = value.dump();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// A table with a header, a row for each object and a column for each member of any object, in order of appearance.
std::string tsv_of(const Json& rows) {
  std::vector<std::string> columns;
  for (const Json& row : rows)
    for (const auto& [name, value] : row.items())
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  std::string text;
  for (std::size_t c = 0; c < columns.size(); ++c) text += (c > 0 ? "\t" : "") + columns[c];
  text += '\n';
  for (const Json& row : rows) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += (c > 0 ? "\t" : "") + (row.contains(columns[c]) ? tsv_field(row[columns[c]]) : std::string());
    text += '\n';
  }
  return text;
}

}  // namespace

std::optional<BatchResult> find_result(const BatchJob& job, const BatchItem& item) {
  const Json json = read_json(folder_of(job, item) / "result.json");
  if (text_in(json, "format") != "dismantle-batch-result" || text_in(json, "key") != item.key) return {};
  const auto summary = json.find("summary");
  return BatchResult{text_in(json, "error"), summary != json.end() ? summary->dump() : "{}"};
}

Result<Done> publish_result(const BatchJob& job, const BatchItem& item, const fs::path& scratch_folder,
                            const BatchResult& result, const BatchTiming& timing) {
  Json json{{"format", "dismantle-batch-result"}, {"version", 1}, {"assembly", item.name}, {"key", item.key}};
  json["status"] = result.failed() ? "failed" : "done";
  json["error"] = result.failed() ? Json(result.error) : Json(nullptr);
  json["summary"] = Json::parse(result.summary, nullptr, false);
  const Json cost{{"seconds", timing.seconds}, {"host", timing.host}};
  if (Result<Done> written = write_file(scratch_folder / "timing.json", text_of(cost)); !written) return written;
  if (Result<Done> written = write_file(scratch_folder / "result.json", text_of(json)); !written) return written;

  std::error_code error;
  for (int attempt = 0; attempt < kMoveAttempts; ++attempt) {
    fs::rename(scratch_folder, folder_of(job, item), error);
    if (!error || find_result(job, item)) return Done{};
    remove_result(job, item);  // an outdated one exists
  }
  return Error{ErrorKind::Failed, folder_of(job, item).string() + " cannot be written (" + error.message() +
                                      "); check the folder, its permissions and the free space"};
}

void remove_result(const BatchJob& job, const BatchItem& item) {
  std::error_code ignored;
  const auto now = fs::file_time_type::clock::now().time_since_epoch().count();
  const fs::path old =
      job.work_folder() / (item.folder + ".old." + std::to_string(::getpid()) + "." + std::to_string(now));
  fs::rename(folder_of(job, item), old, ignored);
  fs::remove_all(old, ignored);
}

Result<BatchTables> write_tables(const BatchJob& job) {
  Json rows = Json::array(), timings = Json::array();
  BatchTables tables;
  for (const BatchItem& item : job.items) {
    const std::optional<BatchResult> result = find_result(job, item);
    if (!result)
      return Error{ErrorKind::Failed, "the result of " + item.name + " is gone (something else writes to " +
                                          job.output.string() +
                                          ", or its input has changed meanwhile); start the batch again"};
    tables.failed += result->failed() ? 1 : 0;
    Json row{{"assembly", item.name}, {"folder", item.folder}, {"status", result->failed() ? "failed" : "done"}};
    row["error"] = result->failed() ? Json(result->error) : Json(nullptr);
    row.update(Json::parse(result->summary, nullptr, false));
    rows.push_back(std::move(row));
    const Json cost = read_json(folder_of(job, item) / "timing.json");
    timings.push_back(
        {{"assembly", item.name}, {"seconds", cost.value("seconds", 0.0)}, {"host", text_in(cost, "host")}});
  }
  tables.json = text_of({{"format", "dismantle-batch"}, {"version", 1}, {"assemblies", rows}});
  tables.tsv = tsv_of(rows);
  if (Result<Done> written = write_file(job.output / "batch.json", tables.json); !written) return written.error();
  if (Result<Done> written = write_file(job.output / "batch.tsv", tables.tsv); !written) return written.error();
  if (Result<Done> written = write_file(job.output / "timing.tsv", tsv_of(timings)); !written) return written.error();
  return tables;
}

}  // namespace dismantle::batch
