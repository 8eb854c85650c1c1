#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <system_error>
#include <vector>

#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/apps/study/worker_process.h>

extern char** environ;  // of posix_spawn

namespace glissade::apps {
namespace {

constexpr std::chrono::milliseconds kStopPeriod{100};

/// Starts this program with standard input and output on `socket`.
pid_t spawn(const std::string& study_file, const std::string& pages, int socket) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
  std::vector<std::string> texts{"glissade", "study", WorkerProcess::kOption};
  if (!pages.empty()) texts.push_back(std::string(WorkerProcess::kPagesOption) + "=" + pages);
  texts.insert(texts.end(), {"--", study_file});  // the name of the file may begin with a hyphen
  std::vector<char*> arguments;
  for (std::string& text : texts)
    arguments.push_back(text.data());
  arguments.push_back(nullptr);
  pid_t id = -1;
  const int error = posix_spawn(&id, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::system_error(error, std::generic_category(), "No worker process");
  return id;
}

}  // namespace

WorkerProcess::WorkerProcess(const std::string& study_file, const std::string& pages) {
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0)
    throw std::system_error(errno, std::generic_category(), "No connection to a worker process");
  socket_ = sockets[0];
  try {
    id_ = spawn(study_file, pages, sockets[1]);
  } catch (...) {
    close(sockets[0]);
    close(sockets[1]);
    throw;
  }
  close(sockets[1]);
}

WorkerProcess::~WorkerProcess() {
  close(socket_);
  if (id_ < 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

WorkerProcess::Answer WorkerProcess::run(std::int64_t slide, std::chrono::nanoseconds longest,
                                         const std::function<bool()>& should_stop) {
  if (!is_ready_) {
    Answer ready = receive(Clock::time_point::max(), should_stop);
    if (ready.outcome == Outcome::kDied) ready.outcome = Outcome::kNotStarted;
    if (ready.outcome != Outcome::kDone) return ready;
    is_ready_ = true;
  }
  const std::string line = std::to_string(slide) + '\n';
  send(socket_, line.data(), line.size(), MSG_NOSIGNAL);  // if the process is no more, the reading tells
  return receive(Clock::now() + longest, should_stop);
}

WorkerProcess::Answer WorkerProcess::receive(Clock::time_point end, const std::function<bool()>& should_stop) {
  while (received_.find('\n') == std::string::npos) {
    if (should_stop()) return {Outcome::kStopped};
    if (Clock::now() >= end) return {Outcome::kTooLong};
    pollfd readable{.fd = socket_, .events = POLLIN, .revents = 0};
    if (poll(&readable, 1, static_cast<int>(kStopPeriod.count())) <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
    if (count <= 0) return {Outcome::kDied, "", reason_of_death()};
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  const std::size_t length = received_.find('\n');
  std::string json = received_.substr(0, length);
  received_.erase(0, length + 1);
  return {Outcome::kDone, std::move(json)};
}

std::string WorkerProcess::reason_of_death() {
  int status = 0;
  waitpid(id_, &status, 0);
  id_ = -1;
  if (WIFSIGNALED(status)) return std::string("ended by the signal '") + strsignal(WTERMSIG(status)) + "'";
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

void serve_slides(const std::function<std::string(std::int64_t)>& row) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C is for the first process
  std::cout << "ready" << std::endl;
  std::int64_t slide = 0;
  while (std::cin >> slide)
    std::cout << row(slide) << std::endl;
}

}  // namespace glissade::apps
