#include "server/front/head.hpp"

#include <gtest/gtest.h>

#include <random>

namespace vigil::head_test {
namespace {

const HeadLimits kLimits;

struct Case {
  const char* what;
  std::string bytes;
  int status;
};

std::string with(const std::string& lines) { return "GET /a HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n"; }

std::string many_fields(int count) {
  std::string lines;
  for (int i = 0; i < count; ++i) lines += "h" + std::to_string(i) + ": v\r\n";
  return lines;
}

class HeadRefusals : public testing::TestWithParam<Case> {};

TEST_P(HeadRefusals, AnswersWithItsStatus) {
  Head head;
  const Refusal refusal = parse_head(GetParam().bytes, kLimits, head);
  EXPECT_EQ(refusal.status, GetParam().status) << refusal.detail;
  EXPECT_EQ(refusal.detail.empty(), refusal.status == 0);
}

INSTANTIATE_TEST_SUITE_P(
    Table, HeadRefusals,
    testing::Values(Case{"plain", with(""), 0}, Case{"query", "GET /a?b=c HTTP/1.1\r\nHost: x\r\n\r\n", 0},
                    Case{"old version", "GET /a HTTP/1.0\r\nHost: x\r\n\r\n", 0},
                    Case{"tab in value", with("A: b\tc\r\n"), 0}, Case{"64 fields", with(many_fields(63)), 0},
                    Case{"65 fields", with(many_fields(64)), 431},
                    Case{"no host", "GET /a HTTP/1.1\r\nA: b\r\n\r\n", 421},
                    Case{"empty host", "GET /a HTTP/1.1\r\nHost: \r\n\r\n", 421},
                    Case{"two hosts", with("Host: localhost\r\n"), 400},
                    Case{"absolute form", "GET http://x/a HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"asterisk", "OPTIONS * HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"fragment", "GET /a#b HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"space in target", "GET /a b HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"two spaces", "GET  /a HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"raw UTF-8 in target", "GET /\xc3\xa9 HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"nul in target", std::string("GET /\0 HTTP/1.1\r\nHost: x\r\n\r\n", 28), 400},
                    Case{"backslash", "GET /\\a HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"version 2", "GET /a HTTP/2.0\r\nHost: x\r\n\r\n", 505},
                    Case{"no version", "GET /a\r\nHost: x\r\n\r\n", 400},
                    Case{"bare LF", "GET /a HTTP/1.1\nHost: x\n\n", 400},
                    Case{"bare LF later", "GET /a HTTP/1.1\r\nHost: x\nA: b\r\n\r\n", 400},
                    Case{"bare CR in value", with("A: b\rc\r\n"), 400},
                    Case{"nul in value", with(std::string("A: b\0c\r\n", 8)), 400},
                    Case{"delete in value", with("A: b\x7f\r\n"), 400}, Case{"folded", with("A: b\r\n c\r\n"), 400},
                    Case{"space before colon", with("A : b\r\n"), 400}, Case{"no colon", with("A\r\n"), 400},
                    Case{"no name", with(": b\r\n"), 400}, Case{"chunked", with("Transfer-Encoding: chunked\r\n"), 411},
                    Case{"length and chunked", with("Content-Length: 3\r\nTransfer-Encoding: chunked\r\n"), 411},
                    Case{"identity", with("transfer-encoding: identity\r\n"), 411},
                    Case{"gzip", with("Content-Encoding: gzip\r\n"), 415},
                    Case{"two lengths", with("Content-Length: 3\r\nContent-Length: 3\r\n"), 400},
                    Case{"length list", with("Content-Length: 3, 3\r\n"), 400},
                    Case{"negative length", with("Content-Length: -1\r\n"), 400},
                    Case{"signed length", with("Content-Length: +1\r\n"), 400},
                    Case{"hex length", with("Content-Length: 0x10\r\n"), 400},
                    Case{"endless length", with("Content-Length: 99999999999999999999\r\n"), 400},
                    Case{"empty length", with("Content-Length:\r\n"), 400},
                    Case{"forged address", with("REMOTE_ADDR: 10.9.9.9\r\n"), 400},
                    Case{"forged port", with("local_port: 1\r\n"), 400},
                    Case{"long target", "GET /" + std::string(9000, 'a') + " HTTP/1.1\r\nHost: x\r\n\r\n", 414},
                    Case{"long field", with("A: " + std::string(9000, 'b') + "\r\n"), 431},
                    Case{"long head",
                         with("A: " + std::string(8000, 'b') + "\r\nB: " + std::string(8000, 'b') +
                              "\r\nC: " + std::string(1000, 'b') + "\r\n"),
                         431},
                    Case{"trailing bytes", with("") + "more", 400}, Case{"cut", "GET /a HTTP/1.1\r\nHost: x\r\n", 400},
                    Case{"nothing", "", 400}, Case{"control in method", "G\x01T /a HTTP/1.1\r\nHost: x\r\n\r\n", 400},
                    Case{"endless method", std::string(40, 'A') + " /a HTTP/1.1\r\nHost: x\r\n\r\n", 400}));

TEST(Head, ReadsWhatTheDoorNeeds) {
  Head head;
  ASSERT_FALSE(
      parse_head("POST /a/b?c=d&e HTTP/1.1\r\nHoSt:  localhost:80 \r\ncontent-length: 12\r\nExpect: "
                 "100-Continue\r\nConnection: x, Close\r\n\r\n",
                 kLimits, head));
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.path, "/a/b");
  EXPECT_EQ(head.query, "c=d&e");
  EXPECT_EQ(head.host, "localhost:80");
  EXPECT_EQ(head.content_length, 12u);
  EXPECT_TRUE(head.expects_continue);
  EXPECT_FALSE(head.keep_alive);
  EXPECT_EQ(head.field("HOST"), "localhost:80");
}

/// Whatever is accepted must be something that cannot be read in two ways.
void expect_sound(const Head& head) {
  EXPECT_FALSE(head.host.empty());
  EXPECT_EQ(head.path.front(), '/');
  EXPECT_LE(head.fields.size(), kLimits.fields);
  for (const char c : head.target) EXPECT_TRUE(c > 0x20 && c < 0x7f);
  for (const auto& [name, value] : head.fields) {
    EXPECT_FALSE(name.empty());
    for (const char c : value) EXPECT_TRUE(c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f));
  }
}

std::string mutated(std::mt19937& random, std::string bytes) {
  static const std::string spice = std::string("\r\n\t :?#%&=\0\x7f\xff/\\\"", 16);
  const int times = static_cast<int>(random() % 6);
  for (int i = 0; i < times && !bytes.empty(); ++i) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes.insert(at, 1, spice[random() % spice.size()]);
        break;
      case 2:
        bytes.erase(at, random() % 8);
        break;
      default:
        bytes.insert(at, bytes.substr(at, random() % 40));
    }
  }
  return bytes;
}

TEST(Head, RandomBytesAreRefusedOrSound) {
  std::mt19937 random(20);
  const std::string seed =
      "POST /api/v1/runs?q=a HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
      "2\r\n\r\n";
  int accepted = 0;
  for (int i = 0; i < 60'000; ++i) {
    const std::string bytes = mutated(random, seed);
    Head head;
    if (parse_head(bytes, kLimits, head)) continue;
    ++accepted;
    expect_sound(head);
  }
  EXPECT_GT(accepted, 1000);
}

TEST(HeadScan, FindsTheEndWhateverThePieces) {
  std::mt19937 random(21);
  const std::string bytes = with(many_fields(20)) + "the next request";
  const std::size_t expected = with(many_fields(20)).size();
  for (int i = 0; i < 500; ++i) {
    HeadScan scan;
    Refusal refusal;
    std::size_t length = 0;
    for (std::size_t come = 0; length == 0 && come < bytes.size();) {
      come = std::min(bytes.size(), come + 1 + random() % 50);
      length = scan.scan(std::string_view(bytes).substr(0, come), kLimits, refusal);
      ASSERT_FALSE(refusal) << refusal.detail;
    }
    EXPECT_EQ(length, expected);
  }
}

TEST(HeadScan, GivesUpBeforeTheEndComes) {
  const auto status = [](const std::string& bytes) {
    HeadScan scan;
    Refusal refusal;
    EXPECT_EQ(scan.scan(bytes, kLimits, refusal), 0u);
    return refusal.status;
  };
  EXPECT_EQ(status("GET /" + std::string(8200, 'a')), 414);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nA: " + std::string(8200, 'a')), 431);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + many_fields(3000)), 431);
  EXPECT_EQ(status("\x16\x03\x01\x02"), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nA: b\r\n"), 0);
}

}  // namespace
}  // namespace vigil::head_test
