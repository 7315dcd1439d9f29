// `vigil db`: looking after the log.
#include <cmath>
#include <iostream>
#include <memory>

#include "db/maintenance.hpp"
#include "server/cli/commands.hpp"

namespace vigil {
namespace {

struct DbCommand {
  std::string db = "vigil.db";
  std::string target;
  double days = 0;
};

int report(const MaintenanceReport& report) {
  for (const std::string& sentence : report.sentences) (report.ok ? std::cout : std::cerr) << sentence << "\n";
  return report.ok ? kDone : kInternalError;
}

}  // namespace

void add_db(CLI::App& app, Action& action) {
  auto command = std::make_shared<DbCommand>();
  CLI::App* db = app.add_subcommand("db", "check, back up, prune or shrink the log");
  db->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, std::function<int()> work) {
    CLI::App* sub = db->add_subcommand(name, help);
    sub->add_option("--db", command->db, "the log's file, vigil.db without");
    sub->callback([&action, work = std::move(work)] { action = work; });
    return sub;
  };
  db->add_option("--db", command->db, "the log's file, vigil.db without");
  add("check", "whether the file is whole", [command] { return report(check_log(command->db)); });
  add("backup", "copy the log, even while it is in use",
      [command] { return report(backup_log(command->db, command->target)); })
      ->add_option("FILE", command->target, "the copy; must not exist")
      ->required();
  add("prune", "remove finished runs that are not tagged keep",
      [command] {
        if (!std::isfinite(command->days)) throw UserError("--older-than is not a finite number of days");
        return report(prune_log(command->db, command->days));
      })
      ->add_option("--older-than", command->days, "days since they ended")
      ->required()
      ->check(CLI::Range(0.0, 1e6));
  add("vacuum", "give unused space back", [command] { return report(vacuum_log(command->db)); });
}

}  // namespace vigil
