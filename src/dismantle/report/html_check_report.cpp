// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/html_check_report.h"

#include "dismantle/documents/check_report.h"
#include "dismantle/report/check_page.h"
#include "dismantle/report/check_pictures.h"
#include "dismantle/report/html_text.h"

#include <algorithm>
#include <cstdio>

namespace dismantle {

namespace {

std::string number(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// A table cell that sorts by its exact value; a dash that sorts last if the value does not apply to the pair.
std::string number_cell(double value, bool applies) {
  char exact[64];
  std::snprintf(exact, sizeof exact, "%.17g", value);
  return applies ? std::string("<td class=\"n\" data-v=\"") + exact + "\">" + number(value) + "</td>"
                 : "<td class=\"n\" data-v=\"-1\">–</td>";
}

std::string picture(const Image& image, const std::string& alternative) {
  return "<img src=\"" + png_data_url(encode_png(image)) + "\" width=\"" + std::to_string(image.width) +
         "\" height=\"" + std::to_string(image.height) + "\" alt=\"" + html_escaped(alternative) + "\"/>";
}

std::string state_badge(PairState state) {
  const std::string name(name_of(state));
  return "<span class=\"state " + name + "\">" + name + "</span>";
}

bool overlaps_deeply(const ComponentPair& p) {
  return p.state == PairState::Embedded || p.state == PairState::Fit;
}

/// Writes the page from top to bottom.
class PageWriter {
 public:
  PageWriter(const Assembly& assembly, const PairStates& states, const HtmlCheckOptions& options)
      : assembly_(assembly),
        states_(states),
        options_(options),
        pairs_(worst_first(states)),
        pictures_(assembly, options.picture_width, options.picture_height, options.executor) {
    const auto deep = static_cast<std::size_t>(std::count_if(pairs_.begin(), pairs_.end(), overlaps_deeply));
    closeups_ = std::min(options.pictures, deep);
  }

  Result<std::string> write() {
    const std::string title = "Clash report: " + html_escaped(assembly_.source_file);
    page_ = std::string(kPageStart) + "<title>" + title + "</title>\n<style>" + kPageStyle + "</style>\n</head>\n" +
            "<body>\n<header><h1>" + title + "</h1>";
    write_summary();
    page_ += "</header>\n";
    if (!write_overviews()) return cancelled();
    write_table();
    if (!write_closeups()) return cancelled();
    page_ +=
        std::string("<footer>") + kPageFooter + "</footer>\n<script>" + kPageScript + "</script>\n</body>\n</html>\n";
    return std::move(page_);
  }

 private:
  static Error cancelled() { return {ErrorKind::Failed, "the HTML report was not written (cancelled); run it again"}; }

  /// Reports progress; false if cancelled.
  bool report(std::size_t pictures_done) const {
    return report_progress(options_.progress, "rendering pictures",
                           static_cast<double>(pictures_done) / static_cast<double>(closeups_ + 2));
  }

  std::string name(ComponentId id) const { return html_escaped(assembly_[id].name); }

  void write_summary() {
    const PairCounts counts = count_pairs(states_);
    const auto card = [&](const std::string& value, const char* label, const char* style) {
      page_ += std::string("<div class=\"card ") + style + "\"><b>" + value + "</b><span>" + label + "</span></div>";
    };
    page_ += "<div class=\"cards\">";
    card(std::to_string(assembly_.components.size()), "components", "");
    card(std::to_string(triangle_count(assembly_)), "triangles", "");
    card(number(states_.tolerance) + " mm", "tolerance", "");
    card(std::to_string(counts.embedded), "embedded", "embedded");
    card(std::to_string(counts.fit), "fit", "fit");
    card(std::to_string(counts.contact), "contact", "contact");
    card(std::to_string(counts.near), "near", "near");
    page_ += "</div>\n<dl>";
    for (const PairState state : {PairState::Embedded, PairState::Fit, PairState::Contact, PairState::Near})
      page_ += "<dt>" + state_badge(state) + "</dt><dd>" + std::string(explanation_of(state)) + "</dd>";
    page_ += "</dl>\n";
  }

  bool write_overviews() {
    if (!report(0)) return false;
    page_ += "<section class=\"pictures\"><figure>" + picture(pictures_.overview(), "The assembly") +
             "<figcaption>The assembly</figcaption></figure>\n";
    if (!report(1)) return false;
    if (closeups_ > 0) {
      std::vector<ComponentPair> deep;
      std::copy_if(pairs_.begin(), pairs_.end(), std::back_inserter(deep), overlaps_deeply);
      page_ += "<figure>" + picture(pictures_.overlaps(deep), "Overlapping components") +
               "<figcaption>Overlaps: intersection curves in <i class=\"o\">red</i></figcaption></figure>\n";
    }
    page_ += "</section>\n";
    return true;
  }

  static std::string link_to_pair(const std::string& rank) {
    std::string link = "<a href=\"#pair-" + rank;
    link += "\">" + rank;
    return link += "</a>";
  }

  /// Alternative text of a close-up.
  std::string names(const ComponentPair& p) const {
    std::string text = assembly_[p.a].name + " and ";
    return text += assembly_[p.b].name;
  }

  void write_table() {
    page_ += kTableStart;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const ComponentPair& p = pairs_[i];
      const bool meets = p.state != PairState::Near;
      const std::string rank = std::to_string(i + 1);
      page_ += "<tr><td class=\"n\" data-v=\"" + rank + "\">";
      page_ += i < closeups_ ? link_to_pair(rank) : rank;
      page_ += "</td><td>" + name(p.a) + "</td><td>" + name(p.b) + "</td><td>" + state_badge(p.state) + "</td>" +
               number_cell(p.penetration, meets) +
               number_cell(p.allowed_penetration, p.state == PairState::Contact || p.state == PairState::Fit) +
               number_cell(p.distance, !meets) + number_cell(static_cast<double>(p.triangle_pairs), meets) + "</tr>\n";
    }
    page_ += "</tbody></table></section>\n";
  }

  bool write_closeups() {
    if (closeups_ == 0) return report(2);
    page_ += "<section><h2>Overlaps, worst first</h2><div class=\"pictures\">\n";
    for (std::size_t i = 0; i < closeups_; ++i) {
      if (!report(i + 2)) return false;
      const ComponentPair& p = pairs_[i];
      const std::string rank = std::to_string(i + 1);
      page_ += "<figure id=\"pair-" + rank + "\">" + picture(pictures_.closeup(p), names(p));
      page_ += "<figcaption><b>" + rank + "</b> <i class=\"a\">" + name(p.a) + "</i> and <i class=\"b\">" + name(p.b);
      page_ += "</i>: " + state_badge(p.state) + " depth " + number(p.penetration) + " mm</figcaption></figure>\n";
    }
    page_ += "</div></section>\n";
    return report(closeups_ + 2);
  }

  const Assembly& assembly_;
  const PairStates& states_;
  const HtmlCheckOptions& options_;
  std::vector<ComponentPair> pairs_;
  CheckPictures pictures_;
  std::size_t closeups_ = 0;
  std::string page_;
};

}  // namespace

Result<std::string> html_check_report(const Assembly& assembly, const PairStates& states,
                                      const HtmlCheckOptions& options) {
  return PageWriter(assembly, states, options).write();
}

}  // namespace dismantle
