#include "server/crew/shipped_plan.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/core/bytes.hpp"
#include "engine/run/trace.hpp"
#include "server/crew/pack.hpp"

namespace vigil {
namespace {

constexpr std::uint64_t kFormat = 0x3130'4e41'4c50'4756;  // "VGPLAN01"
constexpr std::size_t kMostPlanBytes = std::size_t{1} << 33;
constexpr std::size_t kParsed = 16;  // points that are kept ready

}  // namespace

std::string ship(const CampaignPlan& plan) {
  ByteWriter out;
  out.word(kFormat);
  out.integer(plan.runs);
  out.word(plan.first_seed);
  out.text(plan.trace ? plan.trace->save() : "");
  out.word(plan.points.size());
  for (const CampaignPoint& point : plan.points)
    out.text(Json{{"document", point.scenario.document()}, {"designs", point.designs}}.dump());
  return pack(out.take());
}

ShippedPlan::ShippedPlan(std::string_view packed) {
  const std::string bytes = unpack(packed, kMostPlanBytes);
  ByteReader in(bytes);
  if (in.word() != kFormat) throw std::runtime_error("These bytes are no plan of a campaign.");
  runs_ = in.integer();
  first_seed_ = in.word();
  if (const std::string trace = in.text(); !trace.empty()) trace_ = std::make_shared<const Trace>(Trace::load(trace));
  for (std::size_t left = in.count(8); left > 0; --left) points_.push_back(in.text());
  if (runs_ < 1 || !in.done()) throw std::runtime_error("A campaign's plan is damaged.");
}

std::shared_ptr<const CampaignPlan> ShippedPlan::plan_of(std::int64_t point) {
  const std::lock_guard lock(mutex_);
  const auto known = std::find_if(parsed_.begin(), parsed_.end(), [&](const auto& one) { return one.first == point; });
  if (known != parsed_.end()) {
    parsed_.splice(parsed_.begin(), parsed_, known);
    return known->second;
  }
  const Json json = Json::parse(points_.at(static_cast<std::size_t>(point)));
  auto plan = std::make_shared<CampaignPlan>();
  plan->points.push_back({Json::object(), Scenario::from_json(json.at("document")), json.at("designs")});
  plan->runs = runs_;
  plan->first_seed = first_seed_;
  plan->trace = trace_;
  parsed_.emplace_front(point, plan);
  if (parsed_.size() > kParsed) parsed_.pop_back();
  return plan;
}

TrialResult ShippedPlan::trial(std::int64_t index, const std::atomic<bool>& stop) {
  if (index < 0) throw std::out_of_range("There is no such trial.");
  return plain_trial(*plan_of(point_of(index)), index % runs_, stop);
}

std::vector<TrialResult> ShippedPlan::range(std::int64_t first, std::int64_t count, const std::atomic<bool>& stop,
                                            const std::function<void(std::int64_t)>& before) {
  std::vector<TrialResult> trials;
  std::int64_t designed = -1, block = 0;  // point whose design is there; where the block began, in the list
  for (std::int64_t index = first; index < first + count; ++index) {
    before(index);
    TrialResult made = trial(index, stop);
    if (point_of(index) == designed) made.design = nullptr;
    if (!made.design.is_null()) designed = point_of(index);
    const std::int64_t place = index % runs_;
    if (place % kTrialBlock == 0) block = index - first;
    trials.push_back(std::move(made));
    const std::int64_t length = index - first + 1 - block;
    const bool whole = length == place % kTrialBlock + 1 && (length == kTrialBlock || place + 1 == runs_);
    if (whole && length > 1) pool_block(trials, static_cast<std::size_t>(block), static_cast<std::size_t>(length));
  }
  return trials;
}

}  // namespace vigil
