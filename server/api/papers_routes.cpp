// The papers, run again: what they print, what came out, and the job that runs them.
#include "server/api/papers_routes.hpp"

#include <algorithm>

#include "engine/core/describe.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/read_body.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostRuns = 10'000;
constexpr std::size_t kMostItems = 100;

const papers::Item* find(const std::string& key) {
  for (const papers::Item& item : papers::items()) {
    if (item.key == key) return &item;
  }
  return nullptr;
}

/// In the order of the sources, each once. Throws InputError below /only.
std::vector<const papers::Item*> chosen(const Json& only) {
  if (!only.is_array() || only.empty() || only.size() > kMostItems)
    throw InputError("/only", "only is " + shown(only) + "; expected a list of keys", "keys of GET /papers");
  std::vector<const papers::Item*> wanted;
  for (std::size_t i = 0; i < only.size(); ++i) {
    const papers::Item* item = only[i].is_string() ? find(only[i].get<std::string>()) : nullptr;
    if (item == nullptr)
      throw InputError("/only/" + std::to_string(i), "there is no item " + shown(only[i]), "keys of GET /papers");
    wanted.push_back(item);
  }
  std::vector<const papers::Item*> list;
  for (const papers::Item& item : papers::items()) {
    if (std::find(wanted.begin(), wanted.end(), &item) != wanted.end()) list.push_back(&item);
  }
  return list;
}

PapersOrder read_papers(const Json& body) {
  check_members(body, {"only", "runs", "seed"});
  PapersOrder order;
  if (body.contains("runs")) order.runs = read_integer(body.at("runs"), "runs", 2, kMostRuns);
  const auto last = static_cast<std::int64_t>(kLargestSeed) - kMostRuns;
  if (body.contains("seed"))
    order.first_seed = static_cast<std::uint64_t>(read_integer(body.at("seed"), "seed", 0, last));
  if (body.contains("only")) {
    order.items = chosen(body.at("only"));
  } else {
    for (const papers::Item& item : papers::items()) order.items.push_back(&item);
  }
  return order;
}

void show(const PapersManager& papers, const HttpRequest& request, HttpResponse& response) {
  const std::string key = request.params.at("source") + "/" + request.params.at("figure");
  const papers::Item* item = find(key);
  if (item == nullptr)
    throw HttpError(404, "There is no item " + in_quotes(key) + "; GET /api/v1/papers has them all.");
  response.json(papers.item(*item));
}

void report(const PapersManager& papers, HttpResponse& response) {
  std::string html = papers.report();
  if (html.empty()) throw HttpError(404, "No item of the papers was run yet; POST /api/v1/papers runs them.");
  response.text(std::move(html), "text/html; charset=utf-8");
  response.set_header("Content-Disposition", "attachment; filename=\"vigil-papers.html\"");
}

Json list_of(const char* what) { return {{"type", "array"}, {"items", {{"type", "object"}}}, {"description", what}}; }

Json item_schema() {
  const Json number{{"type", {"number", "null"}}}, count{{"type", {"integer", "null"}}},
      text{{"type", {"string", "null"}}};
  const Json words = doc::object_schema({{"en", doc::text_schema()}, {"zh", doc::text_schema()}});
  const Json verdict{{"enum", {"reproduced", "reproduced after correction", "not reproduced", nullptr}}};
  return doc::object_schema(
      {{"key", doc::text_schema("source and figure")},
       {"title", words},
       {"spec", doc::text_schema("specification and section")},
       {"scenario", doc::text_schema("the preset it comes from")},
       {"rule", doc::text_schema("how the verdict comes about")},
       {"reason", doc::text_schema("what had to be corrected, or why ours differs")},
       {"paper", {{"type", {"number", "string", "null"}}, {"description", "as printed, or in our words"}}},
       {"ours", number},
       {"se", number},
       {"verdict", verdict},
       {"runs", count},
       {"seed", count},
       {"version", text},
       {"ended", text},
       {"zh", {{"type", "object"}, {"description", "paper, reason and rule in Chinese"}}},
       {"scenes", list_of("runs that the figure is of: name, scenario, patch; what POST /runs takes")},
       {"methods", list_of("id and title of the methods in them: GET /documentation/{method}")},
       {"equations", list_of("number, says, tex, mathml; of one item alone")},
       {"figure", {{"type", {"object", "null"}}, {"description", "claims and panels; of one item alone"}}}});
}

Json job_schema() {
  const Json keys{{"type", "array"}, {"items", {{"type", "string"}}}};
  const Json failed{{"type", "array"}, {"items", {{"type", "object"}}}};
  Json schema = doc::object_schema({{"state", {{"enum", {"running", "finished", "cancelled"}}}},
                                    {"items", keys},
                                    {"done", doc::integer_schema(0, 1000)},
                                    {"current", {{"type", {"string", "null"}}}},
                                    {"runs_made", doc::integer_schema(0, INT64_MAX)},
                                    {"runs", doc::integer_schema(2, kMostRuns)},
                                    {"seed", doc::integer_schema(0, static_cast<std::int64_t>(kLargestSeed))},
                                    {"failed", failed},
                                    {"started", doc::text_schema()},
                                    {"ended", {{"type", {"string", "null"}}}},
                                    {"taken_up", {{"type", {"object", "null"}}}}});
  schema["type"] = {"object", "null"};
  return schema;
}

Json start_doc() {
  const Json only{{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}}}, {"description", "all without"}};
  return doc::Operation()
      .body(doc::object_schema({{"only", only},
                                {"runs", doc::integer_schema(2, kMostRuns)},
                                {"seed", doc::integer_schema(0, static_cast<std::int64_t>(kLargestSeed) - kMostRuns)}}))
      .answer(202, "The job.", doc::object_schema({{"job", job_schema()}}))
      .problem(409, "One goes on.")
      .problem(422, "There is no such item, or a number is out of range.")
      .what();
}

}  // namespace

void add_papers_routes(Routes& routes, PapersManager& papers) {
  routes.add(make_route(
      "GET", "/api/v1/papers",
      [&papers](const auto&, auto& r) {
        const Json job = papers.job();  // first: an item that it says is done is among the items
        r.json({{"items", papers.items()}, {"job", job}});
      },
      "Every figure and table of the papers with its newest result, and the job that runs them",
      doc::Operation()
          .answer(200, "Items and job.",
                  doc::object_schema({{"items", {{"type", "array"}, {"items", item_schema()}}}, {"job", job_schema()}}))
          .what()));
  routes.add(make_route(
      "POST", "/api/v1/papers",
      [&papers](const auto& q, auto& r) {
        papers.start(read_papers(q.json()));
        r.json({{"job", papers.job()}}, 202);
      },
      "Run items of the papers again", start_doc()));
  routes.add(make_route(
      "GET", "/api/v1/papers/{source}/{figure}", [&papers](const auto& q, auto& r) { show(papers, q, r); },
      "An item with its figure",
      doc::Operation().answer(200, "The item.", item_schema()).problem(404, "There is no such item.").what()));
  routes.add(make_route(
      "DELETE", "/api/v1/papers/job",
      [&papers](const auto&, auto& r) {
        papers.cancel();
        r.empty();
      },
      "Cancel the job; items that are done stay", doc::Operation().empty(204, "No job goes on.").what()));
  routes.add(make_route(
      "GET", "/api/v1/papers/report.html", [&papers](const auto&, auto& r) { report(papers, r); },
      "The newest results as one page that needs nothing else",
      doc::Operation()
          .answer(200, "The page.", doc::text_schema(), "text/html")
          .problem(404, "Nothing was run yet.")
          .what()));
}

}  // namespace vigil
