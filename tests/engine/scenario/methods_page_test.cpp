#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/methods/words.hpp"
#include "engine/scenario/methods_markdown.hpp"

namespace vigil::methods_page_test {
namespace {

namespace fs = std::filesystem;

const fs::path kPages = fs::path(VIGIL_SOURCE_DIR) / "docs" / "methods";

struct Described {
  std::string id;
  const ParamTable* params;
};

template <class Make>
void append(std::vector<Described>& all) {
  for (const auto& entry : Registry<Make>::all()) all.push_back({entry.id, &entry.params});
}

std::vector<Described> registered() {
  std::vector<Described> all;
  append<MethodMake>(all);
  append<ProtectionMake>(all);
  append<DetectorMake>(all);
  return all;
}

/// A page is a file of its id, and words are found by it: no two kinds may share one.
TEST(MethodWords, AreOneForEveryRegisteredId) {
  std::multiset<std::string> ids, described;
  for (const Described& one : registered()) ids.insert(one.id);
  for (const FamilyWords& one : method_words()) described.insert(one.words.id);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_EQ(ids, described);
}

bool closed(const std::string& text) { return std::count(text.begin(), text.end(), '`') % 2 == 0; }
bool ends_sentence(const std::string& text) { return !text.empty() && text.back() == '.'; }

TEST(MethodWords, AreWhole) {
  for (const auto& [family, words] : method_words()) {
    SCOPED_TRACE(words.id);
    EXPECT_FALSE(family.empty());
    EXPECT_FALSE(words.line.empty() || ends_sentence(words.line) || words.line.find('|') != std::string::npos);
    std::vector<std::string> texts = words.steps;
    texts.insert(texts.end(), {words.model, words.cost});
    for (const Correction& one : words.corrected) texts.push_back(one.text);
    for (const std::string& text : texts) EXPECT_TRUE(closed(text) && ends_sentence(text)) << text;
    EXPECT_FALSE(words.steps.empty());
    EXPECT_NE(words.cost.find("O("), std::string::npos);
  }
}

/// The parameter that is said to keep a literal reading is declared, and takes that value.
TEST(MethodWords, NameLiteralReadingsThatCanBeSelected) {
  for (const Described& one : registered()) {
    const FamilyWords* found = find_words(one.id);
    ASSERT_NE(found, nullptr) << one.id;
    for (const Correction& correction : found->words.corrected) {
      SCOPED_TRACE(one.id + ": " + correction.text);
      EXPECT_NE(correction.text.find("section"), std::string::npos) << "cites no section of the specification";
      if (correction.parameter.empty()) continue;
      const Param* param = one.params->find(correction.parameter);
      ASSERT_NE(param, nullptr) << correction.parameter;
      EXPECT_FALSE(one.params->check(*param, correction.value, "").has_value()) << correction.value;
    }
  }
}

std::string read(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Documentation, MethodPagesFollowTheCode) {
  const auto pages = methods_markdown();
  if (std::getenv("VIGIL_UPDATE_DOCS") != nullptr) {
    fs::remove_all(kPages);
    fs::create_directories(kPages);
    for (const auto& [name, text] : pages) std::ofstream(kPages / name) << text;
  }
  std::set<std::string> expected, found;
  for (const auto& [name, text] : pages) {
    expected.insert(name);
    EXPECT_EQ(read(kPages / name), text) << name
                                         << ": run the engine tests with VIGIL_UPDATE_DOCS=1, commit docs/methods";
  }
  for (const auto& file : fs::directory_iterator(kPages)) found.insert(file.path().filename().string());
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace vigil::methods_page_test
