/// Campaigns in the log: cells, trials, what is merged of them.
#include <cmath>

#include "tests/db/helpers.hpp"

namespace vigil::campaign_rows_test {
namespace {

class CampaignRows : public test::ClockedLog {};

NewCampaign two_cells() {
  NewCampaign campaign;
  campaign.request = {{"runs", 2}, {"note", "old"}};
  campaign.trials = 4;
  campaign.cells.resize(2);
  campaign.cells[1].cell = 1;
  campaign.cells[1].sweep = {{"a.b", 0.5}};
  return campaign;
}

TEST(CellSummaryBytes, GiveBackEveryFigureAndRefuseDamage) {
  const Json row{{"lane", "a"},
                 {"node", nullptr},
                 {"name", "rmse"},
                 {"variant", "all"},
                 {"mean", 0.1},
                 {"se", nullptr},
                 {"median", -0.0},
                 {"min", 1e-300},
                 {"max", 2},
                 {"n", 50},
                 {"quantiles", {{"0.05", 1}, {"0.25", 2}, {"0.75", 3}, {"0.95", 4}}}};
  const Json result{{"trials", {{"finished", 3}}}, {"ticks", 7}, {"warnings", {"look"}}, {"metrics", {row, row}}};
  const std::string bytes = encode(cell_summary(result));
  const CellSummary back = decode_summary(bytes);
  EXPECT_EQ(result.at("trials"), back.trials);
  EXPECT_EQ(7, back.ticks);
  EXPECT_EQ(Json{"look"}, back.warnings);
  ASSERT_EQ(2u, back.rows.size());
  EXPECT_EQ("all", back.rows[1].variant);
  EXPECT_EQ("", back.rows[1].node);
  EXPECT_EQ(0.1, back.rows[1].figures[0]);
  EXPECT_TRUE(std::isnan(back.rows[1].figures[1]));
  EXPECT_TRUE(std::signbit(back.rows[1].figures[2]));
  EXPECT_EQ(50, back.rows[1].figures.back());
  EXPECT_THROW(decode_summary(bytes.substr(0, bytes.size() / 2)), std::runtime_error);
  EXPECT_THROW(decode_summary("nonsense"), std::runtime_error);
}

TEST_F(CampaignRows, KeepTheirTrialsAndWhatIsMergedOfThem) {
  const auto id = writer.create_campaign(two_cells()).id;
  EXPECT_EQ("queued", reader.campaign(id)->state);
  const std::string numbers("\x00\x01\xff\x00\x00\x00\x00\x00", 8);
  CampaignBatch batch;
  batch.trials.resize(2);
  batch.trials[0] = {0, ~0ull, "finished", numbers, 30, {}, {}, "", 7, {}};
  batch.trials[1] = {1, 100, "failed", "", 0, Json{{"lane", "x"}}, Json{"look"}, "why", {}, {}};
  batch.cells.push_back({0, {}, {}, Json{{"gain", 1}}, Json{"column"}, std::string(3, '\0'), {}});
  writer.add_trials(id, batch).get();
  writer.add_trials(id, batch).get();  // again: nothing counts twice
  auto row = *reader.campaign(id);
  EXPECT_EQ(2, row.done);
  EXPECT_EQ(1, row.failed);
  const auto trials = reader.trials(id);
  ASSERT_EQ(2u, trials.size());
  EXPECT_EQ(~0ull, trials[0].seed);
  EXPECT_EQ(numbers, trials[0].numbers);
  EXPECT_EQ(7, trials[0].run);
  EXPECT_EQ("why", trials[1].error);
  EXPECT_EQ(Json{"look"}, trials[1].warnings);
  EXPECT_EQ(1u, reader.trials(id, {1, 1}).size());
  EXPECT_EQ(std::string(3, '\0'), reader.campaign_cell(id, 0)->accumulators);
  EXPECT_TRUE(reader.campaign_cell(id, 0)->result.is_null());
  batch.trials.clear();
  batch.cells[0].accumulators.clear();
  EXPECT_TRUE(reader.campaign_summaries(id).empty());
  batch.cells[0].result = {{"metrics", Json::array()}};
  writer.add_trials(id, batch).get();
  EXPECT_TRUE(reader.campaign_cell(id, 0)->result.contains("metrics"));
  EXPECT_EQ(1u, reader.campaign_summaries(id).size());
  EXPECT_TRUE(reader.campaign_summaries(id, 1).empty());
  const auto part = reader.campaign_part(id, 0, {1, 9});
  EXPECT_EQ(1u, part->trials.size());
  EXPECT_EQ(Json{"column"}, part->cell.columns);
  EXPECT_EQ(1u, reader.campaign_columns(id, 0, 5).size()) << "the other cell has no trial";
  std::string read;
  reader.each_trial(id, {0, 0}, [&](std::int64_t index, std::string_view bytes) {
    EXPECT_EQ(0, index);
    read = bytes;
  });
  EXPECT_EQ(numbers, read);
  writer.set_cell_designs(id, 1, {{"lane", 1}});
  EXPECT_EQ(0.5, reader.campaign_cells(id).at(1).sweep["a.b"]);
  EXPECT_EQ(1, reader.campaign_cells(id).at(1).designs["lane"]);
  writer.describe_campaign(id, {{"note", "new"}});
  EXPECT_EQ("new", reader.campaign(id)->request["note"]);
  writer.update_campaign(id, "paused");
  EXPECT_FALSE(reader.campaign(id)->ended);
  writer.update_campaign(id, "finished");
  EXPECT_TRUE(reader.campaign(id)->ended);
  EXPECT_TRUE(check_log(path()).ok);
  EXPECT_TRUE(writer.delete_campaign(id));
  EXPECT_TRUE(reader.campaigns().empty());
  EXPECT_TRUE(reader.trials(id).empty());
  EXPECT_TRUE(reader.campaign_summaries(id).empty());
  EXPECT_FALSE(reader.campaign_cell(id, 0));
  EXPECT_THROW(writer.add_trials(id, batch).get(), LogError);
}

TEST_F(CampaignRows, AKeyMakesItOnce) {
  NewCampaign campaign = two_cells();
  campaign.idempotency_key = "k";
  campaign.idempotency_hash = "one";
  const auto first = writer.create_campaign(campaign), second = writer.create_campaign(campaign);
  EXPECT_TRUE(first.fresh);
  EXPECT_FALSE(second.fresh);
  EXPECT_EQ(first.id, second.id);
  campaign.idempotency_hash = "two";
  EXPECT_THROW(writer.create_campaign(campaign), LogError);
  clock += 25LL * 3600 * test::kSecond;
  EXPECT_TRUE(writer.create_campaign(campaign).fresh);
}

}  // namespace
}  // namespace vigil::campaign_rows_test
