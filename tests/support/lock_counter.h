#pragma once

/// Counts the locks of the calling thread: interposes the functions of POSIX threads and semaphores by which a thread
/// can wait for another, or wake it up, for the whole test program.

#include <cstdint>

namespace glissade::test_support {

/// Calls of these functions by the calling thread so far, whether or not they had to wait.
std::int64_t locks_of_this_thread();

/// The name of the function that the calling thread called last, such as "pthread_mutex_lock"; "none" before the first.
const char* last_lock_of_this_thread();

}  // namespace glissade::test_support
