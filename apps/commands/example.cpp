#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include <glissade/apps/commands/command.h>
#include <glissade/apps/commands/example_files.h>
#include <glissade/files/text_file.h>

namespace glissade::apps {

namespace {

constexpr const char* kExampleDescription = "Write scenes, trajectories and meshes for trying the other commands";

constexpr const char* kExampleFooter =
    "Writes small files for the examples in the help of every command. Existing files with the same content are kept.\n"
    "If an existing file has other content, the command writes nothing. For each of ten household objects there are a\n"
    "scene and a hand that grasps and lifts the object, such as grasp_mug.yaml and grasp_mug_hand.csv.\n"
    "\n"
    "Examples:\n"
    "  glissade example\n"
    "  glissade example first_steps && cd first_steps && glissade info motor.obj";

int write_examples(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument(folder + ": cannot make this folder: " + error.message());
  std::vector<TextFile> files = example_files();
  for (TextFile& file : files)
    file.path = (std::filesystem::path(folder) / file.path).string();
  write_new_files(files);
  for (const TextFile& file : files)
    std::cout << file.path << '\n';
  return 0;
}

}  // namespace

void add_example_command(CLI::App& app, Command& chosen) {
  const auto folder = std::make_shared<std::string>(".");
  CLI::App* command = app.add_subcommand("example", kExampleDescription);
  command->footer(kExampleFooter);
  command->add_option("FOLDER", *folder, "Folder for the files; created if it does not exist")->capture_default_str();
  command->callback([folder, &chosen] { chosen = [folder] { return write_examples(*folder); }; });
}

}  // namespace glissade::apps
