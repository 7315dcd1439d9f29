/// What campaigns and workers tell each other beside the work: short, not kept, said again every moment.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/crew/crew.hpp"
#include "server/crew/fingerprint.hpp"

namespace vigil {

/// Between two notices of a campaign, and of a worker.
inline constexpr auto kNoticeEvery = std::chrono::milliseconds(500);
/// Without a notice for so long, while the broker is there, its sender counts as gone.
inline constexpr auto kNoticePatience = std::chrono::seconds(20);
inline constexpr const char* kCampaignSubject = "vigil.campaigns";

/// A campaign offers work.
struct CampaignNotice {
  std::string id;    ///< the same for the same plan of the same owner
  std::string key;   ///< of its streams; others after the broker has lost them
  std::string what;  ///< for people
  Fingerprint fingerprint;
  std::size_t plan_bytes = 0;
  bool over = false;
};

std::string to_text(const CampaignNotice& notice);
/// Empty where the text is none.
std::optional<CampaignNotice> campaign_notice(std::string_view text);
std::string to_text(const CrewMember& member);
std::optional<CrewMember> crew_member(std::string_view text);

inline std::string plan_subject(const std::string& id) { return "vigil.plan." + id; }
inline std::string crew_subject(const std::string& id) { return "vigil.crew." + id; }
inline std::string job_subject(const std::string& key) { return "vigil.jobs." + key; }
inline std::string result_subject(const std::string& key) { return "vigil.results." + key; }
inline std::string job_stream(const std::string& key) { return "VIGIL_JOBS_" + key; }
inline std::string result_stream(const std::string& key) { return "VIGIL_RESULTS_" + key; }
inline constexpr const char* kWorkers = "workers";    ///< the consumer of the jobs
inline constexpr const char* kCampaign = "campaign";  ///< the consumer of the results

}  // namespace vigil
