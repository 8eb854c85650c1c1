#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/option_rules.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

void check_numbers(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      // A check adds its name to that of the type.
      if (!option->get_type_name().starts_with("FLOAT")) continue;
      for (const std::string& text : option->results()) {
        if (parse_number(text)) continue;
        throw std::invalid_argument(option->get_name() + ": must be a finite number, not " + in_quotes(text));
      }
    }
    check_numbers(*command);
  }
}

}  // namespace glissade::apps
