#include "allocation_counter.h"

#include <cerrno>
#include <cstddef>

#include "sanitizers.h"

namespace {
thread_local std::int64_t allocations = 0;
thread_local std::int64_t releases = 0;
}  // namespace

namespace glissade::test_support {

std::int64_t allocations_of_this_thread() {
  return allocations;
}

std::int64_t releases_of_this_thread() {
  return releases;
}

bool allocations_are_counted() {
  return !kSanitized;
}

}  // namespace glissade::test_support

#if !GLISSADE_SANITIZED
// glibc exports its own functions under these names too; operator new ends up in malloc or aligned_alloc.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* block, std::size_t size);             // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
void __libc_free(void* block);                                   // NOLINT

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void free(void* block) {
  if (block != nullptr) ++releases;
  __libc_free(block);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocations;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
}
#endif
