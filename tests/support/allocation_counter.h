#pragma once

/// Counts the heap allocations and releases of the calling thread: interposes malloc and its relatives for the whole
/// test program.

#include <cstdint>

namespace glissade::test_support {

/// Allocations of the calling thread so far. Always 0 under sanitizers, whose allocators cannot be interposed;
/// see `allocations_are_counted`.
std::int64_t allocations_of_this_thread();

/// Blocks that the calling thread has given back so far. Always 0 under sanitizers.
std::int64_t releases_of_this_thread();

bool allocations_are_counted();

}  // namespace glissade::test_support
