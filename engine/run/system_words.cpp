#include "engine/run/system_words.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/run/system_model.hpp"

namespace vigil {
namespace {

constexpr std::size_t kNamed = 4;

/// The hidden modes that do not decay of a linear plant in ticks whose sensors are linear; none where it is another.
std::vector<Mode> lasting_unseen(const World& world, const Modes& all, const LinearModel& model) {
  std::vector<Eigen::MatrixXd> C;
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(world.plant->states());
  for (const auto& sensor : world.sensors) {
    if (!sensor->linear()) return {};
    C.emplace_back(sensor->size(), world.plant->states());
    sensor->jacobian(origin, C.back());
  }
  auto seen = visibility(model.A, stacked(C, world.plant->states()), TimeKind::ticks);
  if (!seen) return {};
  std::erase_if(seen->hidden, [&](const Mode& mode) { return all.fate(mode) == Fate::decays; });
  return seen->hidden;
}

}  // namespace

std::string mode_text(const Mode& mode) {
  const double real = mode.value.real() == 0 ? 0 : mode.value.real();  // never "-0"
  if (mode.value.imag() == 0) return fmt::format("{:.6g}", real);
  return fmt::format("{:.6g} ± {:.6g}i", real, mode.value.imag());
}

std::string_view to_string(Fate fate) {
  return fate == Fate::decays ? "decays" : (fate == Fate::stays ? "stays" : "grows");
}

std::string modes_text(const std::vector<Mode>& modes, const Modes& all) {
  std::string text = modes.size() == 1 ? "the mode " : "the modes ";
  for (std::size_t i = 0; i < modes.size() && i < kNamed; ++i) {
    if (i > 0) text += i + 1 == modes.size() ? " and " : ", ";
    const std::string_view fate = all.fate(modes[i]) == Fate::stays ? "does not decay" : to_string(all.fate(modes[i]));
    text += fmt::format("{} (which {})", mode_text(modes[i]), fate);
  }
  if (modes.size() > kNamed) text += fmt::format(" and {} more", modes.size() - kNamed);
  return text;
}

bool all_decay(const std::vector<Mode>& modes, const Modes& all) {
  return std::all_of(modes.begin(), modes.end(), [&](const Mode& mode) { return all.fate(mode) == Fate::decays; });
}

std::vector<std::string> world_warnings(const World& world, bool traced) {
  std::vector<std::string> warnings;
  if (world.controller) warnings = world.controller->warnings();
  if (world.continuous() != nullptr || !world.plant->linear()) return warnings;
  if (world.plant->inputs() > 0 && !world.controller && !traced)
    warnings.emplace_back("the plant has inputs and nobody drives it: they are zero (no controller, no trace)");
  const LinearModel model = linear_model(*world.plant);
  const auto all = Modes::of(model.A, TimeKind::ticks);
  if (!all || all->stable()) return warnings;
  const std::vector<Mode> unseen = lasting_unseen(world, *all, model);
  if (!unseen.empty())
    warnings.push_back(fmt::format("no node sees {}: no lane can follow the plant there", modes_text(unseen, *all)));
  return warnings;
}

}  // namespace vigil
