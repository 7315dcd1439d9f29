// A run as one file, and back.
#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/api/run_json.hpp"
#include "server/api/sample_csv.hpp"
#include "server/ingest/recorded_rows.hpp"
#include "server/runs/bundle.hpp"

namespace vigil {
namespace {

constexpr std::size_t kBundleLimit = 128u << 20;

/// The inside of a JSON string: what dump() puts between the quotes.
std::string escaped(std::string_view text) {
  const std::string quoted = Json(std::string(text)).dump();
  return quoted.substr(1, quoted.size() - 2);
}

void bundle(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string frames = request.query_value("frames", "true");
  if (frames != "true" && frames != "false")
    throw HttpError(400, "frames is " + in_quotes(frames) + "; expected true or false.");
  // What was answered is in the file: commands are committed already, frames of a live run up to its last commit.
  services.log.flush();
  const RunRow row = run_row(request, services);
  const std::vector<Signal> signals = services.reader.signals(row.id);
  auto trace = row.trace ? services.reader.trace_csv(*row.trace) : std::nullopt;
  if (was_pushed(row)) trace = recorded_rows(services.reader, row);
  if (row.trace && !trace) throw HttpError(409, "The trace this run was made from was deleted: it cannot be repeated.");
  std::string head = bundle_head(row, signals, trace).dump();
  response.content_type = "application/json";
  response.set_header("Content-Disposition", "attachment; filename=\"vigil-run-" + std::to_string(row.id) + ".json\"");
  if (frames == "false") {
    response.body = std::move(head);
    return;
  }
  head.back() = ',';
  head += "\"frames\":\"";
  const std::vector<int> logged = services.reader.logged_signals(row.id);
  response.stream = [&services, id = row.id, last = row.k, signals, logged, head](const BodyWriter& write) {
    if (!write(head)) return false;
    const auto inside = [&write](std::string_view part) { return write(escaped(part)); };
    return write_csv(services.reader, id, signals, logged, 0, std::max<std::int64_t>(last, 0), inside) && write("\"}");
  };
}

void import_bundle(Services& services, const HttpRequest& request, HttpResponse& response) {
  Bundle bundle = read_bundle(request.json());
  RunOrder order = std::move(bundle.order);
  if (order.trace) {
    order.trace_id =
        services.log.put_trace("imported with a bundle", bundle.trace_csv, order.trace->rows(), order.trace->columns());
  }
  if (!order.last && !order.scenario.document().at("time").at("steps").is_number()) {
    throw InputError("/k", "k is missing: an endless run needs the tick it ends at", "an integer");
  }
  read_idempotency(request, order);
  const CreatedRun created = services.runs.create(std::move(order));
  const auto row = services.reader.run(created.id);
  if (!row) throw HttpError(404, "The run that this Idempotency-Key made was deleted.");
  response.json(run_detail(*row, services), 201);
  response.set_header("Location", "/api/v1/runs/" + std::to_string(created.id));
}

}  // namespace

void add_bundle_routes(Routes& routes, Services& services) {
  const Json any{{"type", "object"}};
  routes.add(make_route(
      "GET", "/api/v1/runs/{id}/bundle", [&services](const auto& q, auto& r) { bundle(services, q, r); },
      "A run in one file that `vigil run` accepts",
      doc::Operation()
          .parameter(doc::query("frames", {{"type", "boolean"}}, "false: without the samples"))
          .answer(200, "Document, seed, version, commands, trace, metrics, design, frames.", any)
          .problem(404, "There is no such run.")
          .problem(409, "Its trace was deleted, or the log has not kept all rows that were pushed into it.")
          .what()));
  Route back = make_route(
      "POST", "/api/v1/runs/import", [&services](const auto& q, auto& r) { import_bundle(services, q, r); },
      "Take a bundle back: its run is repeated, with its commands, to its last tick",
      doc::Operation()
          .parameter(doc::header("Idempotency-Key", "the same key with the same body starts no second run"))
          .body(any)
          .answer(201, "The run.", any)
          .problem(413, "The bundle is larger than 128 MiB; leave out its frames.")
          .what());
  back.body_limit = kBundleLimit;
  routes.add(std::move(back));
}

}  // namespace vigil
