/// A campaign as the API shows it.
#pragma once

#include <memory>

#include "db/records.hpp"
#include "server/api/services.hpp"
#include "server/campaigns/result.hpp"
#include "server/campaigns/results.hpp"

namespace vigil {

/// An item of GET /campaigns.
Json campaign_item(const CampaignRow& row, const Services& services);
/// GET /campaigns/{id}: the item with the document, its cells and the metrics of all.
Json campaign_detail(const CampaignRow& row, const std::vector<CellResult>& cells, const Services& services);
/// The same without metrics and faults; `names` says which metrics there are.
Json campaign_outline(const CampaignRow& row, CampaignResults& results, const Services& services);
/// A metric whatever its lane: "name", "node.name", with ":variant" where there is one.
std::string metric_id(const std::string& node, const std::string& name, const std::string& variant);
/// The words between commas; none of an empty text.
std::vector<std::string> comma_words(const std::string& text);
/// The row of the request's {id}. Throws HttpError 404.
CampaignRow campaign_row(const HttpRequest& request, const Services& services);
/// Cells in order, those without a trial too.
std::vector<CellResult> campaign_cells(const CampaignRow& row, CampaignResults& results, const Services& services);

/// What the routes of campaigns share; lives as long as the table of routes.
using SharedResults = std::shared_ptr<CampaignResults>;
/// GET /campaigns/{id}/results and /values: figures of chosen metrics of all points, values of all trials.
void add_result_routes(Routes& routes, Services& services, const SharedResults& results);

}  // namespace vigil
