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

/// The cases that give the values after an option: the next word, or each word up to the next option.
std::string value_cases(const CLI::App& app) {
  std::string text;
  for_each_command(app, "glissade", [&text](const CLI::App& command, const std::string& name) {
    for (const CLI::Option* option : command.get_options()) {
      const std::string values = values_of(*option);
      if (values.empty()) continue;
      const std::string condition = option->get_items_expected_max() > 1 ? "" : "((after)) || ";
      text += "    '" + name + ' ' + option->get_name() + "') " + condition + "values='" + values + "' ;;\n";
    }
  });
  return text;
}

std::string word_cases(const CLI::App& app, const std::function<std::string(const std::vector<Word>&)>& list,
                       const std::pair<std::string, std::string>& brackets) {
  std::string text;
  for_each_command(app, "glissade", [&](const CLI::App& command, const std::string& name) {
    text += "    '" + name + "')\n      subcommands=" + brackets.first + list(command_words(command)) +
            brackets.second + "\n      option_names=" + brackets.first + list(option_words(command)) + brackets.second +
            " ;;\n";
  });
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  return "# Completion of glissade in bash.\n"
         "_glissade() {\n"
         "  local command=glissade option after=0 values subcommands option_names\n"
         "  local index current=${COMP_WORDS[COMP_CWORD]}\n"
         "  for ((index = 1; index < COMP_CWORD; index++)); do\n"
         "    ((++after))\n"
         "    [[ ${COMP_WORDS[index]} != -* ]] || option=${COMP_WORDS[index]} after=0\n"
         "    case \"$command ${COMP_WORDS[index]}\" in\n" +
         steps(app) +
         "    esac\n"
         "  done\n"
         "  case \"$command $option\" in\n" +
         value_cases(app) +
         "  esac\n"
         "  case $command in\n" +
         word_cases(app, texts_of, {"'", "'"}) +
         "  esac\n"
         "  [[ $current != -* ]] || values=$option_names\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"${values:-$subcommands}\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _glissade glissade\n";
}

std::string zsh_completion(const CLI::App& app) {
  return "#compdef glissade\n"
         "local command=glissade option after=0 values word\n"
         "local -a subcommands option_names\n"
         "for word in ${words[2,CURRENT-1]}; do\n"
         "    ((++after))\n"
         "    [[ $word != -* ]] || option=$word after=0\n"
         "    case \"$command $word\" in\n" +
         steps(app) +
         "    esac\n"
         "done\n"
         "case \"$command $option\" in\n" +
         value_cases(app) +
         "esac\n"
         "case $command in\n" +
         word_cases(app, described, {"(", ")"}) +
         "esac\n"
         "if [[ $PREFIX == -* ]]; then\n"
         "  _describe -o option option_names\n"
         "elif [[ -n $values ]]; then\n"
         "  compadd -- ${=values}\n"
         "elif (( $#subcommands )); then\n"
         "  _describe command subcommands\n"
         "else\n"
         "  _files\n"
         "fi\n";
}

}  // namespace glissade::apps
