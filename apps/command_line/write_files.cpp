/// Writes the manual pages and the completion of shells into a folder: write_command_line_files FOLDER. Runs in the
/// build.

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include <glissade/apps/command_line/completion.h>
#include <glissade/apps/command_line/man_page.h>
#include <glissade/apps/program.h>

namespace {

using namespace glissade;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

void write_man_pages(const CLI::App& command, const std::filesystem::path& folder, const std::string& name) {
  std::string file = name + ".1";
  std::replace(file.begin(), file.end(), ' ', '-');
  write(folder / file, apps::man_page(command, name, GLISSADE_VERSION));
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
    write_man_pages(*subcommand, folder, name + ' ' + subcommand->get_name());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::invalid_argument("Usage: write_command_line_files FOLDER");
    CLI::App app;
    apps::Command chosen;
    apps::declare_program(app, chosen);
    const std::filesystem::path folder = argv[1];
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "man1");
    write_man_pages(app, folder / "man1", "glissade");
    write(folder / "glissade.bash", apps::bash_completion(app));
    write(folder / "_glissade", apps::zsh_completion(app));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
