/// TeX as MathML: what it makes, what it refuses, and every equation that the methods register.
#include "engine/core/mathml.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <vector>

#include "engine/methods/equation.hpp"
#include "engine/methods/words.hpp"

namespace vigil::mathml_test {
namespace {

std::string inside(const std::string& tex) {
  const std::string xml = mathml(tex), head = "<math display=\"block\"><mrow>", tail = "</mrow></math>";
  EXPECT_EQ(xml.substr(0, head.size()), head);
  EXPECT_EQ(xml.substr(xml.size() - tail.size()), tail);
  return xml.substr(head.size(), xml.size() - head.size() - tail.size());
}

TEST(MathMl, IsMadeOfLettersNumbersAndSigns) {
  EXPECT_EQ(inside("a<2.5"), "<mi>a</mi><mo>&lt;</mo><mn>2.5</mn>");
  EXPECT_EQ(inside("3."), "<mn>3</mn><mo>.</mo>");
  EXPECT_EQ(inside(R"(\alpha-\Phi)"), "<mi>α</mi><mo>−</mo><mi mathvariant=\"normal\">Φ</mi>");
  EXPECT_EQ(inside(R"(\ln m)"), "<mi>ln</mi><mspace width=\"0.17em\"/><mi>m</mi>");
  EXPECT_EQ(inside(R"(s\cos x)"),
            "<mi>s</mi><mspace width=\"0.17em\"/><mi>cos</mi><mspace width=\"0.17em\"/><mi>x</mi>");
  EXPECT_EQ(inside(R"(-\ln(m))"),
            "<mo>−</mo><mi>ln</mi><mo stretchy=\"false\">(</mo><mi>m</mi><mo stretchy=\"false\">)</mo>");
  EXPECT_EQ(inside(R"(\text{no loss})"), "<mtext>no\u00a0loss</mtext>");
  EXPECT_EQ(inside(R"(\mathcal{N})"), "<mi>𝒩</mi>");
}

TEST(MathMl, PutsScriptsWhereTheyBelong) {
  EXPECT_EQ(inside("x_i^2"), "<msubsup><mi>x</mi><mi>i</mi><mn>2</mn></msubsup>");
  EXPECT_EQ(inside("x^{-1}"), "<msup><mi>x</mi><mrow><mo>−</mo><mn>1</mn></mrow></msup>");
  EXPECT_EQ(inside("e'"), "<msup><mi>e</mi><mo>′</mo></msup>");
  EXPECT_EQ(inside(R"(\sum_i^n x)"), "<munderover><mo>∑</mo><mi>i</mi><mi>n</mi></munderover><mi>x</mi>");
  EXPECT_EQ(inside(R"(\hat x_i)"), "<msub><mover accent=\"true\"><mi>x</mi><mo>^</mo></mover><mi>i</mi></msub>");
}

TEST(MathMl, KnowsFractionsFencesAndTables) {
  EXPECT_EQ(inside(R"(\frac{1}{2})"), "<mfrac><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></mfrac>");
  EXPECT_EQ(inside(R"(\left[a\right))"),
            "<mrow><mo stretchy=\"true\" form=\"prefix\">[</mo><mrow><mi>a</mi></mrow>"
            "<mo stretchy=\"true\" form=\"postfix\">)</mo></mrow>");
  EXPECT_EQ(inside(R"(\begin{aligned} a &= b \\ c \end{aligned})"),
            "<mtable displaystyle=\"true\" class=\"tex-aligned\"><mtr><mtd><mrow><mi>a</mi></mrow></mtd>"
            "<mtd><mrow><mo>=</mo><mi>b</mi></mrow></mtd></mtr><mtr><mtd><mrow><mi>c</mi></mrow></mtd></mtr></mtable>");
}

TEST(MathMl, RefusesWhatItDoesNotKnow) {
  for (const char* tex : {R"(\nosuch)", "{a", "a}", "x_", R"(\frac{1})", R"(\left(a)", R"(\begin{matrix}a\end{matrix})",
                          R"(\begin{cases}a\end{bmatrix})", "é", "x^", R"(\text{a)", "\\", R"(\mathcal{n})"})
    EXPECT_THROW(mathml(tex), std::invalid_argument) << tex;
}

/// Elements are closed in the order they were opened.
void expect_well_formed(const std::string& xml, const std::string& id) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    ASSERT_NE(end, std::string::npos) << id;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.back() == '/') continue;
    if (tag.front() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
      continue;
    }
    ASSERT_FALSE(open.empty()) << id;
    EXPECT_EQ(open.back(), tag.substr(1)) << id;
    open.pop_back();
  }
  EXPECT_TRUE(open.empty()) << id;
}

TEST(Equations, CanAllBeDrawnAndSayWhatTheyGive) {
  std::set<std::string> ids;
  for (const Equation& one : equations()) {
    SCOPED_TRACE(one.id);
    EXPECT_TRUE(ids.insert(one.id).second) << "twice";
    EXPECT_FALSE(one.says.en.empty() || one.says.zh.empty());
    std::string xml;
    EXPECT_NO_THROW(xml = mathml(one.tex));
    expect_well_formed(xml, one.id);
    EXPECT_EQ(find_equation(one.id), &one);
    for (const std::string& method : one.methods) EXPECT_NE(find_words(method), nullptr) << method;
  }
  EXPECT_GT(ids.size(), 50U);
  EXPECT_EQ(find_equation("consensus/nosuch"), nullptr);
}

TEST(Equations, AreThereForEveryMethodInTheOrderOfItsSource) {
  for (const FamilyWords& one : method_words()) EXPECT_FALSE(equations_of(one.words.id).empty()) << one.words.id;
  std::vector<std::string> of_filter;
  for (const Equation* one : equations_of("consensus_ekf")) of_filter.push_back(one->number.text);
  EXPECT_EQ(of_filter, (std::vector<std::string>{"(6)", "(7)", "(26)", "(27)", "(28), (29)", "(30)"}));
}

}  // namespace
}  // namespace vigil::mathml_test
