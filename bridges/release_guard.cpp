#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <glissade/bridges/release_guard.h>
#include <glissade/bridges/wire.h>
#include <glissade/realtime/periodic_thread.h>

namespace glissade::bridges {
namespace {

// The second process may be the fork of a process with several threads: it calls only what is safe after that.

constexpr int kPatience_ms = 100;
constexpr int kToEnd_ms = 250;
constexpr std::chrono::milliseconds kRenewal{20};  // often enough, however often the first process calls
constexpr std::size_t kLongestRelease = 100;

enum Order : char { kArm = 'a', kRenew = 'r', kDisarm = 'd' };

/// The device that the second process guards.
struct Guarded {
  int descriptor = -1;
  std::array<char, kLongestRelease> release{};
  std::size_t size = 0;
};

void forget(Guarded& guarded) noexcept {
  if (guarded.descriptor >= 0) close(guarded.descriptor);
  guarded.descriptor = -1;
}

/// Commands that still wait in the system would come first: they are dropped.
void release(const Guarded& guarded) noexcept {
  if (guarded.descriptor < 0) return;
  if (isatty(guarded.descriptor) != 0) tcflush(guarded.descriptor, TCOFLUSH);
  constexpr int kTimes = 3;
  for (int i = 0; i < kTimes; ++i) {
    const ssize_t written = write(guarded.descriptor, guarded.release.data(), guarded.size);
    constexpr int kPause_ms = 10;
    if (i + 1 < kTimes || written < 0) poll(nullptr, 0, kPause_ms);
  }
}

/// The number of bytes, 0 at the end of the first process.
ssize_t receive(int socket, std::array<char, kLongestRelease + 1>& packet, int& descriptor) noexcept {
  iovec bytes{packet.data(), packet.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room{};
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  message.msg_control = room.data();
  message.msg_controllen = room.size();
  ssize_t size = -1;
  do
    size = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (size < 0 && errno == EINTR);
  const cmsghdr* const header = CMSG_FIRSTHDR(&message);
  descriptor = -1;
  if (header && header->cmsg_type == SCM_RIGHTS) std::memcpy(&descriptor, CMSG_DATA(header), sizeof(int));
  return size;
}

void obey(Guarded& guarded, const std::array<char, kLongestRelease + 1>& packet, std::size_t size,
          int descriptor) noexcept {
  if (packet[0] == kRenew) return;
  forget(guarded);
  if (packet[0] != kArm) return;
  guarded.descriptor = descriptor;
  guarded.size = size - 1;
  std::memcpy(guarded.release.data(), &packet[1], guarded.size);
}

/// The life of the second process.
[[noreturn]] void guard(int socket) noexcept {
  Guarded guarded;
  bool is_released = true;
  for (;;) {
    pollfd waiting{socket, POLLIN, 0};
    const int ready = poll(&waiting, 1, is_released ? -1 : kPatience_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      release(guarded);
      is_released = true;
      continue;
    }
    std::array<char, kLongestRelease + 1> packet{};
    int descriptor = -1;
    const ssize_t size = receive(socket, packet, descriptor);
    if (size <= 0) break;
    obey(guarded, packet, static_cast<std::size_t>(size), descriptor);
    is_released = guarded.descriptor < 0;
  }
  release(guarded);
  _exit(0);
}

/// Whatever the first process has open must end with it: only the socket stays.
int leave_first_process(int socket) noexcept {
  setsid();
  realtime::schedule_this_thread(realtime::kLinkPriority);  // a busy machine must not delay the release
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP})
    signal(number, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_NAME, "release guard");
  constexpr int kSocket = 3;
  if (socket != kSocket) dup2(socket, kSocket);
  close_range(kSocket + 1, ~0U, 0);
  const int nothing = open("/dev/null", O_RDWR);
  for (int standard = 0; standard < kSocket; ++standard)
    dup2(nothing, standard);
  close(nothing);
  return kSocket;
}

/// Whether the process has ended, and is no more to wait for.
bool has_ended_within(pid_t id, int patience_ms) noexcept {
  constexpr int kPause_ms = 5;
  for (int waited_ms = 0; waited_ms <= patience_ms; waited_ms += kPause_ms) {
    if (waitpid(id, nullptr, WNOHANG) != 0) return true;
    poll(nullptr, 0, kPause_ms);
  }
  return false;
}

}  // namespace

ReleaseGuard::ReleaseGuard() {
  start();
}

ReleaseGuard::~ReleaseGuard() {
  disarm();
  end();
}

void ReleaseGuard::start() {
  const auto refuse = [](int error) {
    throw WireError("there is no second process, which would release the device if this one is killed: " +
                    std::generic_category().message(error));
  };
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets.data()) != 0) refuse(errno);
  // Until the second process ignores signals, they wait.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  id_ = fork();
  if (id_ == 0) guard(leave_first_process(sockets[1]));
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(sockets[1]);
  socket_ = sockets[0];
  if (id_ > 0) return;
  end();
  refuse(error);
}

/// A second process that has stopped, or waits in a driver, is killed; one that cannot even die is left behind.
void ReleaseGuard::end() noexcept {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
  if (id_ > 0 && !has_ended_within(id_, kToEnd_ms)) {
    kill(id_, SIGKILL);
    has_ended_within(id_, kToEnd_ms);
  }
  id_ = -1;
}

/// One that does not listen must not hold up the first process, and need not end well.
void ReleaseGuard::replace() {
  kill_now();
  start();
}

void ReleaseGuard::kill_now() noexcept {
  if (id_ > 0) kill(id_, SIGKILL);
  end();
}

void ReleaseGuard::arm(int descriptor, std::string_view release) {
  guarded_ = descriptor;
  release_ = release.substr(0, kLongestRelease);
  if (send_arming()) return;
  replace();
  if (!send_arming()) throw WireError("the second process, which would release the device, does not listen");
}

void ReleaseGuard::renew() {
  const auto now = std::chrono::steady_clock::now();
  if (now - renewed_ < kRenewal) return;
  renewed_ = now;
  const char order = kRenew;
  if (send({&order, 1}, -1)) return;
  replace();
  if (guarded_ >= 0) arm(guarded_, release_);
}

void ReleaseGuard::disarm() noexcept {
  guarded_ = -1;
  const char order = kDisarm;
  if (socket_ >= 0 && !send({&order, 1}, -1)) kill_now();
}

bool ReleaseGuard::send_arming() const noexcept {
  std::array<char, kLongestRelease + 1> packet{kArm};
  const std::size_t size = release_.copy(&packet[1], kLongestRelease);
  return send({packet.data(), size + 1}, guarded_);
}

/// False if the second process is no more, or so far behind that it does not guard.
bool ReleaseGuard::send(std::string_view packet, int descriptor) const noexcept {
  iovec bytes{const_cast<char*>(packet.data()), packet.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room{};
  msghdr message{};
  message.msg_iov = &bytes;
  message.msg_iovlen = 1;
  if (descriptor >= 0) {
    message.msg_control = room.data();
    message.msg_controllen = room.size();
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(header), &descriptor, sizeof(int));
  }
  return sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

}  // namespace glissade::bridges
