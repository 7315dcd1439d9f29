/// A figure or a table of one of the five sources: what the paper prints, how ours comes about, and the rule by which
/// the two are judged. A verdict is computed from claims; nobody writes it by hand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/core/params.hpp"
#include "engine/papers/basis.hpp"
#include "engine/papers/laboratory.hpp"

namespace vigil::papers {

enum class Verdict { reproduced, corrected, not_reproduced };
std::string_view to_string(Verdict verdict);  ///< as the contract words it, section 5

/// On what a claim is measured. A noted one is shown and decides nothing.
enum class Reading { printed, corrected, noted };
std::string_view to_string(Reading reading);

/// One number of ours held against what the paper prints or says of it.
struct Claim {
  Reading reading = Reading::printed;
  std::string what;
  Json paper;  ///< the number as printed, or the paper's statement in our words
  Estimate ours;
  double low = 0, high = 0;  ///< the claim holds in [low, high]

  bool holds() const { return ours.value >= low && ours.value <= high; }
};

struct Series {
  std::string name;
  std::vector<double> x, y;
  std::string style = "line";  ///< line, dashed, steps, stems, points, edge (in the colour of the axes)
};

struct Axis {
  std::string label;
  bool log = false;
};

struct Panel {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

struct Findings {
  std::vector<Claim> claims;
  std::vector<Panel> panels;
  std::int64_t runs = 0;  ///< of the largest campaign behind it

  void claim(Reading reading, std::string what, Json paper, Estimate ours, double low, double high);
};

/// Reproduced where every claim on the printed reading holds and there is one; else reproduced after correction where
/// every claim on the corrected reading holds and there is one; else not.
Verdict verdict_of(const Findings& findings);
/// The claim that stands for the item: the first of the reading that decided.
const Claim& headline_of(const Findings& findings);

struct Item {
  std::string key;  ///< the contract, section 5
  Words title;
  std::string spec;      ///< specification and section
  std::string scenario;  ///< preset that it comes from
  std::string rule;      ///< how the verdict comes about, in one sentence
  std::string reason;    ///< why ours differs, or what had to be corrected: from the specification's entries
  Findings (*measure)(Laboratory&) = nullptr;

  const Basis& basis() const;                ///< its runs and equations
  std::vector<std::string> methods() const;  ///< of its runs, each once
};

/// Every figure and table there is, in the order of the sources.
const std::vector<Item>& items();

/// {"key","title","paper","ours","se","verdict","reason","runs","scenario","spec","figure"}: the contract, section 5.
/// figure: {"rule","claims":[…],"panels":[…]}. No number in it that is not finite. "zh" has the texts in Chinese, of
/// the item, of each claim and of each panel.
Json to_json(const Item& item, const Findings& findings);
/// The texts in Chinese: {"paper","reason","rule"}.
Json words_json(const Item& item, const Json& paper);
/// What it stands on, whether it was run or not: {"scenes":[{"name","scenario","patch"}],"methods":[{"id","title"}],
/// "equations":[…]}.
Json basis_json(const Item& item);
/// The Chinese texts of a kept result's figure, put in where they are missing.
void add_chinese(Json& figure);

std::vector<Item> consensus_items();
std::vector<Item> privacy_items();
std::vector<Item> sparse_items();
std::vector<Item> observer_items();
std::vector<Item> replay_items();

}  // namespace vigil::papers
