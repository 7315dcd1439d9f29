#include "server/nats/campaign_streams.hpp"

#include <random>
#include <stdexcept>

#include "server/nats/notices.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kStreamAnswer = 2000;  // ms to wait for one
constexpr int kBatch = 64;
constexpr std::int64_t kDuplicates = 120'000'000'000;  // ns in which the same message counts once

std::string fresh_word() {
  std::random_device device;
  std::string word;
  for (int i = 0; i < 8; ++i) word += "0123456789abcdef"[device() % 16];
  return word;
}

std::int64_t nanoseconds(std::chrono::nanoseconds time) { return time.count(); }

jsOptions patient() {
  jsOptions options;
  jsOptions_Init(&options);
  options.Wait = kStreamAnswer;
  return options;
}

/// What a broker answers that will not change its mind.
bool is_final(natsStatus status, jsErrCode code) {
  return status != NATS_OK && (code == JSNotEnabledErr || code == JSNotEnabledForAccountErr);
}

}  // namespace

CampaignStreams::CampaignStreams(const NatsConnection& connection, std::string id)
    : connection_(connection), id_(std::move(id)) {}

CampaignStreams::~CampaignStreams() {
  results_.reset();
  if (connection_.connected()) sweep();
}

/// Deletes every stream of this campaign.
void CampaignStreams::sweep() const {
  jsOptions options = patient();
  jsStreamNamesList* raw = nullptr;
  if (js_StreamNames(&raw, connection_.streams(), &options, nullptr) != NATS_OK) return;
  const NatsOwned<jsStreamNamesList> names(raw);
  for (int i = 0; i < raw->Count; ++i) {
    const std::string name = raw->List[i];
    const bool own = name.starts_with(job_stream(id_) + "_") || name.starts_with(result_stream(id_) + "_");
    if (own) js_DeleteStream(connection_.streams(), name.c_str(), &options, nullptr);
  }
}

bool CampaignStreams::make() {
  results_.reset();
  sweep();
  key_ = id_ + "_" + fresh_word();
  if (!add_stream(job_stream(key_), job_subject(key_), js_FileStorage)) return false;
  // Results wait a moment only; those that a broker takes along when it dies are made again.
  if (!add_stream(result_stream(key_), result_subject(key_), js_MemoryStorage)) return false;
  if (!add_consumer(job_stream(key_), kWorkers, kMostDeliveries)) return false;
  if (!add_consumer(result_stream(key_), kCampaign, -1)) return false;
  const std::string stream = result_stream(key_);
  jsSubOptions how;
  jsSubOptions_Init(&how);
  how.Stream = stream.c_str();
  how.Consumer = kCampaign;
  jsOptions options = patient();
  natsSubscription* raw = nullptr;
  const std::string subject = result_subject(key_);
  const natsStatus status =
      js_PullSubscribe(&raw, connection_.streams(), subject.c_str(), kCampaign, &options, &how, nullptr);
  results_.reset(raw);
  return status == NATS_OK;
}

bool CampaignStreams::add_stream(const std::string& name, const std::string& subject, jsStorageType storage) {
  jsStreamConfig config;
  jsStreamConfig_Init(&config);
  const char* subjects[] = {subject.c_str()};
  config.Name = name.c_str();
  config.Subjects = subjects;
  config.SubjectsLen = 1;
  config.Retention = js_WorkQueuePolicy;
  config.Storage = storage;
  config.Duplicates = kDuplicates;
  jsOptions options = patient();
  jsErrCode code{};
  const natsStatus status = js_AddStream(nullptr, connection_.streams(), &config, &options, &code);
  if (is_final(status, code))
    throw BrokerRefusal("the broker keeps no streams; it must be started with JetStream (nats-server -js)");
  return status == NATS_OK;
}

bool CampaignStreams::add_consumer(const std::string& stream, const char* name, int deliveries) {
  jsConsumerConfig config;
  jsConsumerConfig_Init(&config);
  config.Durable = name;
  config.AckPolicy = js_AckExplicit;
  config.AckWait = nanoseconds(kAckWait);
  config.MaxDeliver = deliveries;
  config.MaxAckPending = 100'000;
  config.MaxWaiting = 10'000;
  jsOptions options = patient();
  return js_AddConsumer(nullptr, connection_.streams(), stream.c_str(), &config, &options, nullptr) == NATS_OK;
}

bool CampaignStreams::publish(const std::vector<TrialJob>& jobs) {
  if (jobs.empty()) return true;
  const std::string subject = job_subject(key_), stream = job_stream(key_);
  for (const TrialJob& job : jobs) {
    const std::string bytes = to_bytes(job);
    const std::string name =
        id_ + "-" + std::to_string(job.first) + "-" + std::to_string(job.count) + "-" + std::to_string(job.attempt);
    jsPubOptions how;
    jsPubOptions_Init(&how);
    how.MsgId = name.c_str();
    how.ExpectStream = stream.c_str();
    const auto size = static_cast<int>(bytes.size());
    if (js_PublishAsync(connection_.streams(), subject.c_str(), bytes.data(), size, &how) != NATS_OK) return false;
  }
  jsPubOptions wait;
  jsPubOptions_Init(&wait);
  wait.MaxWait = kStreamAnswer;
  return js_PublishAsyncComplete(connection_.streams(), &wait) == NATS_OK;
}

std::vector<std::string> CampaignStreams::collect(std::chrono::milliseconds patience) {
  std::vector<std::string> pieces;
  natsMsgList list{};
  if (!results_ || natsSubscription_Fetch(&list, results_.get(), kBatch, patience.count(), nullptr) != NATS_OK)
    return pieces;
  for (int i = 0; i < list.Count; ++i) {
    pieces.emplace_back(text_of(list.Msgs[i]));
    natsMsg_Ack(list.Msgs[i], nullptr);
  }
  natsMsgList_Destroy(&list);
  return pieces;
}

CampaignStreams::Health CampaignStreams::health() {
  if (key_.empty()) return Health::lost;
  jsOptions options = patient();
  const auto left = [&](const std::string& stream, std::uint64_t& count) {
    jsStreamInfo* raw = nullptr;
    jsErrCode code{};
    const natsStatus status = js_GetStreamInfo(&raw, connection_.streams(), stream.c_str(), &options, &code);
    const NatsOwned<jsStreamInfo> info(raw);
    if (status == NATS_OK) count = info->State.Msgs;
    return status == NATS_OK ? Health::busy : code == JSStreamNotFoundErr ? Health::lost : Health::unknown;
  };
  std::uint64_t jobs = 0, results = 0;
  for (const Health each : {left(job_stream(key_), jobs), left(result_stream(key_), results)}) {
    if (each != Health::busy) return each;
  }
  if (results > 0) return Health::busy;
  if (jobs == 0) return Health::idle;
  jsConsumerInfo* raw = nullptr;
  jsErrCode code{};
  const std::string stream = job_stream(key_);
  const natsStatus status = js_GetConsumerInfo(&raw, connection_.streams(), stream.c_str(), kWorkers, &options, &code);
  const NatsOwned<jsConsumerInfo> info(raw);
  if (status != NATS_OK) return code == JSConsumerNotFoundErr ? Health::lost : Health::unknown;
  return info->NumPending == 0 && info->NumAckPending == 0 ? Health::exhausted : Health::busy;
}

std::vector<TrialJob> CampaignStreams::take_exhausted() {
  std::vector<TrialJob> jobs;
  jsOptions options = patient();
  const std::string stream = job_stream(key_);
  jsStreamInfo* raw = nullptr;
  if (js_GetStreamInfo(&raw, connection_.streams(), stream.c_str(), &options, nullptr) != NATS_OK) return jobs;
  const NatsOwned<jsStreamInfo> info(raw);
  for (std::uint64_t place = info->State.FirstSeq; place <= info->State.LastSeq && place > 0; ++place) {
    natsMsg* message = nullptr;
    if (js_GetMsg(&message, connection_.streams(), stream.c_str(), place, &options, nullptr) != NATS_OK) continue;
    const NatsOwned<natsMsg> owned(message);
    jobs.push_back(job_from_bytes(text_of(message)));
    js_DeleteMsg(connection_.streams(), stream.c_str(), place, &options, nullptr);
  }
  return jobs;
}

}  // namespace vigil
