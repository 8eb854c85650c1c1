/// A library that a test preloads into a program, to make faults inside the program's threads:
///
/// - SIGUSR1 to one thread halts this thread for half a second; all others go on.
/// - After SIGUSR2, memory is exhausted for the thread of the name "simulation".

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <new>
#include <string_view>

#include <pthread.h>

namespace {

std::atomic<bool> is_memory_exhausted{false};

void halt(int /*signal*/) {
  const int error = errno;
  timespec rest{.tv_sec = 0, .tv_nsec = 500'000'000};
  while (nanosleep(&rest, &rest) != 0 && errno == EINTR) {
  }
  errno = error;
}

void exhaust_memory(int /*signal*/) {
  is_memory_exhausted = true;
}

bool is_simulation() {
  std::array<char, 16> name{};
  pthread_getname_np(pthread_self(), name.data(), name.size());
  return std::string_view(name.data()) == "simulation";
}

[[maybe_unused]] const bool is_installed = [] {
  std::signal(SIGUSR1, halt);
  std::signal(SIGUSR2, exhaust_memory);
  return true;
}();

}  // namespace

// All other forms of new and delete of the standard library call these or free.
void* operator new(std::size_t size) {
  if (is_memory_exhausted && is_simulation()) throw std::bad_alloc();
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
