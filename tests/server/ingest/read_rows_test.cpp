// Bytes into rows, or a refusal that names what is wrong.
#include "server/ingest/read_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/describe.hpp"
#include "server/front/message.hpp"

namespace vigil::read_rows_test {
namespace {

class ReadRows : public ::testing::Test {
 protected:
  ReadRows() {
    columns_.nodes = {"1", "3"};
    columns_.names = {"sensor.1.y1", "sensor.1.y2", "sensor.3.y1", "truth.x", "link.1-3.state"};
    columns_.reporter = {0, 0, 1, -1, -1};
  }
  std::vector<IngestRow> read(const char* type, const std::string& body) const {
    return RowReader(columns_).read(type, body);
  }
  void refused(const char* type, const std::string& body, const std::string& pointer) const {
    SCOPED_TRACE(body);
    try {
      read(type, body);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().pointer, pointer) << error.what();
    }
  }
  void unreadable(const char* type, const std::string& body) const {
    SCOPED_TRACE(body);
    try {
      read(type, body);
      ADD_FAILURE() << "was read";
    } catch (const HttpError& error) {
      EXPECT_EQ(error.status(), 400);
      EXPECT_TRUE(is_utf8(error.what()));
    }
  }
  static constexpr const char* kLines = "application/x-ndjson";
  static constexpr const char* kJson = "application/json";
  static constexpr const char* kCsv = "text/csv";
  PushedColumns columns_;
};

TEST_F(ReadRows, LinesOfNodesAndOfWholeNames) {
  const auto rows = read(kLines,
                         "{\"seq\":9,\"k\":12,\"node\":\"3\",\"values\":{\"y1\":1.5}}\n\n"
                         "{\"k\":13,\"node\":1,\"values\":{\"y2\":null}}\r\n{\"k\":14,\"values\":{\"truth.x\":-2}}");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].k, 12);
  EXPECT_EQ(rows[0].seq, 9u);
  EXPECT_EQ(rows[0].source, 1);
  EXPECT_EQ(rows[0].values, (std::vector<std::pair<int, double>>{{2, 1.5}}));
  EXPECT_EQ(rows[1].source, 0);
  EXPECT_TRUE(std::isnan(rows[1].values[0].second));
  EXPECT_EQ(rows[2].source, -1);
  EXPECT_EQ(rows[2].values[0], (std::pair<int, double>(3, -2)));
}

TEST_F(ReadRows, JsonIsOneRowOrAnArray) {
  EXPECT_EQ(read(kJson, R"({"k":1,"values":{}})").size(), 1u);
  EXPECT_EQ(read(kJson, R"( [{"k":1,"values":{}},{"k":2,"values":{}}])").size(), 2u);
  unreadable(kJson, "[]");
  unreadable(kJson, R"([{"k":1,"values":{}}],"rows":[])");
  refused(kJson, "[5]", "/0");
}

TEST_F(ReadRows, CsvHasAHeader) {
  const auto rows = read(kCsv, "k,t,seq,sensor.1.y1,truth.x\r\n4,0.4,7,1e-3,\r\n5,0.5,,+2,-0.25\r\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].k, 4);
  EXPECT_EQ(rows[0].seq, 7u);
  EXPECT_EQ(rows[0].values[0].second, 1e-3);
  EXPECT_TRUE(std::isnan(rows[0].values[1].second));
  EXPECT_FALSE(rows[1].seq);
  EXPECT_EQ(rows[1].values[1].second, -0.25);
  refused(kCsv, "k,sensor.1.y1\n1,nan\n", "/0/sensor.1.y1");
  refused(kCsv, "k,sensor.1.y1\n1,1e999\n", "/0/sensor.1.y1");
  refused(kCsv, "k,sensor.1.y1\n1,1,2\n", "");
  refused(kCsv, "k,sensor.9.y1\n1,1\n", "");
  refused(kCsv, "k,truth.x,truth.x\n1,1,1\n", "");
  refused(kCsv, "t,truth.x\n1,1\n", "");
  refused(kCsv, "k,truth.x\n1.5,1\n", "/0/k");
  refused(kCsv, "k,truth.x\n-1,1\n", "/0/k");
  unreadable(kCsv, "k,truth.x\n");
  unreadable(kCsv, "");
}

TEST_F(ReadRows, WhatIsWrongIsNamed) {
  unreadable(kLines, "");
  unreadable(kLines, "nonsense");
  unreadable(kLines, "{\"k\":1,\"values\":{\"truth.x\":NaN}}");
  unreadable(kLines, "{\"k\":1,\"values\":{\"truth.x\":1e999}}");
  unreadable(kLines, "{\"k\":1,\"k\":2,\"values\":{}}");
  unreadable(kLines, std::string(100'000, '['));
  unreadable(kLines, "{\"k\":1,\"values\":{\"\xff\":1}}");
  unreadable(kJson, "[{\xef\xbb\xbf:3}]");
  refused(kLines, R"({"values":{}})", "/0/k");
  refused(kLines, R"({"k":-1,"values":{}})", "/0/k");
  refused(kLines, R"({"k":1e300,"values":{}})", "/0/k");
  refused(kLines, R"({"k":1})", "/0/values");
  refused(kLines, R"({"k":1,"values":[]})", "/0/values");
  refused(kLines, R"({"k":1,"value":{}})", "/0/value");
  refused(kLines, R"({"k":1,"node":"2","values":{}})", "/0/node");
  refused(kLines, R"({"k":1,"seq":-4,"values":{}})", "/0/seq");
  refused(kLines, "{\"k\":1,\"values\":{}}\n{\"k\":1,\"node\":\"3\",\"values\":{\"y2\":1}}", "/1/values/y2");
  refused(kLines, R"({"k":1,"values":{"truth.x":"1"}})", "/0/values/truth.x");
  refused(kLines, R"({"k":1,"values":{"truth.x":true}})", "/0/values/truth.x");
  refused(kLines, R"({"k":1,"values":{"link.1-3.state":4}})", "/0/values/link.1-3.state");
  refused(kLines, R"({"k":1,"values":{"link.1-3.state":0.5}})", "/0/values/link.1-3.state");
  std::string many;
  for (int i = 0; i < 20'001; ++i) many += "{\"k\":1,\"values\":{}}\n";
  refused(kLines, many, "");
}

}  // namespace
}  // namespace vigil::read_rows_test
