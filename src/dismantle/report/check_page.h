// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle {

// The fixed parts of the clash report's HTML page. They are also well-formed XML: scripts contain no '<' and '&'.

/// Start of the document, up to its title.
inline constexpr const char* kPageStart = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="generator" content="dismantle"/>
)";

/// Style sheet.
inline constexpr const char* kPageStyle = R"(
:root { --ink: #1c2430; --soft: #5c6675; --line: #dde2e8; --paper: #ffffff; --ground: #f4f6f8; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1360px; padding: 24px; background: var(--ground); color: var(--ink);
  font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 24px; margin: 0 0 16px; overflow-wrap: anywhere; }
h2 { font-size: 18px; margin: 32px 0 12px; }
.cards { display: flex; flex-wrap: wrap; gap: 12px; }
.card { background: var(--paper); border: 1px solid var(--line); border-top: 4px solid #9aa5b4; border-radius: 6px;
  padding: 10px 16px; min-width: 110px; }
.card b { display: block; font-size: 22px; font-variant-numeric: tabular-nums; }
.card span { color: var(--soft); font-size: 13px; }
.card.overlapping { border-top-color: #c62828; }
.card.contact { border-top-color: #2e7d4f; } .card.near { border-top-color: #3a6ea5; }
.state { display: inline-block; border-radius: 10px; padding: 1px 10px; font-size: 13px; color: #ffffff; }
.state.overlapping { background: #c62828; }
.state.contact { background: #2e7d4f; } .state.near { background: #3a6ea5; }
dl { display: grid; grid-template-columns: max-content auto; gap: 4px 12px; margin: 16px 0; color: var(--soft); }
dd { margin: 0; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 520px), 1fr)); gap: 16px; }
figure { margin: 0; background: var(--paper); border: 1px solid var(--line); border-radius: 6px; overflow: hidden; }
figure:target { outline: 3px solid #3a6ea5; }
img { display: block; width: 100%; height: auto; }
figcaption { padding: 8px 12px; border-top: 1px solid var(--line); overflow-wrap: anywhere; }
i { font-style: normal; } i::before { content: ""; display: inline-block; width: 10px; height: 10px;
  border-radius: 2px; margin-right: 4px; }
i.a::before { background: #eda840; } i.b::before { background: #5c94db; } i.o::before { background: #d9051a; }
i.d::before { background: #111111; border-radius: 50%; }
table { border-collapse: collapse; width: 100%; background: var(--paper); border: 1px solid var(--line); }
th, td { padding: 6px 10px; border-bottom: 1px solid var(--line); text-align: left; overflow-wrap: anywhere; }
th { background: #e9edf2; white-space: nowrap; position: sticky; top: 0; }
th button { all: unset; cursor: pointer; font-weight: 600; } th button:focus-visible { outline: 2px solid #3a6ea5; }
th[aria-sort=ascending] button::after { content: " \25B2"; }
th[aria-sort=descending] button::after { content: " \25BC"; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
tbody tr:hover { background: #f0f4fa; }
.tools { display: flex; flex-wrap: wrap; gap: 12px; align-items: center; margin-bottom: 10px; }
input { font: inherit; padding: 6px 10px; border: 1px solid #b9c2cd; border-radius: 6px; min-width: 260px; }
footer { margin-top: 32px; color: var(--soft); font-size: 13px; }
@media print { body { background: #ffffff; max-width: none; } .tools { display: none; } figure { break-inside: avoid; } }
)";

/// Start of the table of pairs: search field and column headers.
inline constexpr const char* kTableStart = R"(<section><h2>Pairs</h2>
<div class="tools"><input id="search" type="search" placeholder="Search names and states"
aria-label="Search names and states"/><span id="shown"></span></div>
<table id="pairs"><thead><tr><th class="n"><button>#</button></th><th><button>Component</button></th>
<th><button>Other component</button></th><th><button>State</button></th><th class="n"><button>Depth [mm]</button></th>
<th class="n"><button>Deepest at [mm]</button></th><th class="n"><button>Volume [mm³]</button></th>
<th class="n"><button>Distance [mm]</button></th>
</tr></thead><tbody>
)";

/// Text of the footer.
inline constexpr const char* kPageFooter =
    R"(Depth: the greatest distance from a point of either surface that is inside the other component to that
component's surface; an upper bound, at most 1% or a tenth of the tolerance above it. Volume: in common, estimated to
about 1%. Written by dismantle.)";

/// Script that sorts and filters the table.
inline constexpr const char* kPageScript = R"(
"use strict";
(function () {
  var body = document.querySelector("#pairs tbody");
  var rows = Array.from(body.rows);
  var heads = Array.from(document.querySelectorAll("#pairs th"));
  var search = document.getElementById("search");
  var shown = document.getElementById("shown");
  function valueOf(row, column) {
    var cell = row.cells[column];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  }
  function compare(a, b) {
    return typeof a === "number" ? a - b : a.localeCompare(b, undefined, {numeric: true});
  }
  heads.forEach(function (head, column) {
    head.firstElementChild.addEventListener("click", function () {
      var ascending = head.getAttribute("aria-sort") !== "ascending";
      heads.forEach(function (other) { other.removeAttribute("aria-sort"); });
      head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
      rows.sort(function (p, q) {
        return (ascending ? 1 : -1) * compare(valueOf(p, column), valueOf(q, column));
      });
      rows.forEach(function (row) { body.appendChild(row); });
    });
  });
  function filter() {
    var words = search.value.toLowerCase().split(/\s+/);
    var count = 0;
    rows.forEach(function (row) {
      var text = row.textContent.toLowerCase();
      row.hidden = !words.every(function (word) { return text.includes(word); });
      count += row.hidden ? 0 : 1;
    });
    shown.textContent = count + " of " + rows.length + " pairs";
  }
  search.addEventListener("input", filter);
  filter();
})();
)";

}  // namespace dismantle
