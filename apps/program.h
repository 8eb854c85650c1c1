#pragma once

/// The program `glissade` as a function, so that `main.cpp` compiles in no time.

#include <glissade/apps/commands/command.h>

namespace glissade::apps {

/// Declares all commands with their options and help. Parsing sets `chosen`.
void declare_program(CLI::App& app, Command& chosen);

/// Parses the command line, runs the chosen command, and turns an error into one line on standard error. Returns
/// the exit code.
int run_program(int argc, char** argv);

}  // namespace glissade::apps
