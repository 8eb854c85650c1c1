#include "lock_counter.h"

#include <dlfcn.h>
#include <pthread.h>
#include <semaphore.h>

namespace {

thread_local std::int64_t locks = 0;
thread_local const char* last_lock = "none";

}  // namespace

namespace glissade::test_support {

std::int64_t locks_of_this_thread() {
  return locks;
}

const char* last_lock_of_this_thread() {
  return last_lock;
}

}  // namespace glissade::test_support

/// Defines a function of the C library once more: it counts, and calls the C library's own.
#define GLISSADE_COUNTED(name, guarantee, parameters, arguments)                               \
  extern "C" int name parameters guarantee {                                                   \
    static const auto function = reinterpret_cast<decltype(&::name)>(dlsym(RTLD_NEXT, #name)); \
    ++locks;                                                                                   \
    last_lock = #name;                                                                         \
    return function arguments;                                                                 \
  }

GLISSADE_COUNTED(pthread_mutex_lock, noexcept, (pthread_mutex_t * mutex), (mutex))
GLISSADE_COUNTED(pthread_mutex_trylock, noexcept, (pthread_mutex_t * mutex), (mutex))
GLISSADE_COUNTED(pthread_mutex_timedlock, noexcept, (pthread_mutex_t * mutex, const timespec* time), (mutex, time))
GLISSADE_COUNTED(pthread_rwlock_rdlock, noexcept, (pthread_rwlock_t * lock), (lock))
GLISSADE_COUNTED(pthread_rwlock_tryrdlock, noexcept, (pthread_rwlock_t * lock), (lock))
GLISSADE_COUNTED(pthread_rwlock_wrlock, noexcept, (pthread_rwlock_t * lock), (lock))
GLISSADE_COUNTED(pthread_rwlock_trywrlock, noexcept, (pthread_rwlock_t * lock), (lock))
GLISSADE_COUNTED(pthread_cond_wait, , (pthread_cond_t * condition, pthread_mutex_t* mutex), (condition, mutex))
GLISSADE_COUNTED(pthread_cond_timedwait, , (pthread_cond_t * condition, pthread_mutex_t* mutex, const timespec* time),
                 (condition, mutex, time))
GLISSADE_COUNTED(pthread_cond_clockwait, ,
                 (pthread_cond_t * condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* time),
                 (condition, mutex, clock, time))
GLISSADE_COUNTED(pthread_cond_signal, noexcept, (pthread_cond_t * condition), (condition))
GLISSADE_COUNTED(pthread_cond_broadcast, noexcept, (pthread_cond_t * condition), (condition))
GLISSADE_COUNTED(sem_wait, , (sem_t * semaphore), (semaphore))
GLISSADE_COUNTED(sem_timedwait, , (sem_t * semaphore, const timespec* time), (semaphore, time))
GLISSADE_COUNTED(sem_post, noexcept, (sem_t * semaphore), (semaphore))
