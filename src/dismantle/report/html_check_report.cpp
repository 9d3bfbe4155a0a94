// SPDX-License-Identifier: Apache-2.0
#include "dismantle/report/html_check_report.h"

#include "dismantle/documents/check_report.h"
#include "dismantle/files/number_text.h"
#include "dismantle/report/check_page.h"
#include "dismantle/report/check_pictures.h"
#include "dismantle/report/html_text.h"

#include <algorithm>
#include <cstdio>

namespace dismantle {

namespace {

/// A table cell that sorts by its exact value; a dash that sorts last if the value does not apply to the pair.
std::string number_cell(double value, bool applies) {
  char exact[64];
  std::snprintf(exact, sizeof exact, "%.17g", value);
  return applies ? std::string("<td class=\"n\" data-v=\"") + exact + "\">" + number_text(value, 4) + "</td>"
                 : "<td class=\"n\" data-v=\"-1\">–</td>";
}

std::string place_text(Vec3 p) {
  constexpr double kResolution = 0.01;  // [mm]
  const auto text = [](double x) { return number_text(x, 9, kResolution); };
  return text(p.x) + ", " + text(p.y) + ", " + text(p.z);
}

std::string place_cell(Vec3 p) {
  return "<td class=\"n\">" + place_text(p) + "</td>";
}

std::string picture(const Image& image, const std::string& alternative) {
  return "<img src=\"" + png_data_url(encode_png(image)) + "\" width=\"" + std::to_string(image.width) +
         "\" height=\"" + std::to_string(image.height) + "\" alt=\"" + html_escaped(alternative) + "\"/>";
}

std::string state_badge(ClashState state) {
  const std::string name(name_of(state));
  return "<span class=\"state " + name + "\">" + name + "</span>";
}

bool overlaps(const Clash& c) {
  return c.state == ClashState::Overlapping;
}

/// Writes the page from top to bottom.
class PageWriter {
 public:
  PageWriter(const Assembly& assembly, const Clashes& clashes, const HtmlCheckOptions& options)
      : assembly_(assembly),
        clashes_(clashes),
        options_(options),
        pairs_(worst_first(clashes)),
        pictures_(assembly, options.picture_width, options.picture_height, options.executor) {
    const auto deep = static_cast<std::size_t>(std::count_if(pairs_.begin(), pairs_.end(), overlaps));
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
    const ClashCounts counts = count_clashes(clashes_);
    const auto card = [&](const std::string& value, const char* label, const char* style) {
      page_ += std::string("<div class=\"card ") + style + "\"><b>" + value + "</b><span>" + label + "</span></div>";
    };
    page_ += "<div class=\"cards\">";
    card(std::to_string(assembly_.components.size()), "components", "");
    card(std::to_string(triangle_count(assembly_)), "triangles", "");
    card(number_text(clashes_.tolerance, 4) + " mm", "tolerance", "");
    card(std::to_string(counts.overlapping), "overlapping", "overlapping");
    if (counts.contained > 0) card(std::to_string(counts.contained), "one inside the other", "overlapping");
    card(std::to_string(counts.contact), "contact", "contact");
    card(std::to_string(counts.near), "near", "near");
    page_ += "</div>\n<dl>";
    for (const ClashState state : {ClashState::Overlapping, ClashState::Contact, ClashState::Near})
      page_ += "<dt>" + state_badge(state) + "</dt><dd>" + std::string(explanation_of(state)) + "</dd>";
    page_ += "</dl>\n";
  }

  bool write_overviews() {
    if (!report(0)) return false;
    page_ += "<section class=\"pictures\"><figure>" + picture(pictures_.overview(), "The assembly") +
             "<figcaption>The assembly</figcaption></figure>\n";
    if (!report(1)) return false;
    if (closeups_ > 0) {
      std::vector<Clash> deep;
      std::copy_if(pairs_.begin(), pairs_.end(), std::back_inserter(deep), overlaps);
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
  std::string names(const Clash& p) const {
    std::string text = assembly_[p.a].name + " and ";
    return text += assembly_[p.b].name;
  }

  /// A table cell that sorts by the depth.
  std::string depth_cell(const Clash& c, bool applies) const {
    if (!applies) return number_cell(c.depth, false);
    char exact[64];
    std::snprintf(exact, sizeof exact, "%.17g", c.depth);
    return std::string("<td class=\"n\" data-v=\"") + exact + "\">" + depth_text(c, clashes_.tolerance) + "</td>";
  }

  std::string inside_text(const Clash& c) const {
    return c.contained.valid() ? "; " + name(c.contained) + " is wholly inside the other component" : "";
  }

  void write_table() {
    page_ += kTableStart;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const Clash& p = pairs_[i];
      const bool meets = p.state != ClashState::Near;
      const std::string rank = std::to_string(i + 1);
      page_ += "<tr><td class=\"n\" data-v=\"" + rank + "\">";
      page_ += i < closeups_ ? link_to_pair(rank) : rank;
      page_ += "</td><td>" + name(p.a) + "</td><td>" + name(p.b) + "</td><td>" + state_badge(p.state) + "</td>" +
               depth_cell(p, meets) + place_cell(p.deepest_at) + number_cell(p.volume, overlaps(p)) +
               number_cell(p.distance, p.distance > 0) + "</tr>\n";
    }
    page_ += "</tbody></table></section>\n";
  }

  bool write_closeups() {
    if (closeups_ == 0) return report(2);
    page_ += "<section><h2>Overlaps, worst first</h2><div class=\"pictures\">\n";
    for (std::size_t i = 0; i < closeups_; ++i) {
      if (!report(i + 2)) return false;
      const Clash& p = pairs_[i];
      const std::string rank = std::to_string(i + 1);
      page_ += "<figure id=\"pair-" + rank + "\">" + picture(pictures_.closeup(p), names(p));
      page_ += "<figcaption><b>" + rank + "</b> <i class=\"a\">" + name(p.a) + "</i> and <i class=\"b\">" + name(p.b);
      page_ += "</i>: " + state_badge(p.state) + " depth " + depth_text(p, clashes_.tolerance) +
               " mm at <i class=\"d\">" + place_text(p.deepest_at) + "</i>" + inside_text(p) +
               "</figcaption></figure>\n";
    }
    page_ += "</div></section>\n";
    return report(closeups_ + 2);
  }

  const Assembly& assembly_;
  const Clashes& clashes_;
  const HtmlCheckOptions& options_;
  std::vector<Clash> pairs_;
  CheckPictures pictures_;
  std::size_t closeups_ = 0;
  std::string page_;
};

}  // namespace

Result<std::string> html_check_report(const Assembly& assembly, const Clashes& clashes,
                                      const HtmlCheckOptions& options) {
  return PageWriter(assembly, clashes, options).write();
}

}  // namespace dismantle
