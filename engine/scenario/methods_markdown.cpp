#include "engine/scenario/methods_markdown.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/equation.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/words.hpp"
#include "engine/scenario/markdown.hpp"

namespace vigil {
namespace {

constexpr const char* kHead =
    "# Methods\n\n"
    "The mathematics of every method, protection and detector: model, algorithm, parameters, source, cost, and where "
    "the "
    "source was corrected or left something open.\n"
    "Made by the code (`VIGIL_UPDATE_DOCS=1` and the engine's tests). \"Seed\" numbers the five sources, "
    "\"specification\" "
    "the working-out of each; equations have their source's numbers.\n"
    "In costs, n counts states, N or L nodes or sensors, d neighbours of a node, p channels of a sensor.\n";

struct Chapter {
  const char* heading;
  const char* word;
  const char* where;
};

std::string selectable(const Correction& correction, const ParamTable& params) {
  if (correction.parameter.empty()) return "";
  const Param* param = params.find(correction.parameter);
  if (param == nullptr) throw std::logic_error("no parameter " + correction.parameter);
  const bool usual = param->fallback == correction.value;
  const char* reading = correction.reading == Reading::printed ? "As printed" : "The other reading";
  return fmt::format(" *{}: `{}` = `{}`{}.*", reading, correction.parameter, correction.value.dump(),
                     usual ? ", the default" : "");
}

std::string resolved(const MethodWords& words, const ParamTable& params) {
  if (words.corrected.empty()) return "";
  std::string text =
      "\n## What was corrected or left open\n\nThe `Resolved:` entries of the specification that it carries; sections "
      "are the specification's.\n\n";
  for (const Correction& one : words.corrected) text += "- " + one.text + selectable(one, params) + "\n";
  return text;
}

std::string number_of(const EquationNumber& number) {
  return (number.text.empty() ? "" : ", " + number.text) + (number.corrected ? ", corrected" : "");
}

std::string drawn(const std::string& id) {
  std::string text = "\n## Equations\n";
  for (const Equation* one : equations_of(id))
    text += fmt::format("\n{}{}.\n\n```math\n{}\n```\n", one->says.en, number_of(one->number), one->tex);
  return text;
}

template <class Make>
std::string page(const Entry<Make>& entry, const FamilyWords& found, const Chapter& chapter) {
  const MethodWords& words = found.words;
  std::string text =
      fmt::format("# {} / {}\n\n{} `{}`, {}. Source: {}. [All methods](README.md)\n\n{}.\n", entry.title.en,
                  entry.title.zh, chapter.word, entry.id, found.family, entry.source, words.line);
  text += "\n## Model\n\n" + words.model + "\n" + drawn(entry.id) + "\n## Algorithm\n\n";
  for (std::size_t i = 0; i < words.steps.size(); ++i) text += fmt::format("{}. {}\n", i + 1, words.steps[i]);
  text += fmt::format("\n## Parameters\n\n{}\n\n{}", chapter.where, parameters_table(entry.params));
  return text + "## Cost\n\n" + words.cost + "\n" + resolved(words, entry.params);
}

template <class Make>
void add(const Chapter& chapter, std::map<std::string, std::string>& pages) {
  std::string& index = pages["README.md"];
  index += fmt::format("\n## {}\n\n| id | title | family | in one line |\n|---|---|---|---|\n", chapter.heading);
  for (const auto& entry : Registry<Make>::all()) {
    const FamilyWords* found = find_words(entry.id);
    if (found == nullptr) throw std::logic_error("nobody has described " + entry.id + " in a words.cpp");
    index += fmt::format("| [`{0}`]({0}.md) | {1} / {2} | {3} | {4} |\n", entry.id, entry.title.en, entry.title.zh,
                         found->family, found->words.line);
    pages[entry.id + ".md"] = page(entry, *found, chapter);
  }
}

}  // namespace

std::map<std::string, std::string> methods_markdown() {
  std::map<std::string, std::string> pages;
  pages["README.md"] = kHead;
  add<MethodMake>({"Methods", "Method", "`lanes.<id>.method` and `.params` of a scenario."}, pages);
  add<ProtectionMake>({"Protections", "Protection", "`lanes.<id>.protection.type` and `.params` of a scenario."},
                      pages);
  add<DetectorMake>({"Detectors", "Detector", "`lanes.<id>.detector.type` and `.params` of a scenario."}, pages);
  return pages;
}

}  // namespace vigil
