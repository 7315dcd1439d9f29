// Changing a run while it goes on: PATCH, attacks, forks.
#include <algorithm>

#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"
#include "server/api/run_json.hpp"
#include "server/ingest/recorded_rows.hpp"
#include "server/runs/fork.hpp"

namespace vigil {
namespace {

const Json kRun{{"type", "object"}};

/// All of a PATCH, read and checked before any of it is done.
struct Change {
  std::optional<std::string> state;
  std::optional<Pace> pace;
  std::optional<std::int64_t> step;
  std::optional<Json> params;
  RunUpdate words;

  bool live() const { return state || pace || step || params; }
  bool only_stops() const { return state == "stopped" && !pace && !step && !params; }
};

Change read_change(const Json& body) {
  check_members(body, {"state", "pace", "step", "params", "tags", "note"});
  Change change;
  if (body.contains("state")) {
    const Json& state = body.at("state");
    if (state != "running" && state != "paused" && state != "stopped") {
      throw InputError("/state", "state is " + shown(state) + "; expected running, paused or stopped",
                       "running, paused, stopped");
    }
    change.state = state.get<std::string>();
  }
  if (body.contains("pace")) change.pace = Pace::from_json(body.at("pace"), "/pace");
  if (body.contains("step")) change.step = read_integer(body.at("step"), "step", 1, 100'000);
  if (body.contains("params")) {
    const Json& params = body.at("params");
    if (!params.is_object() || params.empty()) {
      throw InputError("/params", "params is " + shown(params) + "; expected {\"path\":value,…}", "object");
    }
    change.params = params;
  }
  if (body.contains("tags")) change.words.tags = read_tags(body.at("tags"));
  if (body.contains("note")) change.words.note = read_note(body.at("note"));
  return change;
}

/// What may fail comes first, so that a refused change has changed nothing.
void carry_out(const Change& change, LiveRun& run) {
  if (change.step && change.state && *change.state != "paused") {
    throw InputError("/step", "a run that is stepped stays paused; leave out state or make it paused",
                     "no state, or paused");
  }
  if (change.params) run.command({{"params", *change.params}});
  if (change.pace) run.set_pace(*change.pace);
  if (change.state == "paused") run.pause();
  if (change.step) run.step(*change.step);
  if (change.state == "running") run.resume();
  if (change.state == "stopped") {
    run.stop("stopped");
    run.wait_ended(std::chrono::seconds(10));
  }
}

void patch(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Change change = read_change(request.json());
  const RunId id = request.id_param("id");
  if (change.only_stops() && services.runs.stop_designing(id, "stopped")) {
    // It may have begun at that very moment.
    if (const auto begun = services.runs.find(id)) begun->wait_ended(std::chrono::seconds(10));
  } else if (change.live()) {
    carry_out(change, *live_run(request, services));
  } else {
    run_row(request, services);
  }
  if (change.words.tags || change.words.note) services.log.update(id, change.words);
  // The run's thread hands its state to the log without waiting; the answer does wait.
  services.log.flush();
  response.json(run_detail(run_row(request, services), services));
}

void attack(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Json body = request.json();
  check_members(body, {"id", "type", "on", "from", "to", "schedule", "params"});
  Command command;
  try {
    command = live_run(request, services)->command({{"attack", body}});
  } catch (const InputError& error) {
    // The command wraps the body; the asker's pointers do not.
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (problem.pointer.rfind("/attack", 0) == 0) problem.pointer.erase(0, 7);
    }
    throw InputError(std::move(problems));
  }
  const std::string attack_id = command.body.at("attack").at("id").get<std::string>();
  response.json({{"id", attack_id}, {"k", command.k}}, 201);
  response.set_header("Location", "/api/v1/runs/" + request.params.at("id") + "/attacks/" + attack_id);
}

void end_attack(Services& services, const HttpRequest& request, HttpResponse& response) {
  const std::string attack_id = request.params.at("aid");
  const auto run = live_run(request, services);
  try {
    const Command command = run->command({{"end_attack", attack_id}});
    response.json({{"id", attack_id}, {"k", command.k}});
  } catch (const InputError& error) {
    throw HttpError(404, error.what(), error.problems());
  }
}

/// The newest tick there is, logged or not yet.
std::int64_t newest(const RunRow& row, const Services& services) {
  const auto live = services.runs.find(row.id);
  return std::max(row.k, live ? live->tick() : -1);
}

struct Recorded {
  std::optional<std::int64_t> id;
  std::shared_ptr<const Trace> trace;
};

/// What a fork runs on: its parent's trace, or the rows that were pushed into the parent. None: it simulates.
Recorded recorded_input(const RunRow& parent, Services& services) {
  Recorded input{parent.trace, nullptr};
  if (was_pushed(parent)) {
    const std::string csv = recorded_rows(services.reader, parent);
    const Trace trace = Trace::from_csv(csv);
    input.id =
        services.log.put_trace("pushed into run " + std::to_string(parent.id), csv, trace.rows(), trace.columns());
  }
  if (!input.id) return input;
  input.trace = services.runs.trace(*input.id);
  if (!input.trace) throw HttpError(409, "The trace this run was made from was deleted: it cannot be repeated.");
  return input;
}

void fork(Services& services, const HttpRequest& request, HttpResponse& response) {
  const Json body = request.json();
  check_members(body, {"k", "patch", "pace", "tags", "note"});
  RunRow parent = run_row(request, services);
  if (was_pushed(parent)) {
    services.log.flush();
    parent = run_row(request, services);
  }
  if (!body.contains("k")) throw InputError("/k", "k is missing; expected the tick to fork at", "an integer");
  const std::int64_t last = newest(parent, services);
  if (last < 0) throw HttpError(409, "The run has made no tick yet: there is nothing to fork from.");
  const std::int64_t k = read_integer(body.at("k"), "k", 0, last);
  const Recorded input = recorded_input(parent, services);
  RunOrder order = fork_order(parent, k, body.contains("patch") ? body.at("patch") : Json::object(), input.trace);
  order.trace_id = input.id;
  order.pace = Pace::from_json(body.contains("pace") ? body.at("pace") : parent.pace, "/pace");
  if (body.contains("tags")) order.tags = read_tags(body.at("tags"));
  if (body.contains("note")) order.note = read_note(body.at("note"));
  read_idempotency(request, order);
  const CreatedRun created = services.runs.create(std::move(order));
  const auto row = services.reader.run(created.id);
  if (!row) throw HttpError(404, "The run that this Idempotency-Key made was deleted.");
  response.json(run_detail(*row, services), 201);
  response.set_header("Location", "/api/v1/runs/" + std::to_string(created.id));
}

Json patch_doc() {
  return doc::Operation()
      .body(doc::object_schema(
          {{"state", {{"enum", {"running", "paused", "stopped"}}}},
           {"pace", {{"description", "\"max\" or ticks per second"}}},
           {"step", doc::integer_schema(1, 100'000)},
           {"params", {{"type", "object"}, {"description", "dotted path to value; those declared live"}}},
           {"tags", {{"type", "array"}, {"items", {{"type", "string"}}}}},
           {"note", {{"type", "string"}}}}))
      .answer(200, "The run as it is now.", kRun)
      .problem(404, "There is no such run.")
      .problem(409, "The run is over, or is not paused and cannot be stepped.")
      .what();
}

Json attack_doc() {
  const Json tick{{"type", {"number", "null"}}};
  const Json answer = doc::object_schema({{"id", doc::text_schema()}, {"k", {{"type", "integer"}}}});
  return doc::Operation()
      .body(doc::object_schema({{"id", doc::text_schema("chosen by the server where missing")},
                                {"type", doc::text_schema("of GET /methods, attacks")},
                                {"on", {{"type", "array"}, {"items", {{"type", "string"}}}}},
                                {"from", tick},
                                {"to", tick},
                                {"schedule",
                                 {{"type", {"object", "null"}},
                                  {"description", "acts in the first `for` of every `every` ticks, `budget` in all"}}},
                                {"params", {{"type", "object"}}}},
                               {"type"}))
      .answer(201, "Its id, and the tick it acts from.", answer)
      .problem(409, "The run is over.")
      .what();
}

Json fork_doc() {
  return doc::Operation()
      .parameter(doc::header("Idempotency-Key", "the same key with the same body starts no second run"))
      .body(doc::object_schema({{"k", {{"type", "integer"}, {"minimum", 0}}},
                                {"patch", {{"type", "object"}, {"description", "what differs after k"}}},
                                {"pace", {{"description", "the parent's where missing"}}},
                                {"tags", {{"type", "array"}, {"items", {{"type", "string"}}}}},
                                {"note", {{"type", "string"}}}},
                               {"k"}))
      .answer(201, "The new run.", kRun)
      .problem(409, "There is nothing to fork from.")
      .problem(422, "The patch would alter the past, or k lies outside the run.")
      .what();
}

}  // namespace

void add_control_routes(Routes& routes, Services& services) {
  routes.add(make_route(
      "PATCH", "/api/v1/runs/{id}", [&services](const auto& q, auto& r) { patch(services, q, r); },
      "Pause, resume, step, stop or change a run", patch_doc()));
  routes.add(make_route(
      "POST", "/api/v1/runs/{id}/attacks", [&services](const auto& q, auto& r) { attack(services, q, r); },
      "Start an attack in a live run", attack_doc()));
  routes.add(make_route(
      "DELETE", "/api/v1/runs/{id}/attacks/{aid}", [&services](const auto& q, auto& r) { end_attack(services, q, r); },
      "End an attack of a live run",
      doc::Operation()
          .answer(200, "Its id, and the tick it ends before.", kRun)
          .problem(404, "There is no such attack.")
          .problem(409, "The run is over.")
          .what()));
  routes.add(make_route(
      "POST", "/api/v1/runs/{id}/fork", [&services](const auto& q, auto& r) { fork(services, q, r); },
      "A new run that shares this one's past", fork_doc()));
}

}  // namespace vigil
