#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/example_files.h>
#include <glissade/apps/files/file_checks.h>
#include <glissade/apps/files/text_file.h>
#include <glissade/apps/text.h>

namespace glissade::apps {

namespace {

constexpr const char* kExampleDescription = "Write scenes, trajectories and meshes to try the other commands with";

constexpr const char* kExampleFooter =
    "Writes some small files, with which the examples in the help of every command work. A file that is there already\n"
    "is kept, if it has the same content; if it has another, nothing is written. For ten things of a household there\n"
    "are a scene and a hand that grasps and lifts the thing, such as grasp_mug.yaml and grasp_mug_hand.csv.\n"
    "\n"
    "Examples:\n"
    "  glissade example\n"
    "  glissade example first_steps && cd first_steps && glissade info motor.obj";

bool is_there(const std::string& path) {
  return std::filesystem::exists(path);
}

void write_example(const std::string& path, const std::string& text) {
  std::ofstream out = open_output(path);
  out << text << std::flush;
  if (!out) throw std::runtime_error(path + ": not everything could be written");
}

int write_examples(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument(folder + ": cannot make this folder: " + error.message());
  const std::vector<ExampleFile> files = example_files();
  const auto path_of = [&](const ExampleFile& file) { return (std::filesystem::path(folder) / file.name).string(); };
  for (const ExampleFile& file : files) {
    check_output(path_of(file));
    if (is_there(path_of(file)) && read_text_file(path_of(file)) != file.text) {
      throw std::invalid_argument(path_of(file) + ": is there already, with another content; name another folder");
    }
  }
  for (const ExampleFile& file : files) {
    if (!is_there(path_of(file))) write_example(path_of(file), file.text);
    std::cout << path_of(file) << '\n';
  }
  return 0;
}

}  // namespace

void add_example_command(CLI::App& app, Command& chosen) {
  const auto folder = std::make_shared<std::string>(".");
  CLI::App* command = app.add_subcommand("example", kExampleDescription);
  command->footer(kExampleFooter);
  command->add_option("FOLDER", *folder, "Folder for the files; made if there is none")->capture_default_str();
  command->callback([folder, &chosen] { chosen = [folder] { return write_examples(*folder); }; });
}

}  // namespace glissade::apps
