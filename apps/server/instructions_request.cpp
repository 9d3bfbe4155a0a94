// SPDX-License-Identifier: Apache-2.0
#include "apps/server/instructions_request.h"

#include "apps/server/command_arguments.h"
#include "apps/server/export_request.h"
#include "apps/server/search.h"

#include <utility>

namespace dismantle::server {

namespace {

/// Sets the title block and the product's name. Errors: Usage, with the name of a wrong member.
Result<Done> read_titles(const Arguments& in, WorkInstructionsOptions& content) {
  TitleBlock& block = content.title_block;
  for (const auto& [name, member] :
       {std::pair("product", &content.product), std::pair("number", &block.number),
        std::pair("revision", &block.revision), std::pair("author", &block.author), std::pair("date", &block.date)}) {
    Result<std::string> text = in.optional_text(name);
    if (!text) return text.error();
    *member = std::move(*text);
  }
  return Done{};
}

}  // namespace

Result<InstructionsRequest> instructions_request(const Json& command, const Model& model) {
  const Arguments in(command, model.assembly->components.size());
  const Result<std::string> format = in.choice("format", {"html", "pdf"});
  if (!format) return format.error();
  const Result<std::string> paper = in.choice("paper", {"a4", "letter"});
  if (!paper) return paper.error();
  const Result<bool> reverse = in.flag("reverse");
  if (!reverse) return reverse.error();
  const Result<PlaybackSource> source = in.source();
  if (!source) return source.error();
  Result<Path> path = exported_path(model, *source);
  if (!path) return path.error();
  if (path->moves.empty()) return no_moves();

  InstructionsRequest request{model.assembly, model.session->pairs(), std::move(*path), {}};
  request.options.format = *format == "pdf" ? ExportFormat::InstructionsPdf : ExportFormat::InstructionsHtml;
  request.options.paper = *paper == "letter" ? kPaperLetter : kPaperA4;
  request.options.time = creation_time();
  WorkInstructionsOptions& content = request.options.content;
  content.direction = *reverse ? PathDirection::Reversed : PathDirection::Forward;
  content.engine = engine_beside(model.session->options());
  content.engine.prepared = model.session->engine().surfaces();
  if (const Result<Done> read = read_titles(in, content); !read) return read.error();
  if (content.product.empty()) content.product = model.product;
  return request;
}

Result<MadeInstructions> make_instructions(const InstructionsRequest& request, const ProgressCallback& progress) {
  const Result<Timeline> timeline = Timeline::of_path(*request.assembly, request.path);
  if (!timeline) return timeline.error();
  InstructionsFileOptions options = request.options;
  options.content.progress = progress;
  Result<InstructionsFile> file = instructions_file(*request.assembly, request.pairs, *timeline, std::move(options));
  if (!file) return file.error();
  return MadeInstructions{request.options.format, std::make_shared<const std::string>(std::move(file->bytes)),
                          std::move(file->notes)};
}

}  // namespace dismantle::server
