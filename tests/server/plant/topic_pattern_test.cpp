// Topics as one writes them, and what they say of a message.
#include "server/plant/topic_pattern.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "engine/core/input_error.hpp"
#include "server/plant/credentials.hpp"
#include "tests/server/api/fixture.hpp"

namespace vigil::topic_pattern_test {
namespace {

TEST(TopicPatterns, PlacesAreReadOutOfATopic) {
  const TopicPattern pattern("plant/{run}/tank-{node}/{channel}");
  EXPECT_EQ(pattern.filter(), "plant/+/+/+");
  const auto place = pattern.match("plant/line1/tank-north/level");
  ASSERT_TRUE(place);
  EXPECT_EQ(place->run, "line1");
  EXPECT_EQ(place->node, "north");
  EXPECT_EQ(place->channel, "level");
  for (const char* other : {"plant/line1/tank-north", "plant/line1/tank-north/level/x", "plant/line1/north/level",
                            "other/line1/tank-north/level", "plant/line1/tank-/level", "plant//tank-north/level", ""})
    EXPECT_FALSE(pattern.match(other)) << other;
}

TEST(TopicPatterns, WildcardsAreThoseOfMqtt) {
  const TopicPattern one("plant/gw1/+"), rest("plant/{run}/#");
  EXPECT_EQ(one.filter(), "plant/gw1/+");
  EXPECT_TRUE(one.match("plant/gw1/anything"));
  EXPECT_TRUE(one.match("plant/gw1/"));
  EXPECT_FALSE(one.match("plant/gw1"));
  EXPECT_FALSE(one.match("plant/gw1/a/b"));
  EXPECT_EQ(rest.filter(), "plant/+/#");
  EXPECT_EQ(rest.match("plant/7/a/b/c")->run, "7");
  EXPECT_EQ(rest.match("plant/7")->run, "7");
  EXPECT_FALSE(rest.match("plant"));
  EXPECT_TRUE(TopicPattern("#").match("a/b"));
  EXPECT_EQ(TopicPattern("/{channel}").match("/x")->channel, "x");
}

TEST(TopicPatterns, NonsenseIsNamed) {
  for (const char* bad :
       {"", "a/#/b", "a#", "{run}/{run}", "{nosuch}", "{run", "a+b", "{node}{channel}", "a}b", "a\nb", "\xff"})
    EXPECT_THROW(TopicPattern{bad}, InputError) << bad;
}

class CredentialsTest : public ::testing::Test {
 protected:
  std::string write(const std::string& text, mode_t mode = 0600) {
    std::ofstream(folder_.file("who")) << text;
    chmod(folder_.file("who").c_str(), mode);
    return folder_.file("who");
  }
  api_test::TemporaryFolder folder_;
};

TEST_F(CredentialsTest, AreReadFromJsonOrLines) {
  std::ofstream(folder_.file("ca.crt")) << "x";
  const BrokerCredentials json = BrokerCredentials::from_file(write(R"({"user":"u","password":"p=#","ca":"ca.crt"})"));
  EXPECT_EQ(json.user, "u");
  EXPECT_EQ(json.password, "p=#");
  EXPECT_EQ(json.ca, folder_.file("ca.crt"));
  EXPECT_FALSE(json.open_to_others);
  const BrokerCredentials lines = BrokerCredentials::from_file(write("# who\n user = u \npassword=p=#\r\n\n", 0644));
  EXPECT_EQ(lines.user, "u");
  EXPECT_EQ(lines.password, "p=#");
  EXPECT_TRUE(lines.open_to_others);
}

TEST_F(CredentialsTest, AreRefusedWithoutShowingASecret) {
  for (const char* bad : {"user u secret", R"({"user":5,"password":"secret"})", R"({"pass":"secret"})", "{secret",
                          "passwd = secret", "ca = nosuch.secret-is-not-here"}) {
    try {
      BrokerCredentials::from_file(write(bad));
      ADD_FAILURE() << bad;
    } catch (const std::runtime_error& error) {
      const bool names_a_file = std::string(bad).starts_with("ca =");
      EXPECT_TRUE(names_a_file || std::string(error.what()).find("secret") == std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(BrokerCredentials::from_file(folder_.file("nosuch")), std::runtime_error);
}

}  // namespace
}  // namespace vigil::topic_pattern_test
