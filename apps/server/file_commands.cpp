// SPDX-License-Identifier: Apache-2.0
#include "apps/server/file_commands.h"

#include "apps/server/uploaded_files.h"
#include "dismantle/files/atomic_file.h"
#include "dismantle/files/display_name.h"
#include "dismantle/files/text_name.h"
#include "dismantle/formats/import/units.h"
#include "samples/bundled/bundled_sample.h"

#include <array>

namespace dismantle::server {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> kCommands = {"samples", "files", "recent", "open", "open_again", "cancel"};

std::string_view name_of(RootEntry::Kind kind) {
  switch (kind) {
    case RootEntry::Kind::Folder:
      return "folder";
    case RootEntry::Kind::Assembly:
      return "assembly";
    case RootEntry::Kind::Path:
      return "path";
  }
  return "";
}

/// A text member; empty if it is missing.
std::string text_member(const Json& command, const char* name) {
  const auto found = command.find(name);
  return found != command.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// An index; the largest number, which is beyond every list, if it is missing.
std::uint64_t index_member(const Json& command, const char* name) {
  const auto found = command.find(name);
  return found != command.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : ~std::uint64_t{0};
}

/// A message in which a file is called by its name alone.
std::string without_folder(std::string message, const fs::path& file) {
  for (const std::string& folder : {file.string() + "/", file.parent_path().string() + "/"})
    for (std::size_t at = 0; (at = message.find(folder, at)) != std::string::npos;) message.erase(at, folder.size());
  return message;
}

Result<Json> job_json(const Result<std::uint32_t>& job) {
  if (!job) return job.error();
  return Json{{"job", *job}};
}

}  // namespace

Result<OpenedFile> unpack_upload(const fs::path& packed, const std::string& name,
                                 std::shared_ptr<UploadFolder> folder) {
  const fs::path files = folder->path() / "files";
  if (const Result<Done> unpacked = unpack_files(packed, files); !unpacked) return unpacked.error();
  folder->set_written();
  const Result<fs::path> assembly = assembly_among(files);
  if (!assembly) return assembly.error();
  OpenedFile file{*assembly, name, std::move(folder)};
  std::error_code ignored;
  const bool is_folder = fs::is_directory(*assembly, ignored);
  if (!is_folder || (name.empty() && *assembly != files)) file.name = assembly->filename().string();
  if (file.name.empty()) file.name = "meshes";
  return file;
}

bool FileCommands::knows(std::string_view command) const {
  return std::find(kCommands.begin(), kCommands.end(), command) != kCommands.end();
}

bool FileCommands::needs_control(std::string_view command) const {
  return command == "open" || command == "open_again";
}

Result<Json> FileCommands::execute(const Json& command) {
  const std::string name = text_member(command, "command");
  if (name == "samples") return samples();
  if (name == "files") return files(command);
  if (name == "recent") return recent();
  if (name == "open") return open(command);
  if (name == "open_again") return open_again(command);
  return cancel(command);
}

Result<Json> FileCommands::samples() const {
  Json list = Json::array();
  for (const BundledSample& s : bundled_samples()) list.push_back({{"name", s.name}, {"description", s.description}});
  return Json{{"samples", std::move(list)}};
}

Result<Json> FileCommands::files(const Json& command) const {
  const auto entries = roots_.list(index_member(command, "root"), text_member(command, "folder"));
  if (!entries) return entries.error();
  Json list = Json::array();
  for (const RootEntry& e : *entries) list.push_back({{"name", e.name}, {"kind", name_of(e.kind)}, {"bytes", e.bytes}});
  return Json{{"entries", std::move(list)}};
}

std::vector<fs::path> FileCommands::recent_in_roots() const {
  std::vector<fs::path> files = recent_.list();
  std::erase_if(files, [this](const fs::path& file) { return !roots_.contains(file); });
  return files;
}

Result<Json> FileCommands::recent() const {
  Json list = Json::array();
  for (const fs::path& file : recent_in_roots())
    list.push_back({{"name", display_name(file)}, {"folder", file.parent_path().filename().string()}});
  return Json{{"recent", std::move(list)}};
}

Result<Json> FileCommands::open(const Json& command) {
  if (command.contains("recent")) {
    const std::vector<fs::path> files = recent_in_roots();
    const std::uint64_t index = index_member(command, "recent");
    if (index >= files.size())
      return Error{ErrorKind::Usage, "there is no such recent file (the list is shorter); reload the list"};
    return job_json(open_file(files[index]));
  }
  if (command.contains("sample")) return job_json(open_sample(text_member(command, "sample")));
  const Result<fs::path> file = roots_.find(index_member(command, "root"), text_member(command, "file"));
  if (!file) return file.error();
  return job_json(open_file(*file));
}

Result<Json> FileCommands::cancel(const Json& command) {
  const Result<Done> done = jobs_.cancel(static_cast<std::uint32_t>(index_member(command, "job")));
  if (!done) return done.error();
  return Json::object();
}

void FileCommands::add_reference_folders(const OpenedFile& file, ImportOptions& options) const {
  std::vector<fs::path> folders = roots_.folders();
  if (file.folder) folders = {file.folder->path()};
  options.reference_folders.insert(options.reference_folders.end(), folders.begin(), folders.end());
}

Result<std::uint32_t> FileCommands::start(std::shared_ptr<const OpenedFile> file, const std::string& units) {
  const std::string name = file->name;
  return jobs_.start(name,
                     [this, file = std::move(file), units](const ProgressCallback& progress) -> Result<Jobs::Outcome> {
                       ModelOptions options = options_;
                       if (!units.empty()) options.import.units = units;
                       add_reference_folders(*file, options.import);
                       Result<Model> model = load_model(file->path, options, progress);
                       if (!model) return Error{model.error().kind, without_folder(model.error().message, file->path)};
                       model->name = clean_name(file->name);
                       if (file->folder) model->product = clean_name(product_name(file->name));
                       if (!file->folder) recent_.add(file->path);
                       // std::function requires copyable captures.
                       return Jobs::Outcome{[this, file, shared = std::make_shared<Model>(std::move(*model))] {
                         {
                           const std::lock_guard lock(mutex_);
                           opened_ = file;
                         }
                         on_model_(std::move(*shared));
                       }};
                     });
}

Result<std::uint32_t> FileCommands::open_file(const fs::path& file) {
  return start(std::make_shared<OpenedFile>(OpenedFile{file, display_name(file), nullptr}), {});
}

Result<std::uint32_t> FileCommands::open_upload(const fs::path& file, std::shared_ptr<UploadFolder> folder) {
  return start(std::make_shared<OpenedFile>(OpenedFile{file, file.filename().string(), std::move(folder)}), {});
}

Result<std::uint32_t> FileCommands::open_unpacked(OpenedFile file) {
  return start(std::make_shared<OpenedFile>(std::move(file)), {});
}

Result<Json> FileCommands::open_again(const Json& command) {
  const std::string units = text_member(command, "units");
  if (const Result<double> known = millimetres_per_unit(units); !known) return known.error();
  std::shared_ptr<const OpenedFile> file;
  {
    const std::lock_guard lock(mutex_);
    file = opened_;
  }
  if (!file)
    return Error{ErrorKind::Usage, "there is nothing to open again (no assembly is open); open one with 'open'"};
  return job_json(start(std::move(file), units));
}

Result<std::uint32_t> FileCommands::open_sample(const std::string& name) {
  const Result<std::string> step = bundled_sample_step(name);
  if (!step) return step.error();
  const Result<std::shared_ptr<UploadFolder>> folder = uploads_.reserve({}, step->size());
  if (!folder) return folder.error();
  const fs::path file = (*folder)->path() / (name + ".step");
  if (const Result<Done> written = write_file(file, *step); !written) return written.error();
  (*folder)->set_written();
  return open_upload(file, *folder);
}

}  // namespace dismantle::server
