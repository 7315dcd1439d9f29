/// Seed 003: all of its figures, in order.
#include "engine/papers/replay.hpp"

#include <algorithm>

namespace vigil::papers {

Json replay_case(int number) { return {{"adversary", {{"replay", {{"params", {{"case", number}}}}}}}}; }

std::string replay_signal(const std::string& lane, const std::string& what) { return "lane." + lane + ".1." + what; }

std::vector<Item> replay_items() {
  std::vector<Item> list = replay_error_items();
  for (Item& item : replay_detection_items()) list.push_back(std::move(item));
  std::sort(list.begin(), list.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
  return list;
}

}  // namespace vigil::papers
