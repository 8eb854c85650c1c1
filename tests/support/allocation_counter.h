#pragma once

/// Counts what the calling thread takes from the heap: interposes malloc and its kin for the whole test program.

#include <cstdint>

namespace glissade::test_support {

/// Allocations of the calling thread so far. Always 0 under sanitizers, whose allocators cannot be interposed: ask
/// `allocations_are_counted` first.
std::int64_t allocations_of_this_thread();

bool allocations_are_counted();

}  // namespace glissade::test_support
