#pragma once

/// Rules for the options of all commands.

namespace CLI {
class App;
}

namespace glissade::apps {

/// Throws std::invalid_argument, naming the option, when a command was given "nan", "inf" or another text that is not a
/// finite number with a decimal point for an option that takes a number. To be called after parsing.
void check_numbers(const CLI::App& app);

}  // namespace glissade::apps
