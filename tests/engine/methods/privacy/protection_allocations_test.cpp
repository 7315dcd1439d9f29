// Once a lane has settled no mechanism asks for memory.
#include "tests/engine/allocations.hpp"
#include "tests/engine/methods/privacy/protection_rig.hpp"

#ifdef VIGIL_COUNTS_MALLOC
namespace vigil::protection_allocations_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(ProtectionAllocations, ASettledTickAllocatesNothing) {
  for (const auto& [id, params] : {std::pair<const char*, Json>{"two_step", Json::object()},
                                   {"dp_sensors", Json::object()},
                                   {"dp_centre", Json::object()},
                                   {"secrecy_code", {{"code", "A"}}},
                                   {"secrecy_code", {{"code", "L"}}}}) {
    Knowledge known = rig::knowledge_of_model(privacy::engine_model());
    const VectorXd truth = rig::start(known, 1);
    known.protection = rig::protect(known, id, params);
    const auto lane = rig::fusion_lane(known, "stationary");
    rig::drive(*lane, known, truth, 1100, 1, {}, [](std::int64_t, const VectorXd&, const Method&, const MatrixXd&) {});
    const Readings readings = rig::readings_at(known, truth, 1, 1101);
    const VectorXd input(0);
    std::vector<Delivery> inbox(2, {.lost = false, .flagged = false, .payload = VectorXd::Zero(3)});
    FaultTable faults;
    EXPECT_EQ(allocations_in([&] {
                lane->predict(input, faults);
                lane->measure(readings, faults);
                for (int i = 0; i < 2; ++i) lane->send(i, inbox[static_cast<std::size_t>(i)].payload);
                lane->update(readings, inbox, faults);
              }),
              0)
        << id << params.dump();
  }
}

TEST(ProtectionAllocations, NobodyWhoListensAllocates) {
  for (const auto& [id, params] : {std::pair<const char*, Json>{"two_step", Json::object()},
                                   {"dp_centre", Json::object()},
                                   {"secrecy_code", {{"code", "A"}}},
                                   {"secrecy_code", {{"code", "L"}}},
                                   {"secrecy_code", {{"code", "L_state"}}}}) {
    Knowledge known = rig::knowledge_of_model(privacy::engine_model());
    const VectorXd truth = rig::start(known, 1);
    known.protection = rig::protect(known, id, params);
    const auto lane = rig::fusion_lane(known, "stationary");
    const privacy::Protection& protection = lane->fusion()->protection();
    for (const std::string& variant : protection.eavesdroppers()) {
      const auto member = protection.eavesdropper(variant);
      const std::vector<char> heard(2, 1), deaf(2, 0);
      MatrixXd messages = MatrixXd::Constant(3, 2, 0.1);
      privacy::PublicTick tick = lane->fusion()->public_tick();
      for (tick.k = 0; tick.k < 20; ++tick.k) member->listen(tick, messages, tick.k % 2 == 1 ? heard : deaf);
      EXPECT_EQ(allocations_in([&] {
                  member->see(tick, truth);
                  member->listen(tick, messages, deaf);
                  ++tick.k;
                  member->listen(tick, messages, heard);
                }),
                0)
          << id << " " << variant;
    }
  }
}

}  // namespace
}  // namespace vigil::protection_allocations_test
#endif
