#include "engine/methods/privacy/confidentiality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vigil::privacy::confidentiality_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Row {
  double eavesdropper, legitimate, index;
  const char* rank;
};

// The table of section 4.7, from its traces.
TEST(Confidentiality, TheEnginesStrategies) {
  for (const Row& row : {Row{0.27385, 0.06942, 1.98, "relatively low"}, Row{0.1789, 0.02067, 3.11, "medium"},
                         Row{0.1697, 0.00745, 4.51, "relatively high"}, Row{0.08961, 0.0071039, 3.66, "medium"},
                         Row{0.26958, 0.0071039, 5.25, "relatively high"},
                         Row{0.3564, 0.012712, 4.81, "relatively high"}, Row{0.0242, 0.012712, 0.93, "low"}}) {
    const double index = confidentiality_index(row.eavesdropper, row.legitimate);
    EXPECT_NEAR(index, row.index, 5.1e-3);
    EXPECT_STREQ(rank_name(confidentiality_rank(index)), row.rank);
  }
}

TEST(Confidentiality, RanksBeginAtTheirBounds) {
  using enum ConfidentialityRank;
  EXPECT_EQ(confidentiality_rank(-3), low);
  EXPECT_EQ(confidentiality_rank(std::nextafter(1.0, 0.0)), low);
  EXPECT_EQ(confidentiality_rank(1), relatively_low);
  EXPECT_EQ(confidentiality_rank(2), medium);
  EXPECT_EQ(confidentiality_rank(4), relatively_high);
  EXPECT_EQ(confidentiality_rank(std::nextafter(8.0, 0.0)), relatively_high);
  EXPECT_EQ(confidentiality_rank(8), high);
  EXPECT_EQ(confidentiality_rank(kInfinity), high);
}

TEST(Confidentiality, IsShownAsItIs) {
  EXPECT_EQ(confidentiality_index(3, 3), 0);
  EXPECT_EQ(confidentiality_index(8, 4), 1);
  EXPECT_EQ(confidentiality_index(1, 4), -2);
  EXPECT_EQ(confidentiality_index(1, 0), kInfinity);
  EXPECT_EQ(confidentiality_index(0, 1), -kInfinity);
  EXPECT_NEAR(confidentiality_index(1e150, 1e-200), 350 * std::log2(10), 1e-9);
  EXPECT_TRUE(std::isnan(confidentiality_index(0, 0)));
  EXPECT_EQ(confidentiality_rank(confidentiality_index(0, 0)), ConfidentialityRank::low);
}

}  // namespace
}  // namespace vigil::privacy::confidentiality_test
