/// All that a campaign's table says, as text: two tables are the same where these are.
#pragma once

#include <string>

#include "engine/run/campaign.hpp"

namespace vigil {

inline std::string everything(const CampaignTable& table) {
  Json all;
  for (const MetricSummary& row : table.summary()) all["metrics"].push_back(to_json(row));
  for (const PairedSummary& row : table.paired()) all["paired"].push_back(to_json(row));
  for (const DetectionSummary& row : table.detection()) all["detection"].push_back(to_json(row));
  return all.dump();
}

}  // namespace vigil
