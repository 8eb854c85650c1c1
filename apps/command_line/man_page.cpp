#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/command_line/man_page.h>

namespace glissade::apps {
namespace {

/// Text whose characters mean themselves. A hyphen becomes the minus that one can search and copy.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    // A line may break after the commas of a list of names.
    if (result.ends_with(',') && character != ' ' && character != '\n') result += "\\:";
    if (character == '\\') {
      result += "\\e";
    } else if (character == '-') {
      result += "\\-";
    } else {
      if ((character == '.' || character == '\'') && (result.empty() || result.back() == '\n')) result += "\\&";
      result += character;
    }
  }
  return result;
}

std::string joined_by_hyphens(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string in_capitals(std::string text) {
  for (char& letter : text)
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return text;
}

std::string entry(const std::string& title, const std::string& text) {
  return ".TP\n\\fB" + escaped(title) + "\\fR\n" + escaped(text) + '\n';
}

std::string option_entry(const CLI::Option& option) {
  const CLI::Formatter formatter;
  const bool is_positional = option.get_positional();
  return entry(formatter.make_option_name(&option, is_positional) + formatter.make_option_opts(&option),
               option.get_description());
}

void write_options(std::ostream& out, const CLI::App& command, const std::string& title, bool positional) {
  const auto options = command.get_options([positional](const CLI::Option* option) {
    return option->get_positional() == positional && !option->get_group().empty();
  });
  if (options.empty()) return;
  out << ".SH " << title << '\n';
  for (const CLI::Option* option : options)
    out << option_entry(*option);
}

/// Lines that begin with spaces are tables or examples: they stay lines. Other lines may be filled.
void write_footer(std::ostream& out, const std::string& footer) {
  std::istringstream lines(footer);
  std::string line;
  bool was_table = false;
  while (std::getline(lines, line)) {
    const bool is_table = line.starts_with(' ');
    if (is_table != was_table) out << (is_table ? ".nf\n" : ".fi\n");
    was_table = is_table;
    if (line.empty()) {
      out << ".PP\n";
    } else {
      out << escaped(line) << '\n';
    }
  }
  if (was_table) out << ".fi\n";
}

}  // namespace

std::string man_page(const CLI::App& command, const std::string& name, const std::string& version) {
  const std::string title = joined_by_hyphens(name);
  const std::string description = command.get_description();
  const std::string first_line = description.substr(0, description.find('\n'));
  std::ostringstream out;
  out << ".TH " << in_capitals(escaped(title)) << " 1 \"\" \"glissade " << version << "\" \"Glissade\"\n"
      << ".nh\n.ad l\n"  // words such as column names neither break nor fill a line
      << ".SH NAME\n"
      << escaped(title) << " \\- " << escaped(first_line) << '\n';
  const std::string usage = command.get_formatter()->make_help(&command, name, CLI::AppFormatMode::Normal);
  const std::size_t begin = usage.find("Usage: ") + std::string("Usage: ").size();
  out << ".SH SYNOPSIS\n" << escaped(usage.substr(begin, usage.find('\n', begin) - begin)) << '\n';
  write_options(out, command, "ARGUMENTS", true);
  write_options(out, command, "OPTIONS", false);
  const auto subcommands = command.get_subcommands([](const CLI::App*) { return true; });
  if (!subcommands.empty()) out << ".SH COMMANDS\n";
  for (const CLI::App* subcommand : subcommands)
    out << entry(joined_by_hyphens(name + ' ' + subcommand->get_name()) + "(1)", subcommand->get_description());
  out << ".SH DESCRIPTION\n" << escaped(description) << "\n.PP\n";
  write_footer(out, command.get_footer());
  if (command.get_parent() != nullptr) {
    const std::string parent = name.substr(0, name.rfind(' '));
    out << ".SH SEE ALSO\n.BR " << escaped(joined_by_hyphens(parent)) << " (1)\n";
  }
  return out.str();
}

}  // namespace glissade::apps
