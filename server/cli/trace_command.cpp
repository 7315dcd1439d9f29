// `vigil trace`: importers of recorded data.
#include <filesystem>
#include <iostream>
#include <memory>

#include "engine/identify/mapping.hpp"
#include "engine/run/mrclam.hpp"
#include "server/cli/commands.hpp"
#include "server/cli/files.hpp"

namespace vigil {
namespace {

struct MrclamCommand {
  std::string folder, out;
  int robot = 0;
  double dt = 0;
};

int mrclam(const MrclamCommand& command) {
  const std::filesystem::path folder(command.folder);
  if (!std::filesystem::is_directory(folder))
    throw UserError("DIR is " + command.folder + "; expected a folder of MRCLAM recordings");
  const std::string robot = "Robot" + std::to_string(command.robot) + "_";
  MrclamFiles files;
  files.barcodes = read_text(folder / "Barcodes.dat");
  files.landmarks = read_text(folder / "Landmark_Groundtruth.dat");
  files.groundtruth = read_text(folder / (robot + "Groundtruth.dat"));
  files.measurement = read_text(folder / (robot + "Measurement.dat"));
  files.odometry = read_text(folder / (robot + "Odometry.dat"));
  write_text(command.out, mrclam_to_csv(files, command.dt));
  return kDone;
}

struct TableCommand {
  std::string file, scenario, map, out;
};

/// The mapping that a scenario keeps, or one in a file of its own.
identify::Mapping find_mapping(const TableCommand& command) {
  if (!command.map.empty()) return identify::read_mapping(read_json(command.map), "");
  if (command.scenario.empty()) throw UserError("no mapping is given; expected --scenario FILE or --map FILE");
  const Json document = read_json(command.scenario);
  const Json::json_pointer place("/view/mapping");
  if (!document.contains(place))
    throw UserError(command.scenario +
                    " has no view.mapping; expected a scenario made by vigil identify, or --map FILE");
  return identify::read_mapping(document.at(place), "/view/mapping");
}

int table(const TableCommand& command) {
  write_text(command.out, identify::table_to_trace(read_text(command.file), find_mapping(command)));
  return kDone;
}

void add_table(CLI::App& trace, Action& action) {
  auto command = std::make_shared<TableCommand>();
  CLI::App* sub = trace.add_subcommand("table", "any table, its columns mapped to signals");
  sub->add_option("FILE", command->file, "the table: a header of names, one row a tick")->required();
  sub->add_option("--scenario", command->scenario, "scenario whose view.mapping is used");
  sub->add_option("--map", command->map, "mapping: {\"columns\":{SIGNAL:COLUMN},…}");
  sub->add_option("--out", command->out, "the trace; - for standard output")->required();
  sub->callback([command, &action] { action = [command] { return table(*command); }; });
}

}  // namespace

void add_trace(CLI::App& app, Action& action) {
  auto command = std::make_shared<MrclamCommand>();
  CLI::App* trace = app.add_subcommand("trace", "importers of recorded data");
  trace->require_subcommand(1);
  CLI::App* sub = trace->add_subcommand("mrclam", "a robot of a UTIAS MRCLAM data set");
  sub->add_option("DIR", command->folder, "folder of the data set")->required();
  sub->add_option("--robot", command->robot, "its number")->required()->check(CLI::Range(1, 99));
  sub->add_option("--dt", command->dt, "seconds a tick")->required()->check(CLI::Range(0.001, 100.0));
  sub->add_option("--out", command->out, "the trace; - for standard output")->required();
  sub->callback([command, &action] { action = [command] { return mrclam(*command); }; });
  add_table(*trace, action);
}

}  // namespace vigil
