#include "query/parallel_query.h"

#include <atomic>
#include <cstdint>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <glissade/base/assert.h>

#include "query/dop_traversal.h"
#include "query/pair_visitors.h"
#include "query/placed_trees.h"
#include "query/sort_pairs.h"
#include "query/workspace_access.h"

namespace glissade::collision {
namespace {

// A box test and the triangle tests that follow it take 10 to 20 ns. Sleeping threads need at least 50 us to wake, so a
// query is shared once it has taken about that long. A piece takes long compared with handing it over, which costs
// about a microsecond.
constexpr std::int64_t kTestsWorthSharing = 4'000;
constexpr std::int64_t kTestsOfPiece = 1'500;

}  // namespace

struct ParallelWorkspace::Memory {
  struct Worker {
    QueryWorkspace scratch;
    std::vector<TrianglePair> triangle_pairs;
    std::vector<ClosePair> close_pairs;
  };
  oneapi::tbb::enumerable_thread_specific<Worker> workers;
  QueryWorkspace scratch;  ///< of the calling thread
  QueryCounters counters;
  // oneTBB orders a piece after its submission, and the end of the wait after all pieces. These counters repeat that
  // order, because the thread sanitizer does not look into the library.
  std::atomic<int> pieces{0};  ///< submitted
  std::atomic<int> done{0};    ///< completed
};

ParallelWorkspace::ParallelWorkspace() : memory_(std::make_unique<Memory>()) {}
ParallelWorkspace::~ParallelWorkspace() = default;
ParallelWorkspace::ParallelWorkspace(ParallelWorkspace&&) noexcept = default;
ParallelWorkspace& ParallelWorkspace::operator=(ParallelWorkspace&&) noexcept = default;

const QueryCounters& ParallelWorkspace::counters() const {
  return memory_->counters;
}

int ParallelWorkspace::pieces() const {
  return memory_->pieces.load(std::memory_order_relaxed);
}

namespace {

using Worker = ParallelWorkspace::Memory::Worker;
using Stack = std::vector<OpenPair>;

std::vector<TrianglePair>& pairs_of(Worker& worker, const TrianglePair*) {
  return worker.triangle_pairs;
}
std::vector<ClosePair>& pairs_of(Worker& worker, const ClosePair*) {
  return worker.close_pairs;
}

QueryCounters& operator+=(QueryCounters& sum, const QueryCounters& c) {
  sum.node_tests += c.node_tests;
  sum.realignments += c.realignments;
  sum.triangle_tests += c.triangle_tests;
  return sum;
}

// Removes the older half of the remaining work from the stack and returns it: nodes nearer to the roots, so the larger
// part of the work.
Stack older_half(Stack& stack) {
  const auto middle = stack.begin() + static_cast<std::ptrdiff_t>(stack.size() / 2);
  Stack half(stack.begin(), middle);
  stack.erase(stack.begin(), middle);
  return half;
}

// A query that has turned out to be large.
template <typename Pair>
class SharedQuery {
 public:
  SharedQuery(const PlacedTrees& placed, double distance, ParallelWorkspace::Memory& memory)
      : placed_(placed), distance_(distance), memory_(memory) {}

  // Completes the work on the stack of the calling thread, and appends the pairs found.
  void run(Stack& stack, std::vector<Pair>& pairs) {
    for (Worker& worker : memory_.workers) {
      pairs_of(worker, static_cast<const Pair*>(nullptr)).clear();
      memory_of(worker.scratch).counters = {};
    }
    // A thread that waits here must not begin unrelated tasks, which might take long.
    oneapi::tbb::this_task_arena::isolate([&] {
      hand_over(older_half(stack));
      hand_over(std::move(stack));
      pieces_.wait();
    });
    [[maybe_unused]] const int done = memory_.done.load(std::memory_order_acquire);
    GLISSADE_ASSERT(done == memory_.pieces.load(std::memory_order_relaxed));
    stack.clear();
    for (Worker& worker : memory_.workers) {
      std::vector<Pair>& found = pairs_of(worker, static_cast<const Pair*>(nullptr));
      pairs.insert(pairs.end(), found.begin(), found.end());
      memory_.counters += worker.scratch.counters();
    }
  }

 private:
  void hand_over(Stack&& piece) {
    memory_.pieces.fetch_add(1, std::memory_order_release);
    pieces_.run([this, piece = std::move(piece)] {
      static_cast<void>(memory_.pieces.load(std::memory_order_acquire));
      do_piece(piece);
      memory_.done.fetch_add(1, std::memory_order_release);
    });
  }

  void do_piece(const Stack& piece) {
    Worker& worker = memory_.workers.local();
    QueryMemory& scratch = memory_of(worker.scratch);
    scratch.stack = piece;
    DopVisit step(placed_.base(), placed_.other(), placed_.frame, distance_, scratch.alignment,
                  placed_.visit_selection());
    PairCollector<Pair> visitor(placed_, distance_, pairs_of(worker, static_cast<const Pair*>(nullptr)));
    while (!continue_all(step, scratch, visitor, scratch.counters.node_tests + kTestsOfPiece)) {
      if (scratch.stack.size() > 1) hand_over(older_half(scratch.stack));
    }
    visitor.finish();
  }

  const PlacedTrees& placed_;
  double distance_;
  ParallelWorkspace::Memory& memory_;
  oneapi::tbb::task_group pieces_;
};

template <typename Pair>
void find_pairs(const PlacedTrees& placed, double distance, ParallelWorkspace::Memory& memory,
                std::vector<Pair>& pairs) {
  pairs.clear();
  memory.pieces = 0;
  memory.done = 0;
  memory.counters = {};
  const VisitSelection selection = placed.visit_selection();
  if (placed.frame.spheres_apart(distance)) return;
  QueryMemory& scratch = memory_of(memory.scratch);
  scratch.counters = {};
  DopVisit step(placed.base(), placed.other(), placed.frame, distance, scratch.alignment, selection);
  PairCollector<Pair> visitor(placed, distance, pairs);
  begin_all(step, scratch, visitor);
  const bool is_all = continue_all(step, scratch, visitor, kTestsWorthSharing);
  visitor.finish();
  if (!is_all) {
    SharedQuery<Pair>(placed, distance, memory).run(scratch.stack, pairs);
  }
  memory.counters += scratch.counters;
  sort_pairs(pairs, scratch);
}

}  // namespace

void intersecting_pairs(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB,
                        ParallelWorkspace& workspace, std::vector<TrianglePair>& pairs, double tolerance) {
  find_pairs({tree_A, tree_B, X_AB}, tolerance, workspace.memory(), pairs);
}

void pairs_within(const DopTree& tree_A, const DopTree& tree_B, const Eigen::Isometry3d& X_AB, double distance,
                  ParallelWorkspace& workspace, std::vector<ClosePair>& pairs, const PairSelection& selection) {
  find_pairs({tree_A, tree_B, X_AB, selection}, distance, workspace.memory(), pairs);
}

}  // namespace glissade::collision
