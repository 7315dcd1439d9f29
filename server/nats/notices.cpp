#include "server/nats/notices.hpp"

#include <algorithm>

namespace vigil {
namespace {

constexpr std::size_t kLongest = 400;

/// A word that may stand in a subject and in a stream's name.
bool is_word(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !text.empty() && text.size() <= 80 && std::all_of(text.begin(), text.end(), plain);
}

template <class Read>
auto parsed(std::string_view text, Read read) -> std::optional<decltype(read(Json()))> {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string to_text(const CampaignNotice& notice) {
  return Json{{"campaign", notice.id},     {"key", notice.key},
              {"what", notice.what},       {"fingerprint", notice.fingerprint},
              {"plan", notice.plan_bytes}, {"over", notice.over}}
      .dump();
}

std::optional<CampaignNotice> campaign_notice(std::string_view text) {
  auto notice = parsed(text, [](const Json& json) {
    CampaignNotice one;
    one.id = json.at("campaign");
    one.key = json.at("key");
    one.what = json.at("what").get<std::string>().substr(0, kLongest);
    one.fingerprint = json.at("fingerprint");
    one.plan_bytes = json.at("plan");
    one.over = json.at("over");
    return one;
  });
  if (!notice || !is_word(notice->id) || !is_word(notice->key)) return std::nullopt;
  return notice;
}

std::string to_text(const CrewMember& member) { return to_json(member).dump(); }

std::optional<CrewMember> crew_member(std::string_view text) {
  return parsed(text, [](const Json& json) {
    CrewMember member;
    member.name = json.at("name").get<std::string>().substr(0, kLongest);
    member.threads = std::clamp(json.at("threads").get<int>(), 0, 4096);
    if (json.at("refused").is_string()) member.refused = json.at("refused").get<std::string>().substr(0, 4 * kLongest);
    return member;
  });
}

}  // namespace vigil
