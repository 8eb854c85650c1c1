#include "work_crew.h"

#include <oneapi/tbb/info.h>

namespace glissade::collision {
namespace {

int number_of(int threads) {
  return threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
}

}  // namespace

WorkCrew::WorkCrew(int threads) : threads_(number_of(threads)), arena_(threads_) {
  // oneTBB keeps no more threads than the machine has, unless it is told to.
  if (threads_ > oneapi::tbb::info::default_concurrency()) {
    allowance_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_));
  }
}

}  // namespace glissade::collision
