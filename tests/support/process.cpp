#include "process.h"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace glissade::test_support {

namespace {

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace

Process::Process(const std::vector<std::string>& arguments) {
  const std::string output = folder_.path("output");
  const std::string error = folder_.path("error");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, error.c_str(), O_WRONLY | O_CREAT, 0600);

  std::vector<std::string> copies = arguments;
  std::vector<char*> argv;
  argv.reserve(copies.size() + 1);
  for (std::string& argument : copies)
    argv.push_back(argument.data());
  argv.push_back(nullptr);
  const int failure = posix_spawnp(&id_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::system_error(failure, std::generic_category(), arguments[0]);
  is_running_ = true;
}

Process::~Process() {
  if (!is_running_) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

void Process::signal(int number) const {
  if (kill(id_, number) != 0) throw std::system_error(errno, std::generic_category(), "kill");
}

void Process::signal_thread(const std::string& name, int number) const {
  const std::string tasks = "/proc/" + std::to_string(id_) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks)) {
    if (content_of(task.path() / "comm") != name + "\n") continue;
    if (tgkill(id_, std::stoi(task.path().filename()), number) == 0) return;
    throw std::system_error(errno, std::generic_category(), "tgkill");
  }
  throw std::runtime_error("the program has no thread '" + name + "'");
}

std::string Process::standard_error() const {
  return content_of(folder_.path("error"));
}

ProgramResult Process::wait() {
  int status = 0;
  while (waitpid(id_, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  is_running_ = false;
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return {exit_code, content_of(folder_.path("output")), standard_error()};
}

}  // namespace glissade::test_support
