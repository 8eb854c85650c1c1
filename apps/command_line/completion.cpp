#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/command_line/completion.h>

namespace glissade::apps {
namespace {

struct Word {
  std::string text;
  std::string description;
};

/// The values of an option that takes one of several, as `one_of` tells them in the name of its type.
std::string values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  if (begin == std::string::npos) return "";
  return CLI::detail::find_and_replace(type.substr(begin + 1, type.find('}') - begin - 1), ",", " ");
}

std::vector<const CLI::App*> subcommands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<Word> command_words(const CLI::App& command) {
  std::vector<Word> words;
  for (const CLI::App* subcommand : subcommands_of(command))
    words.push_back({subcommand->get_name(), subcommand->get_description()});
  if (command.get_parent() == nullptr) words.push_back({"help", "Print the help of a command"});
  return words;
}

std::vector<Word> option_words(const CLI::App& command) {
  std::vector<Word> words;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames())
      words.push_back({"--" + name, option->get_description()});
  }
  return words;
}

/// Calls `visit` with each command and its words, such as "glissade bridge haply".
void for_each_command(const CLI::App& command, const std::string& name,
                      const std::function<void(const CLI::App&, const std::string&)>& visit) {
  visit(command, name);
  for (const CLI::App* subcommand : subcommands_of(command))
    for_each_command(*subcommand, name + ' ' + subcommand->get_name(), visit);
}

std::string texts_of(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words)
    text += (text.empty() ? "" : " ") + word.text;
  return text;
}

/// Words with descriptions as elements of an array, as `_describe` of zsh takes them.
std::string described(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words) {
    std::string description = CLI::detail::find_and_replace(word.description, "'", "'\\''");
    description = description.substr(0, description.find('\n'));
    text += " '" + word.text + ':' + description + '\'';
  }
  return text;
}

/// The cases that lead from a command and the next word to its subcommand.
std::string steps(const CLI::App& app) {
  std::string text;
  for_each_command(app, "glissade", [&text](const CLI::App& command, const std::string& name) {
    if (command.get_parent() != nullptr) text += "      '" + name + "') command='" + name + "' ;;\n";
  });
  return text;
}

/// The cases that give the values after an option.
std::string value_cases(const CLI::App& app) {
  std::string text;
  for_each_command(app, "glissade", [&text](const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string values = values_of(*option);
      if (!values.empty()) text += "    '" + name + ' ' + option->get_name() + "') values='" + values + "' ;;\n";
    }
  });
  return text;
}

std::string word_cases(const CLI::App& app, const std::function<std::string(const std::vector<Word>&)>& list,
                       const std::pair<std::string, std::string>& brackets) {
  std::string text;
  for_each_command(app, "glissade", [&](const CLI::App& command, const std::string& name) {
    text += "    '" + name + "')\n      commands=" + brackets.first + list(command_words(command)) + brackets.second +
            "\n      options=" + brackets.first + list(option_words(command)) + brackets.second + " ;;\n";
  });
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  return "# Completion of glissade in bash.\n"
         "_glissade() {\n"
         "  local command=glissade commands options values index current=${COMP_WORDS[COMP_CWORD]}\n"
         "  for ((index = 1; index < COMP_CWORD; index++)); do\n"
         "    case \"$command ${COMP_WORDS[index]}\" in\n" +
         steps(app) +
         "    esac\n"
         "  done\n"
         "  case \"$command ${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
         value_cases(app) +
         "  esac\n"
         "  case $command in\n" +
         word_cases(app, texts_of, {"'", "'"}) +
         "  esac\n"
         "  [[ $current != -* ]] || commands=$options\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"${values:-$commands}\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _glissade glissade\n";
}

std::string zsh_completion(const CLI::App& app) {
  return "#compdef glissade\n"
         "local command=glissade values word\n"
         "local -a commands options\n"
         "for word in ${words[2,CURRENT-1]}; do\n"
         "    case \"$command $word\" in\n" +
         steps(app) +
         "    esac\n"
         "done\n"
         "case \"$command ${words[CURRENT-1]}\" in\n" +
         value_cases(app) +
         "esac\n"
         "case $command in\n" +
         word_cases(app, described, {"(", ")"}) +
         "esac\n"
         "if [[ -n $values ]]; then\n"
         "  compadd -- ${=values}\n"
         "elif [[ $PREFIX == -* ]]; then\n"
         "  _describe -o option options\n"
         "elif (( $#commands )); then\n"
         "  _describe command commands\n"
         "else\n"
         "  _files\n"
         "fi\n";
}

}  // namespace glissade::apps
