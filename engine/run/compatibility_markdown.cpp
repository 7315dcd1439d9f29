#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/run/compatibility.hpp"

namespace vigil {
namespace {

constexpr const char* kHead =
    "# Which method meets which attack\n\n"
    "Made by the code (`VIGIL_UPDATE_DOCS=1` and the engine's tests); for a scenario of your own ask `GET "
    "/api/v1/scenarios/ID/compatibility`, `POST /api/v1/compatibility` or\n"
    "`vigil compatibility ID`. A row is an attack on a kind of channel, a column a lane of the preset. The "
    "word says what the attack reaches first: the lane's\n"
    "*estimate*, its *detector* (path `monitor`: its estimator hears the honest readings), the *plant* that it drives "
    "or sees driven, or its *messages*, which are overheard.\n"
    "A number is the reason why it does not meet the attack. Every pair that meets runs for twenty ticks in the tests "
    "and changes the lane; no other pair changes a bit of it (of the observers those with printed gains).\n";

class Reasons {
 public:
  std::string number(const std::string& reason) {
    const auto found = std::find(all_.begin(), all_.end(), reason);
    const auto place = found - all_.begin();
    if (found == all_.end()) all_.push_back(reason);
    return std::to_string(place + 1);
  }
  std::string list() const {
    std::string text;
    for (std::size_t i = 0; i < all_.size(); ++i) text += fmt::format("{}. {}\n", i + 1, all_[i]);
    return text;
  }

 private:
  std::vector<std::string> all_;
};

std::string table(const Json& found) {
  Reasons reasons;
  std::string head = "| attack | on |", rule = "|---|---|", body;
  for (const Json& lane : found["lanes"]) {
    const auto id = lane["id"].get<std::string>(), method = lane["method"].get<std::string>();
    head += id == method ? fmt::format(" `{}` |", id) : fmt::format(" `{}` ({}) |", id, method);
    rule += "---|";
  }
  for (const Json& row : found["rows"]) {
    body += fmt::format("| `{}` | {}s |", row["attack"].get<std::string>(), row["channel"].get<std::string>());
    for (const Json& lane : found["lanes"]) {
      const auto cell = row["cells"].find(lane["id"].get<std::string>());
      const bool none = cell == row["cells"].end();
      const Json& what = none ? row["reason"] : (*cell)["meets"].is_null() ? (*cell)["reason"] : (*cell)["meets"];
      const bool met = !none && !(*cell)["meets"].is_null();
      body += fmt::format(" {} |", met ? what.get<std::string>() : reasons.number(what.get<std::string>()));
    }
    body += "\n";
  }
  return head + "\n" + rule + "\n" + body + "\n" + reasons.list();
}

}  // namespace

std::string compatibility_markdown() {
  std::string text = kHead;
  for (const std::string& id : Scenario::preset_ids()) {
    text += fmt::format("\n## {}\n\n", id);
    try {
      text += table(compatibility(Scenario::preset(id)));
    } catch (const InputError& error) {
      text += fmt::format("Cannot be said without its recording: {}.\n", error.problems().front().detail);
    }
  }
  return text;
}

}  // namespace vigil
