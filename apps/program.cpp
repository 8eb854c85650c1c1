#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/program.h>
#include <glissade/apps/standard_streams.h>
#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>

namespace glissade::apps {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

constexpr const char* kDescription =
    "Real-time haptic rendering: exact collision, sliding contact, force-feedback gloves.\n"
    "Metres, newtons, seconds and radians everywhere; quaternions are w, x, y, z.";

constexpr const char* kFooter =
    "Help on a command: glissade help COMMAND\n"
    "Exit code: 0 on success, 1 if a run fails, 2 for wrong input or usage; 3 if 'slide --require-goal' misses a "
    "goal.\n"
    "An error is one line on standard error.";

int fail(int exit_code, const std::string& message) {
  std::cerr << "glissade: " << one_line(message) << '\n';
  return exit_code;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app;
  Command chosen;
  declare_program(app, chosen);
  std::vector<std::string> arguments = with_help_as_option(app, {argv + 1, argv + argc});
  std::reverse(arguments.begin(), arguments.end());  // as the parser takes them
  try {
    app.parse(arguments);
  } catch (const CLI::Success& request) {
    return app.exit(request);  // --help and --version
  } catch (const CLI::ParseError& error) {
    std::string sentence = unexpected_arguments(app);
    if (sentence.empty()) check_numbers(app);  // says more than the parser of a text that is no number
    if (sentence.empty()) sentence = wrong_count(app, error);
    return fail(kBadInput, sentence.empty() ? error.what() : sentence);
  }
  if (!chosen) return fail(kBadInput, "a command is missing: see glissade help");
  check_numbers(app);
  return chosen();
}

/// Flushes standard output: a full disk shows only then.
int flush_output(int exit_code) {
  std::cout.flush();
  if (std::cout || exit_code != 0) return exit_code;
  return fail(kFailed, "standard output: not everything could be written");
}

}  // namespace

void declare_program(CLI::App& app, Command& chosen) {
  app.description(kDescription);
  app.name("glissade");
  app.footer(kFooter);
  app.set_version_flag("--version", "glissade " GLISSADE_VERSION, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.formatter(help_formatter());
  app.require_subcommand(0, 1);  // a missing command gets a message of our own below
  add_demo_command(app, chosen);
  add_example_command(app, chosen);
  add_info_command(app, chosen);
  add_collide_command(app, chosen);
  add_slide_command(app, chosen);
  add_study_command(app, chosen);
  add_grasp_command(app, chosen);
  add_run_command(app, chosen);
  add_record_command(app, chosen);
  add_replay_command(app, chosen);
  add_log_command(app, chosen);
  add_export_command(app, chosen);
  add_glove_command(app, chosen);
  add_bridge_command(app, chosen);
  add_calibrate_command(app, chosen);
  add_emulate_command(app, chosen);
  add_view_command(app, chosen);
  add_doctor_command(app, chosen);
  add_latency_command(app, chosen);
}

int run_program(int argc, char** argv) {
  complete_standard_streams();
  try {
    return flush_output(parse_and_run(argc, argv));
  } catch (const std::invalid_argument& error) {
    return fail(kBadInput, error.what());
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}

}  // namespace glissade::apps
