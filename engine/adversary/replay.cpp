/// A record of a sensor's readings, or of a link's messages, played back in their place. Seed 003, section 4;
/// specification of seed 003, section 6.
#include <algorithm>

#include "engine/adversary/attack.hpp"

namespace vigil {
namespace {

/// What the adversary of a live run can look back: the memory of every channel.
constexpr std::int64_t kLongestRecord = 1024;
/// Length of the record where none is given and the attack was started by hand: that of the two cases.
constexpr std::int64_t kUsualRecord = 51;

struct Schedule {
  std::int64_t record_from = 50, record_to = 100, start = 101;
  std::optional<std::int64_t> end = 180;
};

std::int64_t tick(const Params& params, const char* name, std::int64_t fallback) {
  return params.given(name) ? params.integer(name) : fallback;
}

/// The two cases of the specification; started by hand, from now on with the ticks before.
Schedule defaults(const Params& params, const AttackContext& context) {
  if (context.by_hand) {
    return {std::max<std::int64_t>(context.from - kUsualRecord, 1), context.from - 1, context.from, context.to};
  }
  if (params.integer("case") == 2) return {50, 100, 250, 300};
  return {};
}

Schedule read(const Params& params, const AttackContext& context) {
  Schedule schedule = defaults(params, context);
  schedule.record_from = tick(params, "record_from", schedule.record_from);
  schedule.record_to = tick(params, "record_to", schedule.record_to);
  schedule.start = tick(params, "start", schedule.start);
  if (params.given("end")) schedule.end = params.integer("end");
  const auto text = [](std::int64_t k) { return std::to_string(k); };
  if (schedule.record_to < schedule.record_from)
    throw InputError("/record_to", "the record from " + text(schedule.record_from) + " to " + text(schedule.record_to) +
                                       " is empty; expected record_from <= record_to");
  if (schedule.record_to >= schedule.start)
    throw InputError("/record_to", "record_to is " + text(schedule.record_to) + " and the replay starts at " +
                                       text(schedule.start) + "; a record must end before it is played");
  if (schedule.record_to - schedule.record_from >= kLongestRecord ||
      schedule.start - schedule.record_from > kLongestRecord)
    throw InputError("/record_from", "the record begins " + text(schedule.start - schedule.record_from) +
                                         " ticks before the replay; the adversary remembers 1024");
  if (schedule.end && *schedule.end < schedule.start)
    throw InputError("/end", "end is " + text(*schedule.end) + "; the replay starts at " + text(schedule.start));
  return schedule;
}

class Replay final : public Attack {
 public:
  Replay(const Params& params, const AttackContext& context) : schedule_(read(params, context)) {}

  std::unique_ptr<Attack> clone() const override { return std::make_unique<Replay>(*this); }
  std::int64_t start() const override { return schedule_.start; }
  bool active(std::int64_t k) const override { return k >= schedule_.start && (!schedule_.end || k <= *schedule_.end); }

  void act(std::int64_t k, std::span<const int> links, LinkEffects& effects) const override {
    for (const int link : links) effects.play(link, played(k));
  }

  void tamper(std::int64_t k, std::span<const SensorPlace> places, SensorEffects& effects) const override {
    for (const SensorPlace& place : places) effects.play(place, played(k));
  }

  std::string remark() const override {
    const bool wraps = !schedule_.end || *schedule_.end - schedule_.start >= length();
    return "the record of ticks " + std::to_string(schedule_.record_from) + " to " +
           std::to_string(schedule_.record_to) + (wraps ? " is shorter than the attack and repeats" : "");
  }

 private:
  Playback played(std::int64_t k) const {
    return {schedule_.record_from, schedule_.record_to, schedule_.record_from + (k - schedule_.start) % length()};
  }
  std::int64_t length() const { return schedule_.record_to - schedule_.record_from + 1; }
  Schedule schedule_;
};

Param ticks(const char* name, Words meaning) {
  return {.name = name,
          .type = ParamType::integer,
          .fallback = nullptr,
          .minimum = 0,
          .nullable = true,
          .meaning = std::move(meaning)};
}

const Registration<AttackMake> registration({
    "replay",
    {"Playback of a record", "重放攻击"},
    "seed 003, section 4",
    ParamTable({
        {.name = "case",
         .type = ParamType::integer,
         .fallback = 1,
         .minimum = 1,
         .maximum = 2,
         .meaning = {"1: ticks 101 to 180, 2: ticks 250 to 300; both play ticks 50 to 100",
                     "1：第 101 至 180 步，2：第 250 至 300 步；均重放第 50 至 100 步"}},
        ticks("record_from", {"First tick of the record; none: as the case, or 51 ticks back when started by hand",
                              "记录起始步；无：按情形，手动启动时取前 51 步"}),
        ticks("record_to", {"Last tick of the record; none: as the case, or the tick before a start by hand",
                            "记录结束步；无：按情形，手动启动时取启动前一步"}),
        ticks("start", {"First tick played; none: as the case, or now", "重放起始步；无：按情形，或立即"}),
        ticks("end", {"Last tick played; none: as the case, or until stopped", "重放结束步；无：按情形，或直至停止"}),
    }),
    [](const Params& params, const AttackContext& context) -> std::unique_ptr<Attack> {
      return std::make_unique<Replay>(params, context);
    },
    {.acts_on = {ChannelKind::link, ChannelKind::sensor}},
});

}  // namespace
}  // namespace vigil
