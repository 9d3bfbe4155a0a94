// SPDX-License-Identifier: Apache-2.0
#include "dismantle/instructions/work_instructions.h"

#include "dismantle/documents/bill_of_materials.h"
#include "dismantle/instructions/joint_notes.h"
#include "dismantle/instructions/motion_text.h"
#include "dismantle/instructions/removal_facts.h"
#include "dismantle/instructions/step_picture.h"
#include "dismantle/instructions/tool_notes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dismantle {

namespace {

using Kind = InstructionNote::Kind;

/// Minimum cosine of the angle between a motion and the line of sight that is said.
constexpr double kEndOn = 0.8;
/// Number of digits of the checksum on the cover.
constexpr std::size_t kChecksumDigits = 12;

/// The fastener that a part is, as text; empty if its name says so, or it is none.
std::string fastener_name(const std::string& name, const std::optional<Fastener>& fastener) {
  if (!fastener) return {};
  const std::string designation = designation_text(*fastener);
  return designation.empty() || name.find(designation) != std::string::npos ? std::string() : fastener_text(*fastener);
}

constexpr const char* kTimes = " \u00d7 ";

/// A text at the start of a sentence; names stay as they are.
std::string sentence_start(std::string text) {
  if (text.rfind("item ", 0) == 0) text[0] = 'I';
  return text;
}

/// Writes the texts of the steps and renders their pictures.
class Writer {
 public:
  Writer(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
         const WorkInstructionsOptions& options)
      : assembly_(assembly),
        pairs_(pairs),
        options_(options),
        is_forward_(options.direction == PathDirection::Forward),
        steps_(work_steps(assembly, timeline, options.direction)),
        fasteners_(find_fasteners(assembly, options.engine.executor)),
        bill_(bill_of_materials(assembly, fasteners_)),
        names_(assembly, bill_, options.missing_glyphs),
        lines_(assembly.components.size()),
        joints_(assembly, fasteners_, options.engine.executor),
        facts_(assembly, pairs, options.engine),
        pictures_(assembly, options.picture_width, options.picture_height, options.engine.executor) {
    for (std::size_t i = 0; i < bill_.size(); ++i)
      for (const ComponentId c : bill_[i].components) lines_[c.value] = i;
    const std::vector<ComponentId> stationary = stationary_components(assembly, steps_);
    if (!stationary.empty()) ground_ = stationary.front();
    for (const ComponentId c : stationary) result_.stationary.push_back(assembly[c].name);
  }

  Result<WorkInstructions> write() {
    result_.title = (is_forward_ ? "Disassembly of " : "Assembly of ") +
                    (options_.product.empty() ? assembly_.source_file : options_.product);
    result_.assembly = assembly_.source_file;
    if (!assembly_.source_sha256.empty())
      result_.assembly += ", SHA-256 " + assembly_.source_sha256.substr(0, kChecksumDigits);
    result_.title_block = options_.title_block;
    result_.missing_glyphs = names_.missing();
    for (std::size_t i = 0; i < bill_.size(); ++i)
      result_.parts.push_back({names_.in_list(i),
                               bill_[i].components.size(),
                               bill_[i].size,
                               {},
                               names_.of_item(i),
                               fastener_name(bill_[i].name, bill_[i].fastener)});
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (!report_progress(options_.progress, "writing instructions",
                           static_cast<double>(i) / static_cast<double>(steps_.size())))
        return Error{ErrorKind::Failed, "the instructions were not written (cancelled); run it again"};
      add(steps_[i]);
    }
    for (const Tool& tool : tools_) result_.tools.push_back(tool.text);
    result_.cover = pictures_.cover();
    result_.exploded =
        exploded_overview(assembly_, bill_, options_.picture_width, options_.picture_height, options_.engine.executor);
    report_progress(options_.progress, "writing instructions", 1);
    return std::move(result_);
  }

 private:
  void add(const WorkStep& step) {
    Instruction instruction;
    const RemovalMove& first = step.removals.front();
    const std::vector<Leg> legs = legs_of(first, bounds_of(assembly_, first.components).center());
    instruction.parts = counted(step);
    instruction.title = verb(step, legs) + " " + subject(step, instruction.parts);
    note_motion(step, legs, instruction);
    note_tools(step, legs, instruction);
    note_warnings(step, legs, instruction);
    note_clearance(step, instruction);
    note_overlaps(step, instruction);
    StepPictures pictures = pictures_.render_step(step, options_.direction);
    note_view(legs, pictures.view, instruction);
    instruction.view = pictures.view;
    instruction.picture = std::move(pictures.close);
    instruction.overview = std::move(pictures.overview);
    result_.steps.push_back(std::move(instruction));
    for (const CountedPart& part : result_.steps.back().parts)
      result_.parts[part.item].steps.push_back(result_.steps.size());
  }

  std::vector<CountedPart> counted(const WorkStep& step) const {
    std::vector<CountedPart> parts;
    for (const RemovalMove& removal : step.removals) {
      for (const ComponentId c : removal.components) {
        const std::size_t line = lines_[c.value];
        auto part = std::find_if(parts.begin(), parts.end(), [&](const CountedPart& p) { return p.item == line; });
        if (part == parts.end()) part = parts.insert(part, {line, 0});
        ++part->count;
      }
    }
    return parts;
  }

  /// The verb of a step's title; "Move" if the set does not leave its surroundings.
  std::string verb(const WorkStep& step, const std::vector<Leg>& legs) const {
    const RemovalMove& removal = step.removals.front();
    Aabb around;
    for (const ComponentId c : surroundings(step, removal))
      around.extend(bounds_of(assembly_, {&c, 1}, step.before[c.value]));
    if (overlaps(bounds_of(assembly_, removal.components, removal.poses.back()), around)) return "Move";
    if (std::any_of(legs.begin(), legs.end(), is_screwing) || is_unscrewed(step, legs))
      return is_forward_ ? "Unscrew" : "Screw in";
    return is_forward_ ? "Remove" : "Mount";
  }

  /// True for a screw, a nut or a standoff that comes out along its axis, alone or with its washers.
  bool is_unscrewed(const WorkStep& step, const std::vector<Leg>& legs) const {
    const RemovalMove& removal = step.removals.front();
    const ComponentId c = joints_.turned_in(removal);
    if (!c.valid() || legs.empty() || is_out_of_thread(c, step, legs)) return false;
    return fasteners_[c.value] && is_threaded(*fasteners_[c.value]) &&
           comes_along_axis(assembly_[c], *fasteners_[c.value], removal, legs.front());
  }

  /// True for a fastener whose counterpart is gone: a bolt without its nut.
  bool is_out_of_thread(ComponentId c, const WorkStep& step, const std::vector<Leg>& legs) const {
    return joints_.is_of_joint(c) && std::none_of(legs.begin(), legs.end(), is_screwing) && !unscrewing(step, legs);
  }

  std::string subject(const WorkStep& step, const std::vector<CountedPart>& parts) const {
    if (step.removals.size() == 1 && step.removals[0].components.size() == 1)
      return with_fastener(names_.in_title(step.removals[0].components[0]), parts.front());
    if (step.removals.size() > 1 && parts.size() > 1) {
      std::vector<std::string> names;
      names.reserve(parts.size());
      for (const CountedPart& part : parts) names.push_back(with_fastener(counted_name(result_, part), part));
      return list_text(names);
    }
    if (step.removals.size() > 1)
      return with_fastener(std::to_string(parts.front().count) + kTimes + names_.item_in_title(parts.front().item),
                           parts.front());
    if (const std::optional<std::string> name = name_of_body(step.removals[0].components))
      if (std::string shown = names_.of_body(*name); !shown.empty()) return shown;
    std::vector<std::string> names;
    names.reserve(parts.size());
    for (const CountedPart& part : parts)
      names.push_back(part.count > 1 ? counted_name(result_, part) : name_of_one(step.removals[0], part.item));
    return list_text(names) + (joints_.turned_in(step.removals[0]).valid() ? "" : " together");
  }

  /// A name with what fastener the part is.
  std::string with_fastener(const std::string& name, const CountedPart& part) const {
    const std::string& fastener = result_.parts[part.item].fastener;
    return fastener.empty() ? name : name + " (" + fastener + ")";
  }

  /// Name of the only component of a removal on a line of the bill of materials.
  std::string name_of_one(const RemovalMove& removal, std::size_t line) const {
    return names_.of(*std::find_if(removal.components.begin(), removal.components.end(),
                                   [&](ComponentId c) { return lines_[c.value] == line; }));
  }

  /// Name of the node of the product tree that contains exactly these components, if there is one.
  std::optional<std::string> name_of_body(const std::vector<ComponentId>& components) const {
    std::vector<std::size_t> inside(assembly_.tree.size()), all(assembly_.tree.size());
    const auto count = [&](ComponentId c, std::vector<std::size_t>& counts) {
      for (std::uint32_t node = assembly_[c].tree_node; node != 0; node = assembly_.tree[node].parent) ++counts[node];
    };
    for (const ComponentId c : components) count(c, inside);
    for (std::uint32_t c = 0; c < assembly_.components.size(); ++c) count(ComponentId(c), all);
    for (std::size_t node = 1; node < inside.size(); ++node)
      if (inside[node] == components.size() && all[node] == inside[node]) return assembly_.tree[node].name;
    return {};
  }

  /// How the first removal of a step unscrews a fastener.
  std::optional<Unscrewing> unscrewing(const WorkStep& step, const std::vector<Leg>& legs) const {
    return legs.empty() ? std::nullopt : joints_.unscrewing(step, step.removals.front(), legs.front());
  }

  void note_motion(const WorkStep& step, const std::vector<Leg>& legs, Instruction& instruction) const {
    std::string text = motion_text(legs, options_.direction);
    if (const std::optional<Unscrewing> turn = unscrewing(step, legs)) {
      std::string turning = is_forward_ ? unscrewing_text(*turn) : screwing_in_text(*turn);
      turning[0] = static_cast<char>(turning[0] - 'a' + 'A');
      text = is_forward_ ? turning + ". " + text : text + " " + turning + ".";
    }
    if (step.removals.size() > 1)
      text += is_forward_ ? " Remove one at a time, all in the same direction."
                          : " Mount one at a time, all in the same direction.";
    instruction.notes.push_back({Kind::Motion, text});
  }

  /// Says it where the picture shows the motion nearly end on.
  void note_view(const std::vector<Leg>& legs, const Vec3& view, Instruction& instruction) const {
    if (legs.empty()) return;
    const double away = dot(legs.front().direction, view) * (legs.front().length < 0 ? -1 : 1) * (is_forward_ ? 1 : -1);
    if (std::abs(away) < kEndOn) return;
    for (InstructionNote& note : instruction.notes)
      if (note.kind == Kind::Motion)
        note.text += away < 0 ? " In the picture: towards you." : " In the picture: away from you.";
  }

  void note_tools(const WorkStep& step, const std::vector<Leg>& legs, Instruction& instruction) {
    const RemovalMove& removal = step.removals.front();
    const ComponentId c = joints_.turned_in(removal);
    if (!c.valid() || legs.empty() || is_out_of_thread(c, step, legs)) return;
    const ToolNotes notes = tool_notes(assembly_[c], fasteners_[c.value], removal, legs, options_.direction);
    for (const Tool& tool : notes.tools) instruction.notes.push_back({Kind::Tool, tool.text});
    // The turns of a joint tell more than its thread.
    if (!unscrewing(step, legs))
      for (const std::string& thread : notes.threads) instruction.notes.push_back({Kind::Warning, thread});
    tools_.insert(notes.tools.begin(), notes.tools.end());
  }

  void note_warnings(const WorkStep& step, const std::vector<Leg>& legs, Instruction& instruction) {
    const auto warn = [&](const std::string& text) { instruction.notes.push_back({Kind::Warning, text}); };
    const std::size_t count = step.removals.front().components.size();
    if (count > 1 && !joints_.turned_in(step.removals.front()).valid())
      warn((is_forward_ ? "Remove these " : "Mount these ") + std::to_string(count) + " parts as a unit.");
    if (is_forward_ && !legs.empty() && legs.front().angle == 0 && direction_words(legs.front().direction) == "down")
      warn("Comes out downwards: support it by hand.");
    note_joints(step, legs, instruction);
    const std::vector<ComponentId> falling = facts_.unsupported_after(step, ground_);
    if (falling.empty()) return;
    const std::string are = falling.size() == 1 ? " is" : " are", them = falling.size() == 1 ? "it" : "them";
    warn(sentence_start(counted_list(falling)) + are +
         (is_forward_ ? " unsupported after this step. Support " + them + " first."
                      : " unsupported before this step. Support " + them + " until the step is complete."));
  }

  /// Components in running text; those of one item together.
  std::string counted_list(const std::vector<ComponentId>& components) const {
    std::map<std::size_t, std::vector<ComponentId>> by_line;
    for (const ComponentId c : components) by_line[lines_[c.value]].push_back(c);
    std::vector<std::string> each;
    each.reserve(by_line.size());
    for (const auto& [line, equal] : by_line) each.push_back(counted(equal, line));
    return list_text(each);
  }

  /// Warns of fasteners that still hold what moves.
  void note_joints(const WorkStep& step, const std::vector<Leg>& legs, Instruction& instruction) const {
    if (legs.empty()) return;
    std::vector<std::string> names;
    for (const ComponentId c : joints_.still_held_by(step, step.removals.front(), legs.front()))
      names.push_back(names_.of(c));
    if (names.empty()) return;
    instruction.notes.push_back(
        {Kind::Warning, is_forward_ ? "Still held by " + list_text(names) + ": loosen that first, if you can."
                                    : "Already held by " + list_text(names) + ": fasten that last, if you can."});
  }

  void note_clearance(const WorkStep& step, Instruction& instruction) {
    PathClearance closest = facts_.clearance(step, step.removals.front());
    for (std::size_t i = 1; i < step.removals.size(); ++i) {
      const PathClearance other = facts_.clearance(step, step.removals[i]);
      if (other.min_distance < closest.min_distance) {
        closest.min_distance = other.min_distance;
        closest.nearest = other.nearest;
      }
      if (other.contact_length > closest.contact_length) {
        closest.contact_length = other.contact_length;
        closest.last_contact = other.last_contact;
      }
    }
    std::string text;
    if (closest.last_contact.valid() && closest.contact_length > 0) {
      text = "Slides along " + names_.of(closest.last_contact) +
             (is_forward_ ? " for about the first " : " for about the last ") + number_text(closest.contact_length) +
             " mm.";
    } else if (closest.last_contact.valid()) {
      text = "Touches " + names_.of(closest.last_contact) + (is_forward_ ? " at the start." : " at the end.");
    }
    if (closest.nearest.valid())
      text += std::string(text.empty() ? "" : " ") + "Minimum clearance to " + names_.of(closest.nearest) + ": " +
              number_text(closest.min_distance) + " mm.";
    if (!text.empty()) instruction.notes.push_back({Kind::Clearance, text});
  }

  /// One sentence for each kind of part that a step moves, with all that it overlaps.
  void note_overlaps(const WorkStep& step, Instruction& instruction) const {
    for (const PartOverlaps& part : overlaps_of(step, pairs_, lines_)) {
      const std::string name = sentence_start(counted(part.own, part.line));
      std::vector<std::string> others, not_checked;
      for (const PartOverlaps::With& o : part.with) {
        std::string other = counted(o.components, o.line);
        if (o.state == PairState::Free) {
          not_checked.push_back(other);
          continue;
        }
        const std::string depth = number_text(o.depth);
        other += number_text(o.least) == depth ? " by " : " by up to ";
        other += depth + " mm";
        others.push_back(other);
      }
      if (!others.empty())
        instruction.notes.push_back({Kind::Overlap, name + (part.own.size() > 1 ? " overlap " : " overlaps ") +
                                                        list_text(others) +
                                                        ": press fit, thread, or an error of the model."});
      if (!not_checked.empty())
        instruction.notes.push_back({Kind::Overlap, name + " and " + list_text(not_checked) +
                                                        ": collision is not checked until they are apart."});
    }
  }

  /// Components of one item in running text.
  std::string counted(const std::vector<ComponentId>& components, std::size_t line) const {
    return components.size() == 1 ? names_.of(components[0]) : counted_name(result_, {line, components.size()});
  }

  const Assembly& assembly_;
  const PairStates& pairs_;
  const WorkInstructionsOptions& options_;
  bool is_forward_;
  std::vector<WorkStep> steps_;
  std::vector<std::optional<Fastener>> fasteners_;  // of each component
  std::vector<BillItem> bill_;
  InstructionNames names_;
  std::vector<std::size_t> lines_;  // line of the bill of materials of each component
  JointNotes joints_;
  RemovalFacts facts_;
  StepPictureRenderer pictures_;
  ComponentId ground_;
  std::set<Tool> tools_;  // of all steps
  WorkInstructions result_;
};

}  // namespace

Result<WorkInstructions> work_instructions(const Assembly& assembly, const PairStates& pairs, const Timeline& timeline,
                                           const WorkInstructionsOptions& options) {
  if (timeline.moves().empty())
    return Error{ErrorKind::Usage, "there are no steps to describe (the path has no moves); give a path with moves"};
  return Writer(assembly, pairs, timeline, options).write();
}

}  // namespace dismantle
