#include "server/runs/order.hpp"

#include <algorithm>
#include <cmath>

namespace vigil {
namespace {

constexpr double kMostExact = 9007199254740992.0;  // 2^53: up to here every whole number is a double

/// The document however its numbers were written: whoever reads it and sends it back may have made 1 of 1.0.
Json canonical(Json value) {
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (std::abs(number) < kMostExact && number == std::trunc(number)) return static_cast<std::int64_t>(number);
  }
  if (value.is_structured())
    for (Json& member : value) member = canonical(std::move(member));
  return value;
}

}  // namespace

Run make_run(const RunOrder& order) {
  RunOptions options;
  options.seed = order.seed;
  options.trace = order.feed ? order.feed->trace() : order.trace;
  options.commands = order.commands;
  options.designs = order.designs;
  Run run(order.scenario, std::move(options));
  if (order.feed) check_pushed(order.feed->columns(), run.catalogue());
  return run;
}

RunRecord make_record(const RunOrder& order, const Run& run) {
  RunRecord record = make_record(order);
  record.dt = run.dt();
  record.steps = run.steps();
  return record;
}

RunRecord make_record(const RunOrder& order) {
  const Json& document = order.scenario.document();
  RunRecord record;
  record.scenario = order.scenario.id();
  record.family = order.scenario.family();
  record.document = document;
  record.document_hash = sha256_hex(canonical(document).dump());
  record.seed = order.seed;
  record.version = std::string(version());
  record.cpu = cpu_features();
  record.pace = order.pace.to_json();
  record.input = order.trace_id ? Json{{"trace", std::to_string(*order.trace_id)}} : Json("simulate");
  if (order.feed) record.input = order.feed->to_json();
  record.trace = order.trace_id;
  record.tags = order.tags;
  record.note = order.note;
  record.parent = order.parent;
  const Json& time = document.at("time");
  record.dt = time.at("dt").get<double>();
  if (time.at("steps").is_number()) record.steps = time.at("steps").get<std::int64_t>();
  if (!order.designs.empty()) record.designs = order.designs;
  record.policy = log_policy(document, order.pace);
  record.keep = log_keep(document);
  record.reproducible = !order.feed && document.value("reproducible", true);  // what is pushed comes once
  record.idempotency_key = order.idempotency_key;
  record.idempotency_hash = order.idempotency_hash;
  return record;
}

std::string cpu_features() {
#if defined(__x86_64__)
  std::string features = "x86-64";
  if (__builtin_cpu_supports("avx")) features += " avx";
  if (__builtin_cpu_supports("avx2")) features += " avx2";
  if (__builtin_cpu_supports("fma")) features += " fma";
  if (__builtin_cpu_supports("avx512f")) features += " avx512f";
  return features;
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "other";
#endif
}

}  // namespace vigil
