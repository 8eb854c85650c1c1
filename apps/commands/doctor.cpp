#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/run/machine_check.h>

namespace glissade::apps {

namespace {

constexpr const char* kDoctorDescription = "Check this machine for a haptic loop, and suggest changes";

constexpr const char* kDoctorFooter =
    "Checks rights, scheduler, timers, power saving, kernel and network, and changes nothing. Each finding states\n"
    "what it means for haptics and, if possible, a command that improves it. The exit code is always 0.\n"
    "\n"
    "Examples:\n"
    "  glissade doctor\n"
    "  glissade doctor --json";

void print(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    std::cout << finding.name << ": " << finding.value << " (" << name_of(finding.verdict) << ")\n"
              << "    " << finding.meaning << '\n';
    if (!finding.mend.empty()) std::cout << "    " << finding.mend << '\n';
  }
  const auto bad = std::count_if(findings.begin(), findings.end(),
                                 [](const Finding& finding) { return finding.verdict == Verdict::kBad; });
  const auto better = std::count_if(findings.begin(), findings.end(),
                                    [](const Finding& finding) { return finding.verdict == Verdict::kCanBeBetter; });
  std::cout << findings.size() << " findings: " << bad << " bad, " << better << " can be better\n";
}

void print_json(const std::vector<Finding>& findings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    json.push_back({{"name", finding.name},
                    {"verdict", name_of(finding.verdict)},
                    {"value", finding.value},
                    {"meaning", finding.meaning},
                    {"mend", finding.mend}});
  }
  std::cout << json.dump(2) << '\n';
}

}  // namespace

void add_doctor_command(CLI::App& app, Command& chosen) {
  const auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("doctor", kDoctorDescription);
  command->footer(kDoctorFooter);
  command->add_flag("--json", *json, "Print the findings as JSON");
  command->callback([json, &chosen] {
    chosen = [json] {
      const std::vector<Finding> findings = check_machine();
      *json ? print_json(findings) : print(findings);
      return 0;
    };
  });
}

}  // namespace glissade::apps
