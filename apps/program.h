#pragma once

/// The program `glissade` as a function, so that `main.cpp` compiles in no time.

namespace glissade::apps {

/// Declares the commands, parses, runs the chosen command, and turns an error into one line on standard error. Returns
/// the exit code.
int run_program(int argc, char** argv);

}  // namespace glissade::apps
