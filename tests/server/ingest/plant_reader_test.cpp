// What messages of a plant say, as rows.
#include "server/ingest/plant_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/core/input_error.hpp"
#include "server/front/message.hpp"

namespace vigil::plant_reader_test {
namespace {

PushedColumns tanks() {
  PushedColumns columns;
  columns.nodes = {"north", "south"};
  columns.names = {"sensor.north.level", "sensor.north.flow", "sensor.south.level", "input.pump"};
  columns.reporter = {0, 0, 1, -1};
  columns.inputs = true;
  return columns;
}

class PlantReaderTest : public ::testing::Test {
 protected:
  PlantReader reader(const Json& options) {
    return {columns_, rows_, PlantOptions::from_json(options, "/input/ingest/mqtt"), 0.5};
  }
  static IngestRow only(const std::vector<IngestRow>& rows) {
    EXPECT_EQ(rows.size(), 1u);
    return rows.at(0);
  }
  const PushedColumns columns_ = tanks();
  const RowReader rows_{columns_};
  const TopicPlace level_{"line1", "north", "level"};
  const TopicPlace south_{"line1", "south", ""};
  const TopicPlace nobody_{"line1", "", ""};
};

TEST_F(PlantReaderTest, ATopicOfAChannelBringsOneValue) {
  PlantReader arrival = reader({{"name", "line1"}, {"clock", "arrival"}});
  const IngestRow row = only(arrival.read(level_, " 12.5\n"));
  EXPECT_TRUE(row.partial);
  EXPECT_EQ(row.source, 0);
  EXPECT_EQ(row.values, (std::vector<std::pair<int, double>>{{0, 12.5}}));
  EXPECT_EQ(only(arrival.read(level_, "true")).values[0].second, 1);
  EXPECT_EQ(only(arrival.read(level_, R"({"value":false})")).values[0].second, 0);
  EXPECT_TRUE(std::isnan(only(arrival.read(level_, "null")).values[0].second));
  EXPECT_TRUE(std::isnan(only(arrival.read(level_, "")).values[0].second));
  PlantReader ticks = reader("line1");
  const IngestRow counted = only(ticks.read(level_, R"({"seq":7,"k":3,"value":-2e3})"));
  EXPECT_EQ(counted.k, 3);
  EXPECT_EQ(counted.seq, 7u);
  EXPECT_EQ(counted.values[0].second, -2000);
  EXPECT_THROW(ticks.read(level_, "12.5"), InputError) << "no tick";
}

TEST_F(PlantReaderTest, AMessageIsARowOfTheHttpIngestOrAFlatObject) {
  PlantReader ticks = reader("line1");
  const std::string body = R"({"seq":1,"k":4,"node":"north","values":{"level":1,"flow":null}})";
  const IngestRow by_http = only(rows_.read("application/json", body)), by_topic = only(ticks.read(nobody_, body));
  EXPECT_EQ(by_topic.k, by_http.k);
  EXPECT_EQ(by_topic.seq, by_http.seq);
  EXPECT_EQ(by_topic.source, by_http.source);
  EXPECT_EQ(by_topic.values.size(), by_http.values.size());
  EXPECT_FALSE(by_topic.partial);
  const IngestRow flat = only(ticks.read(south_, R"({"k":4,"level":2.5,"timestamp":"whenever"})"));
  EXPECT_EQ(flat.source, 1);
  EXPECT_EQ(flat.values, (std::vector<std::pair<int, double>>{{2, 2.5}}));
  EXPECT_EQ(ticks.read(nobody_, body + "\n" + body + "\n").size(), 2u);
  EXPECT_EQ(ticks.read(nobody_, "[" + body + "," + body + "]").size(), 2u);
  EXPECT_EQ(ticks.read(nobody_, "k,sensor.south.level\n0,1\n1,2\n").size(), 2u);
  EXPECT_EQ(ticks.read(south_, "{\"k\":1,\n \"values\":{\n\"level\":1\n}\n}").size(), 1u) << "printed prettily";
  EXPECT_THROW(ticks.read(south_, body), InputError) << "the topic is of another node";
}

TEST_F(PlantReaderTest, ThePlantsOwnNamesAreMapped) {
  PlantReader mapped = reader(
      {{"name", "line1"}, {"clock", "arrival"}, {"signals", {{"LT-101", "sensor.north.level"}, {"P1", "input.pump"}}}});
  EXPECT_EQ(only(mapped.read({"line1", "", "LT-101"}, "3")).values[0].first, 0);
  EXPECT_EQ(only(mapped.read({"line1", "", "P1"}, "3")).source, -1);
  EXPECT_EQ(only(mapped.read({"line1", "", "sensor.south.level"}, "3")).values[0].first, 2);
  EXPECT_EQ(only(mapped.read(nobody_, R"({"LT-101":1,"P1":0})")).values.size(), 2u);
  EXPECT_THROW(mapped.read({"line1", "", "LT-102"}, "3"), InputError);
  EXPECT_THROW(reader({{"name", "line1"}, {"signals", {{"LT-101", "sensor.north.nosuch"}}}}), InputError);
}

TEST_F(PlantReaderTest, TimesBecomeTicks) {
  PlantReader times = reader({{"name", "line1"}, {"clock", "time"}});
  EXPECT_THROW(times.read(level_, R"({"value":"high","t":1})"), InputError) << "and does not say when tick 0 is";
  EXPECT_EQ(only(times.read(level_, R"({"value":1,"t":100})")).k, 0);
  EXPECT_EQ(only(times.read(level_, R"({"value":1,"ts":101.1})")).k, 2);
  EXPECT_THROW(times.read(level_, R"({"value":1,"t":90})"), InputError);
  EXPECT_THROW(times.read(level_, R"({"value":1})"), InputError);
  PlantReader since = reader({{"name", "line1"}, {"clock", "time"}, {"start", 1772366400}});
  EXPECT_EQ(only(since.read(level_, R"({"value":1,"time":"2026-03-01T12:00:02Z"})")).k, 4);
  EXPECT_EQ(only(since.read(level_, R"({"value":1,"timestamp":1772366401000})")).k, 2);
}

TEST(PlantSeconds, NumbersAndTextsOfManyGateways) {
  EXPECT_EQ(plant_seconds(1.5), 1.5);
  EXPECT_EQ(plant_seconds(1772366400123LL), 1772366400.123);
  EXPECT_EQ(plant_seconds(1772366400000000LL), 1772366400.0);
  EXPECT_EQ(plant_seconds("2026-03-01T12:00:00Z"), 1772366400.0);
  EXPECT_EQ(plant_seconds("2026-03-01 14:00:00.25+02:00"), 1772366400.25);
  EXPECT_EQ(plant_seconds("2026-03-01T12:00:00"), 1772366400.0);
  for (const Json& bad : {Json("soon"), Json("2026-13-01T00:00:00Z"), Json("2026-03-01T12:00:00+2"), Json("2026-03-01"),
                          Json(-1), Json(), Json("2026-03-01T12:00:nan"), Json("2026-03-01T12:00:00Zulu")})
    EXPECT_FALSE(plant_seconds(bad)) << bad;
}

TEST_F(PlantReaderTest, AnyBytesAreReadOrRefused) {
  std::mt19937 random(20261126);
  const std::string good[] = {R"({"k":3,"value":1.5,"seq":2})", R"({"k":1,"node":"north","values":{"level":1}})",
                              "k,sensor.south.level\n0,1\n", R"([{"t":3,"level":1}])", "17.25"};
  const std::string words[] = {
      "NaN", "1e999", "null", "\"", "{", "[", "\n", std::string("\xff", 1), std::string(1, '\0')};
  int taken = 0, refused = 0;
  for (int n = 0; n < 6000; ++n) {
    std::string payload = good[static_cast<std::size_t>(n) % std::size(good)];
    for (int times = 0; times < n % 4; ++times) {
      const std::size_t at = random() % (payload.size() + 1);
      payload.insert(at, words[random() % std::size(words)]);
      if (random() % 2 == 0) payload.erase(random() % payload.size(), random() % 4);
    }
    SCOPED_TRACE(payload);
    PlantReader plant = reader({{"name", "x"}, {"clock", n % 3 == 0 ? "k" : (n % 3 == 1 ? "time" : "arrival")}});
    const TopicPlace& place = n % 2 == 0 ? level_ : (n % 5 == 0 ? south_ : nobody_);
    try {
      for (const IngestRow& row : plant.read(place, payload)) {
        EXPECT_GE(row.k, 0);
        for (const auto& [column, value] : row.values) EXPECT_FALSE(std::isinf(value));
      }
      ++taken;
    } catch (const InputError&) {
      ++refused;
    } catch (const HttpError&) {
      ++refused;
    }
  }
  EXPECT_GT(taken, 300);
  EXPECT_GT(refused, 300);
}

TEST(PlantOptions, AreReadStrictly) {
  const auto read = [](const Json& json) { return PlantOptions::from_json(json, "/input/ingest/mqtt"); };
  EXPECT_EQ(read("line1").name, "line1");
  const Json whole{{"name", "a"}, {"clock", "arrival"}, {"hold", 2.5}, {"signals", {{"x", "y"}}}};
  EXPECT_EQ(read(whole).to_json(), whole);
  for (const Json& bad :
       {Json(5), Json(""), Json("a/b"), Json("a+"), Json("#"), Json("a b"), Json::object(), Json{{"name", 1}},
        Json{{"name", "a"}, {"clock", "sun"}}, Json{{"name", "a"}, {"hold", -1}}, Json{{"name", "a"}, {"signals", 1}},
        Json{{"name", "a"}, {"signals", {{"x", 1}}}}, Json{{"name", "a"}, {"nosuch", 1}}, Json{{"clock", "k"}}})
    EXPECT_THROW(read(bad), InputError) << bad;
}

}  // namespace
}  // namespace vigil::plant_reader_test
