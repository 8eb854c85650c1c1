#pragma once

/// What the user asked of the program as a whole: help on a command, or something that it does not know.

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace glissade::apps {

/// The arguments of the program with `help COMMAND` turned into `COMMAND --help`. Throws std::invalid_argument for an
/// unknown command.
std::vector<std::string> with_help_as_option(const CLI::App& app, std::vector<std::string> arguments);

/// The sentence for the first argument that the last parsing of `app` did not expect: what it is not, and what was
/// meant. Empty if it expected all.
std::string unexpected_arguments(const CLI::App& app);

/// The sentence for an option that was given too few or too many values, as `error` tells. Empty if it is another
/// error.
std::string wrong_count(const CLI::App& app, const CLI::ParseError& error);

/// Throws std::invalid_argument, naming the option, when a command was given "nan", "inf" or another text that is not a
/// finite number with a decimal point for an option that takes a number. To be called after parsing.
void check_numbers(const CLI::App& app);

/// Help whose usage line has the arguments before the options. So one who types as it says gives no argument to an
/// option that takes several values.
std::shared_ptr<CLI::Formatter> help_formatter();

/// A check of an option: its value is one of these.
CLI::Validator one_of(const std::vector<std::string>& values);
/// A check of an option that takes a number: it is not negative.
CLI::Validator not_negative();
/// The same: it is above 0.
CLI::Validator positive();

}  // namespace glissade::apps
