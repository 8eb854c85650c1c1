#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <glissade/apps/latency/helper_process.h>

namespace glissade::apps {

namespace {

constexpr std::size_t kLongestMessage = 255;

[[noreturn]] void refuse_process() {
  throw std::system_error(errno, std::generic_category(), "No second process");
}

/// What went wrong with the work; empty if nothing did.
std::string outcome_of(const HelperProcess::Work& work, char number, const std::atomic<bool>& should_end) noexcept {
  try {
    work(number, should_end);
    return "";
  } catch (const std::exception& error) {
    return std::string(error.what()).substr(0, kLongestMessage);
  } catch (...) {
    return "an exception of unknown type";
  }
}

}  // namespace

HelperProcess::HelperProcess(const Work& work) {
  void* memory = mmap(nullptr, sizeof(std::atomic<bool>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) refuse_process();
  should_end_ = new (memory) std::atomic<bool>(false);
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) != 0) refuse_process();
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ < 0) refuse_process();
  if (id_ == 0) {
    close(sockets[0]);
    // The first process may have ended before the system knew that this one is to end with it.
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) _exit(1);
    serve(work, sockets[1]);
  }
  close(sockets[1]);
  socket_ = sockets[0];
}

HelperProcess::~HelperProcess() {
  should_end_->store(true);
  close(socket_);
  waitpid(id_, nullptr, 0);
  munmap(should_end_, sizeof(*should_end_));
}

/// One packet is a number of work, the answer is its outcome in one packet. The end of the connection ends the process.
void HelperProcess::serve(const Work& work, int socket) noexcept {
  char number = 0;
  while (recv(socket, &number, 1, 0) == 1) {
    const std::string outcome = outcome_of(work, number, *should_end_) + '\n';  // no packet is empty
    if (send(socket, outcome.data(), outcome.size(), MSG_NOSIGNAL) < 0) break;
  }
  _exit(0);  // without the exit handlers of the first process, whose output would be written twice
}

void HelperProcess::begin(char number) {
  should_end_->store(false);
  send(socket_, &number, 1, MSG_NOSIGNAL);  // if the process is no more, `end` will tell
}

void HelperProcess::end() {
  should_end_->store(true);
  std::array<char, kLongestMessage + 1> outcome{};
  const ssize_t size = recv(socket_, outcome.data(), outcome.size(), 0);
  if (size <= 0) throw std::runtime_error("the second process has ended");
  if (size > 1)
    throw std::runtime_error("the second process: " + std::string(outcome.data(), static_cast<std::size_t>(size - 1)));
}

}  // namespace glissade::apps
