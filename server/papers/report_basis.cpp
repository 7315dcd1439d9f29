#include "server/papers/report_basis.hpp"

#include <set>

#include "engine/scenario/method_page.hpp"
#include "server/papers/svg.hpp"

namespace vigil::papers {
namespace {

std::string text_of(const Json& json) { return json.get<std::string>(); }

std::string equations_html(const Json& equations) {
  std::string html;
  for (const Json& one : equations) {
    const std::string number = text_of(one.at("number"));
    html += "<div class=\"equation\"><p>" + escaped(text_of(one.at("says").at("en"))) +
            (number.empty() ? "" : " <b>" + escaped(number) + "</b>") +
            (one.at("corrected").get<bool>() ? " <i>corrected</i>" : "") + "</p>" + text_of(one.at("mathml")) +
            "</div>";
  }
  return html;
}

std::string scenes_html(const Json& scenes) {
  std::string html = "<ul>";
  for (const Json& one : scenes) {
    html += "<li>" + escaped(text_of(one.at("name").at("en"))) + ": <code>" + escaped(text_of(one.at("scenario"))) +
            "</code> with the patch <code>" + escaped(one.at("patch").dump()) + "</code></li>";
  }
  return html + "</ul>";
}

std::string method_html(const Json& page) {
  const std::string id = text_of(page.at("id"));
  std::string html = "<h3 id=\"method-" + id + "\">" + escaped(text_of(page.at("title").at("en"))) + " <code>" + id +
                     "</code></h3><p class=\"meta\">" + escaped(text_of(page.at("title").at("zh"))) + " · " +
                     escaped(text_of(page.at("family"))) + " · source: " + escaped(text_of(page.at("source"))) +
                     "</p><p>" + marked(text_of(page.at("model"))) + "</p><ol>";
  for (const Json& step : page.at("steps")) html += "<li>" + marked(text_of(step)) + "</li>";
  html += "</ol><p class=\"meta\">" + marked(text_of(page.at("cost"))) + "</p>";
  if (page.at("corrected").empty()) return html;
  html += "<p>What was corrected or left open:</p><ul>";
  for (const Json& one : page.at("corrected")) html += "<li>" + marked(text_of(one.at("text"))) + "</li>";
  return html + "</ul>";
}

}  // namespace

std::string marked(const std::string& text) {
  std::string html;
  bool code = false;
  for (const char c : escaped(text)) {
    if (c != '`') {
      html += c;
      continue;
    }
    html += code ? "</code>" : "<code>";
    code = !code;
  }
  return code ? html + "</code>" : html;
}

std::string basis_html(const Item& item) {
  const Json basis = basis_json(item);
  std::string html = "<details open><summary>Equations</summary>" + equations_html(basis.at("equations")) +
                     "</details><details><summary>Runs and methods</summary>" + scenes_html(basis.at("scenes")) + "<p>";
  for (const Json& method : basis.at("methods")) {
    const std::string id = text_of(method.at("id"));
    html += "<a href=\"#method-" + id + "\">" + escaped(text_of(method.at("title").at("en"))) + "</a> ";
  }
  return html + "</p></details>";
}

std::string methods_html(const std::vector<const Item*>& items) {
  std::set<std::string> ids;
  for (const Item* item : items) {
    for (const std::string& id : item->methods()) ids.insert(id);
  }
  std::string html = "<h2>Methods</h2>";
  for (const std::string& id : ids) html += method_html(method_page(id));
  return html;
}

}  // namespace vigil::papers
