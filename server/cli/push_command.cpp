// `vigil push`: a CSV file, row by row, into a run of a server that was started with "input":"ingest".
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>
#include <unordered_set>
#include <vector>

#include "engine/core/json.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/ingest/csv_cells.hpp"

namespace vigil {
namespace {

constexpr std::size_t kRowsACall = 500;

struct PushCommand {
  std::string run, file, server = "http://127.0.0.1:8080", token_file;
};

class Pusher {
 public:
  explicit Pusher(const PushCommand& command) : client_(command.server), path_("/api/v1/ingest/" + command.run) {
    if (command.run.empty() ||
        !std::all_of(command.run.begin(), command.run.end(), [](char c) { return c >= '0' && c <= '9'; }))
      throw UserError("RUN is " + command.run + "; expected a run's id");
    if (!client_.is_valid() || !command.server.starts_with("http://"))
      throw UserError("--server is " + command.server + "; expected http://HOST:PORT");
    client_.set_read_timeout(60);
    if (command.token_file.empty()) return;
    const std::string text = read_text(command.token_file);
    client_.set_bearer_token_auth(text.substr(0, text.find_first_of("\r\n")).c_str());
  }

  /// Names of the columns that the run takes.
  std::vector<std::string> columns() { return answer(client_.Get(path_.c_str())).at("columns"); }

  /// Sends it as often as the run is behind.
  void push(const std::string& csv) {
    for (;;) {
      const auto result = client_.Post(path_.c_str(), csv, "text/csv");
      if (!result || result->status != 429) {
        const Json got = answer(result);
        for (const char* name : {"accepted", "duplicate", "late", "beyond"})
          total_[name] = total_.value(name, 0) + got.at(name).get<std::int64_t>();
        total_["closed"] = got.at("closed");
        return;
      }
      std::this_thread::sleep_for(std::chrono::seconds(1));
    }
  }
  const Json& total() const { return total_; }

 private:
  static Json answer(const httplib::Result& result) {
    if (!result) throw UserError("the server does not answer: " + httplib::to_string(result.error()));
    const Json json = Json::parse(result->body, nullptr, false);
    if (result->status == 200 && json.is_object()) return json;
    throw UserError(json.is_object() ? json.value("detail", "the server refused") : "this is no server of Vigil");
  }

  httplib::Client client_;
  std::string path_;
  Json total_ = Json::object();
};

/// One line of the cells that were picked.
std::string line_of(const std::vector<std::string>& cells, const std::vector<std::size_t>& picked) {
  std::string line;
  for (const std::size_t c : picked) line += (line.empty() ? "" : ",") + cells.at(c);
  return line + "\n";
}

/// Where the columns that the run takes stand, k first.
std::vector<std::size_t> pick(const std::vector<std::string>& header, const std::vector<std::string>& columns,
                              const PushCommand& command) {
  std::unordered_set<std::string> known(columns.begin(), columns.end());
  known.insert("seq");
  std::vector<std::size_t> picked;
  const auto tick = std::find(header.begin(), header.end(), "k");
  picked.push_back(static_cast<std::size_t>(tick - header.begin()));
  for (std::size_t c = 0; c < header.size(); ++c) {
    if (known.contains(header[c])) picked.push_back(c);
  }
  if (tick == header.end() || picked.size() < 2)
    throw UserError(command.file + " has no column k and one that run " + command.run + " takes");
  return picked;
}

/// Rows go out as soon as no further one is there to be read, so that what comes slowly comes at once.
void push_all(Pusher& pusher, std::istream& in, const PushCommand& command) {
  std::string line, body;
  std::vector<std::string> header;
  std::vector<std::size_t> picked;
  std::size_t rows = 0;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    CsvCells cells(line);
    if (!cells.more()) continue;
    const std::vector<std::string> row = cells.next();
    if (header.empty()) {
      header = row;
      picked = pick(header, pusher.columns(), command);
      continue;
    }
    if (row.size() != header.size())
      throw UserError("line " + std::to_string(number) + " has not as many cells as the header");
    body += line_of(row, picked);
    if (++rows % kRowsACall != 0 && in.rdbuf()->in_avail() > 0) continue;
    pusher.push(line_of(header, picked) + body);
    body.clear();
  }
  if (!body.empty()) pusher.push(line_of(header, picked) + body);
}

int push(const PushCommand& command) {
  Pusher pusher(command);
  if (command.file == "-") {
    std::ios::sync_with_stdio(false);
    push_all(pusher, std::cin, command);
  } else {
    std::istringstream text(read_text(command.file));
    push_all(pusher, text, command);
  }
  std::cout << pusher.total().dump() << std::endl;
  return kDone;
}

}  // namespace

void add_push(CLI::App& app, Action& action) {
  auto command = std::make_shared<PushCommand>();
  CLI::App* sub = app.add_subcommand("push", "rows of a CSV file into a run that waits for them");
  sub->add_option("RUN", command->run, "its id")->required();
  sub->add_option("FILE", command->file, "k,<signal names> and one row a tick; - for standard input")->required();
  sub->add_option("--server", command->server, "http://127.0.0.1:8080 without");
  sub->add_option("--token-file", command->token_file, "first line: the token");
  sub->callback([command, &action] { action = [command] { return push(*command); }; });
}

}  // namespace vigil
