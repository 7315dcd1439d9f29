#include "server/papers/report.hpp"

#include <cmath>
#include <map>

#include "engine/core/describe.hpp"
#include "engine/papers/chinese.hpp"
#include "server/cli/report.hpp"
#include "server/papers/report_basis.hpp"
#include "server/papers/scale.hpp"
#include "server/papers/svg.hpp"

namespace vigil::papers {
namespace {

const char* const kStyle = R"(<style>
:root{color-scheme:light}body{font:15px/1.5 system-ui,sans-serif;color:#1c2330;background:#fff;max-width:1000px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem}h2{font-size:1.1rem;margin:2.5rem 0 .2rem;border-top:1px solid #d5dae2;padding-top:1rem}
table{border-collapse:collapse;width:100%;font-size:13px;margin:.6rem 0}td,th{text-align:left;padding:.2rem .5rem;border-bottom:1px solid #e4e8ee;vertical-align:top}
td.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}.meta,.legend{color:#5a6473;font-size:12.5px;margin:.2rem 0}
.verdict{font-weight:600}.reproduced{color:#0b6b3a}.corrected{color:#8a5a00}.not{color:#a3202a}
.panels{display:flex;flex-wrap:wrap;gap:.8rem}figure{margin:0;flex:1 1 440px;max-width:480px}svg{width:100%;height:auto;font-size:10.5px;fill:#5a6473}
svg .title{fill:#1c2330}.grid{stroke:#e8ebf0;stroke-width:1}path,line{fill:none;stroke-width:1.3}path.dashed{stroke-dasharray:5 3}
.legend span{margin-right:.9rem}.legend i{display:inline-block;width:.8rem;height:.2rem;margin:0 .3rem .2rem 0}.edge{stroke:#b4bcc8}
h3{font-size:1rem;margin:1.6rem 0 .2rem}code{font-size:.92em;overflow-wrap:anywhere}summary{cursor:pointer;color:#5a6473;font-size:12.5px}
.equation{overflow-x:auto;margin:.5rem 0}.equation p{margin:0;font-size:13px}math{font-size:1.05em;padding:.15rem 0}
.tex-aligned mtd:nth-child(odd){text-align:right}.tex-aligned mtd:nth-child(even),.tex-cases mtd{text-align:left}
)";

/// Colours that differ in lightness, too.
constexpr const char* kColours[] = {"#1f4e9c", "#c2452d", "#2f8f5b", "#8a4fa3", "#b07d00",
                                    "#1b8a9e", "#d0568f", "#5b6573", "#7fa32a"};

std::string style() {
  std::string text = kStyle;
  int i = 0;
  for (const char* colour : kColours) {
    const std::string name = ".c" + std::to_string(i++), value = colour;
    text += "path" + name + ",line" + name + "{stroke:" + value + "}circle" + name + "{fill:" + value + "}i" + name +
            "{background:" + value + "}";
  }
  return text + "</style>";
}

const char* class_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "verdict reproduced";
    case Verdict::corrected:
      return "verdict corrected";
    case Verdict::not_reproduced:
      break;
  }
  return "verdict not";
}

std::string verdict_html(Verdict verdict) {
  return std::string("<span class=\"") + class_of(verdict) + "\">" + std::string(to_string(verdict)) + "</span>";
}

std::string number(double value) { return std::isfinite(value) ? tick_text(value) : "-"; }

std::string with_error(const Estimate& estimate) {
  return number(estimate.value) + (std::isfinite(estimate.se) ? " ± " + tick_text(estimate.se) : "");
}

std::string paper_text(const Json& paper) {
  if (paper.is_number()) return tick_text(paper.get<double>());
  return paper.is_string() ? paper.get<std::string>() : "-";
}

std::string band(const Claim& claim) {
  if (std::isinf(claim.high) || claim.high >= 1e9) return "≥ " + tick_text(claim.low);
  return tick_text(claim.low) + " to " + tick_text(claim.high);
}

std::string claim_row(const Claim& claim) {
  return "<tr><td>" + std::string(to_string(claim.reading)) + "</td><td>" + escaped(claim.what) + "</td><td>" +
         escaped(paper_text(claim.paper)) + "</td><td class=\"n\">" + with_error(claim.ours) + "</td><td class=\"n\">" +
         band(claim) + "</td><td>" + (claim.holds() ? "holds" : "does not hold") + "</td></tr>";
}

std::string chinese_html(const Item& item) {
  const ItemWords* words = chinese_words(item.key);
  if (words == nullptr) return "";
  return "<p lang=\"zh-CN\">" + marked(std::string(words->reason)) + "</p><p class=\"meta\" lang=\"zh-CN\">" +
         marked(std::string(words->rule)) + "</p>";
}

std::string item_html(const Measured& one) {
  const Item& item = *one.item;
  const std::string key = escaped(item.key);
  std::string html = "<h2 id=\"" + key + "\">" + key + " · " + escaped(item.title.en) + "</h2><p class=\"meta\">" +
                     escaped(item.title.zh) + " · specification: " + escaped(item.spec) + " · scenario <code>" +
                     escaped(item.scenario) + "</code> · " + std::to_string(one.findings.runs) + " runs" +
                     (one.made.empty() ? "" : " · " + escaped(one.made)) + "</p><p>" +
                     verdict_html(verdict_of(one.findings)) + ". " + marked(item.reason) + "</p>" + chinese_html(item);
  html += "<p class=\"meta\">" + marked(item.rule) + "</p><table><tr><th>reading</th><th>what</th><th>paper</th>" +
          "<th>ours</th><th>band</th><th></th></tr>";
  for (const Claim& claim : one.findings.claims) html += claim_row(claim);
  html += "</table><div class=\"panels\">";
  for (const Panel& panel : one.findings.panels) html += svg_of(panel);
  return html + "</div>" + basis_html(item) + "\n";
}

}  // namespace

std::string report_html(const std::vector<Measured>& measured, std::int64_t runs, std::uint64_t first_seed) {
  return report_html(measured, "Vigil " + std::string(version()) + ", " + std::to_string(runs) + " runs from seed " +
                                   std::to_string(first_seed));
}

std::string report_html(const std::vector<Measured>& measured, const std::string& made) {
  std::string html =
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>The papers, run again</title>" +
      style() + "</head><body><h1>The papers, run again</h1><p class=\"meta\">" + escaped(made) +
      ". Every number and curve comes from runs made for this page; ± is one standard error.</p>";
  html += "<table><tr><th>item</th><th>title</th><th>paper</th><th>ours</th><th>verdict</th></tr>";
  for (const Measured& one : measured) {
    const Claim& head = headline_of(one.findings);
    html += "<tr><td><a href=\"#" + escaped(one.item->key) + "\">" + escaped(one.item->key) + "</a></td><td>" +
            escaped(one.item->title.en) + "</td><td>" + escaped(paper_text(head.paper)) + "</td><td class=\"n\">" +
            with_error(head.ours) + "</td><td>" + verdict_html(verdict_of(one.findings)) + "</td></tr>";
  }
  html += "</table>\n";
  std::vector<const Item*> items;
  for (const Measured& one : measured) {
    html += item_html(one);
    items.push_back(one.item);
  }
  return html + methods_html(items) + "</body></html>\n";
}

std::string report_text(const std::vector<Measured>& measured) {
  std::vector<std::vector<std::string>> rows{{"item", "ours", "verdict"}};
  for (const Measured& one : measured) {
    const Claim& head = headline_of(one.findings);
    const std::string se = std::isfinite(head.ours.se) ? " +- " + tick_text(head.ours.se) : "";
    rows.push_back({one.item->key, number(head.ours.value) + se, std::string(to_string(verdict_of(one.findings)))});
  }
  return aligned(rows);
}

}  // namespace vigil::papers
