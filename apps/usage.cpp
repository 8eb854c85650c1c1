#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glissade/apps/text.h>
#include <glissade/apps/usage.h>

namespace glissade::apps {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

std::string unknown_command(const std::string& name, const std::vector<std::string>& known) {
  return in_quotes(name) + " is not a command" + did_you_mean(name, known) + "; 'glissade help' lists them";
}

/// The command that was given, without its arguments.
const CLI::App& chosen_command(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty())
    command = command->get_subcommands().front();
  return *command;
}

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_usage(const CLI::App* app, std::string name) const override {
    const auto arguments = app->get_options([](const CLI::Option* option) { return option->get_positional(); });
    if (arguments.empty()) return CLI::Formatter::make_usage(app, std::move(name));
    std::string usage = "Usage: " + name;
    for (const CLI::Option* argument : arguments)
      usage += " " + make_option_usage(argument);
    return usage + " [OPTIONS]\n";
  }
};

}  // namespace

std::vector<std::string> with_help_as_option(const CLI::App& app, std::vector<std::string> arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  const CLI::App* command = &app;
  if (!arguments.empty() && arguments.front().starts_with("-")) return {"--help"};
  for (const std::string& name : arguments) {
    const std::vector<std::string> known = command_names(*command);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw std::invalid_argument(unknown_command(name, known));
    }
    command = command->get_subcommand(name);
  }
  arguments.emplace_back("--help");
  return arguments;
}

std::string unexpected_arguments(const CLI::App& app) {
  const CLI::App& command = chosen_command(app);
  const std::vector<std::string> left = app.remaining(true);
  if (left.empty()) return "";
  const std::string& first = left.front();
  const std::vector<std::string> commands = command_names(command);
  if (first.starts_with('-')) {
    const std::string name = first.substr(0, first.find('='));
    return name + " is not an option of '" + command.get_name() + "'" + did_you_mean(name, option_names(command));
  }
  if (commands.empty()) return in_quotes(first) + " is one argument too many for '" + command.get_name() + "'";
  return unknown_command(first, commands);
}

std::string wrong_count(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return "";
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));  // nothing else tells it; `Cli.WrongUsageIsRefused` looks
  const CLI::Option* const option = chosen_command(app).get_option_no_throw(name);
  if (option == nullptr) return "";
  const auto given = static_cast<int>(option->results().size());
  const int most = option->get_items_expected_max();
  if (given <= most) return name + ": a value is missing";
  return name + ": takes " + (most == 1 ? "one value" : "at most " + std::to_string(most) + " values") + ", not " +
         std::to_string(given);
}

void check_numbers(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      // A check adds its name to that of the type.
      if (!option->get_type_name().starts_with("FLOAT")) continue;
      for (const std::string& text : option->results()) {
        if (parse_number(text.starts_with('+') ? text.substr(1) : text)) continue;
        throw std::invalid_argument(option->get_name() + ": must be a finite number, not " + in_quotes(text));
      }
    }
    check_numbers(*command);
  }
}

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

CLI::Validator one_of(const std::vector<std::string>& values) {
  return {[values](const std::string& text) {
            if (std::find(values.begin(), values.end(), text) != values.end()) return std::string();
            return in_quotes(text) + " is unknown" + did_you_mean(text, values) + "; known are " +
                   CLI::detail::join(values, ", ");
          },
          "{" + CLI::detail::join(values, ",") + "}"};
}

CLI::Validator not_negative() {
  return {[](const std::string& text) {
            const std::optional<double> number = parse_number(text);
            // What is no number is told after parsing, by `check_numbers`.
            return !number || *number >= 0.0 ? std::string() : "must be at least 0, not " + text;
          },
          "NONNEGATIVE"};
}

CLI::Validator positive() {
  return {[](const std::string& text) {
            const std::optional<double> number = parse_number(text);
            return !number || *number > 0.0 ? std::string() : "must be above 0, not " + text;
          },
          "POSITIVE"};
}

}  // namespace glissade::apps
