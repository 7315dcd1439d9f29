/// A campaign as the API shows it.
#pragma once

#include "db/records.hpp"
#include "server/api/services.hpp"
#include "server/campaigns/result.hpp"

namespace vigil {

/// An item of GET /campaigns.
Json campaign_item(const CampaignRow& row, const Services& services);
/// GET /campaigns/{id}: the item with the document, its cells and the metrics of all.
Json campaign_detail(const CampaignRow& row, const std::vector<CellResult>& cells, const Services& services);
/// The row of the request's {id}. Throws HttpError 404.
CampaignRow campaign_row(const HttpRequest& request, const Services& services);
/// Cells in order, those without a trial too. What is merged so far of the one that is going on is computed anew.
std::vector<CellResult> campaign_cells(const CampaignRow& row, const Services& services);

}  // namespace vigil
