#pragma once

/// The examples in the help of the commands, run as a user pastes them.

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::test_support {

/// Every command of the program.
inline const std::vector<std::string> kCommands{"bridge",        "bridge dynamixel",
                                                "bridge haply",  "bridge opengloves",
                                                "calibrate",     "collide",
                                                "demo",          "doctor",
                                                "emulate",       "emulate dynamixel",
                                                "emulate haply", "emulate opengloves",
                                                "example",       "export",
                                                "glove",         "grasp",
                                                "info",          "latency",
                                                "log",           "log to-csv",
                                                "log to-mcap",   "record",
                                                "replay",        "run",
                                                "slide",         "study",
                                                "view"};

/// The lines of a command's help that are examples.
inline std::vector<std::string> examples_of(const std::string& command) {
  std::vector<std::string> arguments{"help"};
  std::istringstream words(command);
  for (std::string word; words >> word;)
    arguments.push_back(word);
  std::istringstream help(glissade(arguments).standard_output);
  std::vector<std::string> examples;
  bool has_begun = false;
  for (std::string line; std::getline(help, line);) {
    has_begun = has_begun || line.starts_with("Examples");
    if (has_begun && line.starts_with("  glissade ")) examples.push_back(line.substr(2));
  }
  return examples;
}

/// Whether an example talks to another process.
inline bool needs_network(const std::string& example) {
  for (const char* word : {"bridge", "glove", "run ", "record ", "latency", "udpm"}) {
    if (example.find(word) != std::string::npos) return true;
  }
  return false;
}

/// Runs an example in a shell, in this folder, for less time than it says, and ends what it left in the background.
inline ProgramResult run_example(const std::string& example, const TemporaryFolder& folder) {
  const std::string bin = std::filesystem::path(GLISSADE_PROGRAM).parent_path().string();
  // A hand of 'demo' that is faster misses its goal.
  const char* seconds = example.find("demo") == std::string::npos ? "--seconds 0.3" : "--seconds 1";
  const std::string brief = std::regex_replace(example, std::regex("--seconds [0-9.]+"), seconds);
  const std::string command = "cd '" + folder.path("") + "' && PATH='" + bin + "':\"$PATH\" && { " + brief +
                              "; }; status=$?; kill $(jobs -p) 2> /dev/null; wait; exit $status";
  return Process({"/bin/bash", "-c", command}).wait();  // sh knows no jobs in $()
}

}  // namespace glissade::test_support
