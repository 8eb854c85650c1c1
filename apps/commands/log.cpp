#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/open_files.h>
#include <glissade/apps/record/log_mcap.h>
#include <glissade/apps/record/log_tables.h>

namespace glissade::apps {

namespace {

constexpr const char* kLogFooter =
    "Examples:\n"
    "  glissade demo --offline --seconds 2 --record both.lcmlog && glissade log to-csv both.lcmlog both\n"
    "  glissade demo --seconds 3 --record shown.lcmlog && glissade log to-mcap shown.lcmlog shown.mcap";

constexpr const char* kTablesFooter =
    "LOG is a file of 'glissade record', 'glissade demo --record', a flight recorder or lcm-logger. The tables are\n"
    "  ticks.csv   start time and duration of each tick of the haptic loop\n"
    "  parts.csv   ghost and visible pose of each part, with its state\n"
    "  hands.csv   force on each hand, and the reason if it is reduced\n"
    "  gloves.csv  pose, velocity and joint angles that each glove measured\n"
    "Empty tables are not written. For all columns, see docs/file_formats.md in the sources.\n"
    "If the log is damaged, the tables have everything before the damage, and the exit code is 1. Events that cannot\n"
    "be read because their bytes have changed are omitted and counted, and the exit code is 1.\n"
    "\n"
    "Examples:\n"
    "  glissade demo --seconds 3 --record log.lcmlog && glissade log to-csv log.lcmlog tables\n"
    "  glissade demo --offline --seconds 2 --record ticks.lcmlog && glissade log to-csv ticks.lcmlog offline";

constexpr const char* kMcapFooter =
    "FILE can be opened with Foxglove and PlotJuggler. Its topics are\n"
    "  /tf        poses of visible parts (part_0, ...), ghosts (ghost_0, ...), hands (hand_0, ...) and their segments\n"
    "             (hand_0_palm, ...) in the world\n"
    "  /scene     meshes of the scene, simplified to at most about 100,000 triangles, their names, ghosts, and hands\n"
    "  /contacts  contacts that push, and arrows of 10 mm/N for the forces on hands; at most 60 messages a second\n"
    "  /part_0    state, contacts, position and lag of each part\n"
    "  /hand_0    force, torque and energy of each hand, and the reason if the force is reduced\n"
    "  /loop      start time and duration of each tick of the haptic loop\n"
    "A log without the beginning of a run, such as a log of lcm-logger, has no /scene. For all values, see\n"
    "docs/file_formats.md in the sources.\n"
    "If the log is damaged, the file has everything before the damage, and the exit code is 1. Events that cannot be\n"
    "read because their bytes have changed are omitted and counted, and the exit code is 1.\n"
    "\n"
    "Examples:\n"
    "  glissade demo --offline --seconds 4 --record scene.lcmlog && glissade log to-mcap scene.lcmlog scene.mcap\n"
    "  glissade demo --seconds 3 --record mcap.lcmlog && glissade log to-mcap mcap.lcmlog demo.mcap";

struct LogOptions {
  std::string log;
  std::string folder;
  std::string file;
  std::string scene;
};

int write_tables(const LogOptions& options) {
  std::string damage;
  const std::vector<LogTable> tables = write_log_tables(options.log, options.folder, damage);
  for (const LogTable& table : tables)
    std::cout << table.file << ": " << table.rows << (table.rows == 1 ? " row\n" : " rows\n");
  if (!damage.empty()) throw std::runtime_error(damage);
  if (tables.empty()) throw std::invalid_argument(options.log + ": has no channel for a table");
  return 0;
}

int write_mcap(const LogOptions& options) {
  std::string damage;
  const std::vector<McapTopic> topics = write_log_mcap(options.log, options.file, options.scene, damage);
  for (const McapTopic& topic : topics)
    std::cout << topic.topic << ": " << topic.messages << (topic.messages == 1 ? " message\n" : " messages\n");
  if (!damage.empty()) throw std::runtime_error(damage);
  if (topics.empty()) throw std::invalid_argument(options.log + ": has no tick of a haptic loop");
  return 0;
}

}  // namespace

void add_log_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<LogOptions>();
  CLI::App* command = app.add_subcommand("log", "Convert event logs to other files");
  command->require_subcommand(1);
  command->footer(kLogFooter);
  CLI::App* tables = command->add_subcommand("to-csv", "Convert an event log of LCM to tables (CSV)");
  tables->footer(kTablesFooter);
  tables->add_option("LOG", options->log, "Event log of LCM")->required();
  tables->add_option("FOLDER", options->folder, "Folder for the tables; created if it does not exist")->required();
  tables->callback([options, &chosen] { chosen = [options] { return write_tables(*options); }; });

  CLI::App* mcap =
      command->add_subcommand("to-mcap", "Convert an event log of LCM to MCAP, for Foxglove and PlotJuggler");
  mcap->footer(kMcapFooter);
  mcap->add_option("LOG", options->log, "Event log of LCM")->required();
  mcap->add_option("FILE", options->file, "File to write")->required();
  mcap->add_option("--scene", options->scene, "Scene file instead of the recorded one");
  add_strict_option(*mcap);
  mcap->callback([options, &chosen] { chosen = [options] { return write_mcap(*options); }; });
}

}  // namespace glissade::apps
