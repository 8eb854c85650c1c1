#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/latency/latency_output.h>
#include <glissade/apps/latency/latency_run.h>
#include <glissade/apps/progress.h>
#include <glissade/apps/report/html_report.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

constexpr const char* kLatencyDescription = "Measure the time from a sample of the glove to its force, stage by stage";

constexpr const char* kLatencyFooter =
    "A simulated glove presses a box on a plate. The glove measures 997 times a second and the haptic loop ticks 1000\n"
    "times, so the samples arrive at every phase of a tick. The stages of a sample:\n"
    "\n"
    "  transport          from the measurement until the haptic loop may read the sample\n"
    "  wait for the tick  until the next tick starts and reads it: half a tick, 500 us, on average\n"
    "  computation        until the tick gives its command to the device: the forces of all contacts, the envelope\n"
    "  way back           until the command reaches the driver of the glove, through the send thread and the link\n"
    "  sample to force    the sum of these stages\n"
    "\n"
    "The glove is a driver in the same process, a thread behind memq://, or a second process behind udpm://, at a\n"
    "separate address whose packets stay on this machine. The three variants take turns, without a load ('idle') and\n"
    "with a load on the machine ('loaded'). The bare loop is an empty loop of the same period and priority beside the\n"
    "haptic loop. The system alone causes its lateness. The UDP round trip sends two datagrams of the same sizes as\n"
    "the glove's messages between two processes with blocking sockets. The targets are goals of the library. The exit\n"
    "code is 0 for any result.\n"
    "For the keys of --json, see docs/file_formats.md in the sources.\n"
    "\n"
    "Examples:\n"
    "  glissade latency --seconds 8\n"
    "  glissade latency --seconds 4 --json\n"
    "  glissade latency --seconds 4 --report latency";

struct LatencyOptions {
  double seconds = 32.0;
  bool json = false;
  std::string report;
};

int run(const LatencyOptions& options) {
  if (!(options.seconds >= 0.1 && options.seconds <= 3600.0)) {
    throw std::invalid_argument("--seconds: must lie between 0.1 and 3600, not " + format_number(options.seconds));
  }
  if (!options.report.empty()) prepare_report_folder(options.report);
  const std::chrono::milliseconds duration(std::llround(1000.0 * options.seconds));
  const LatencyFigures figures = [&] {
    ProgressBar progress("latency", duration.count());
    return measure_latency(duration, [&](std::chrono::milliseconds measured) { progress.update(measured.count()); });
  }();
  std::cout << (options.json ? to_json(figures).dump(2) + '\n' : to_text(figures));
  if (!options.report.empty()) {
    const std::string page = write_latency_report(figures, options.report);
    if (!options.json) std::cout << "report: " << page << '\n';
  }
  return 0;
}

}  // namespace

void add_latency_command(CLI::App& app, Command& chosen) {
  const auto options = std::make_shared<LatencyOptions>();
  CLI::App* command = app.add_subcommand("latency", kLatencyDescription);
  command->footer(kLatencyFooter);
  command->add_option("--seconds", options->seconds, "Duration of all measurements together, in seconds")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command->add_option(
      "--report", options->report,
      "Folder for a page, index.html, with the figures, a histogram of each stage, and up to a second of "
      "the run in three dimensions");
  add_quiet_option(*command);
  command->callback([options, &chosen] { chosen = [options] { return run(*options); }; });
}

}  // namespace glissade::apps
