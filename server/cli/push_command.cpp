// `vigil push`: a CSV file, row by row, into a run of a server that was started with "input":"ingest".
#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <unordered_set>
#include <vector>

#include "engine/core/json.hpp"
#include "server/cli/api_client.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"
#include "server/ingest/csv_cells.hpp"

namespace vigil {
namespace {

constexpr std::size_t kRowsACall = 500;

struct PushCommand {
  ServerAddress server;
  std::string run, file;
};

class Pusher {
 public:
  explicit Pusher(const PushCommand& command) : client_(command.server) {
    run_path(command.run);  // refuses what is no id
    path_ = "/ingest/" + command.run;
  }

  /// Names of the columns that the run takes.
  std::vector<std::string> columns() { return client_.get(path_).at("columns"); }

  void push(const std::string& csv) {
    const Json got = client_.post_csv(path_, csv);
    for (const char* name : {"accepted", "duplicate", "late", "beyond"})
      total_[name] = total_.value(name, 0) + got.at(name).get<std::int64_t>();
    total_["closed"] = got.at("closed");
  }
  const Json& total() const { return total_; }

 private:
  ApiClient client_;
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
  command->server.add_to(*sub);
  sub->callback([command, &action] { action = [command] { return push(*command); }; });
}

}  // namespace vigil
