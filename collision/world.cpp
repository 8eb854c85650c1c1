#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/collision/dop_tree.h>
#include <glissade/collision/query_types.h>
#include <glissade/collision/world.h>
#include <glissade/geometry/displacement.h>

#include "pipeline/interest_matrix.h"

namespace glissade::collision {

// Protocol of movers, editors and the consumer.
//
// One mover is inside a slot at a time. It enters by setting kInside in the slot's state, which succeeds only while the
// state is that of its own object and nobody is inside. It writes the pose that is not the newest, and leaves by
// incrementing the count of poses, which makes that pose the newest. An editor removes an object by clearing the slot's
// generation, which never waits for a mover inside. It gives the slot to another object by entering as a mover does: it
// writes the first pose of the new object, and leaves with the new generation in the state. So poses have one writer at
// any time. Entering acquires what leaving has released, so writers are ordered, whichever threads they are.
//
// The consumer reads the state, the newest pose, and the state again. If generation and count are the same, nobody has
// written that pose meanwhile, because a mover inside writes the other one. (Numbers of the pose are released and
// acquired one by one: a reader that sees a number of a later pose also sees the state from before that pose was
// written.) The pose is used only for an object of this generation, so poses of an object that was removed move
// nothing.
//
// The newest pose wins: the mover leaves, then sets the slot's bit in `moved_` (release). The consumer clears bits
// (acquire), then reads the pose. If it has seen the bit, it sees that pose or a newer one; if not, the bit stays for
// the next take. All changes of the bits are read-modify-write, so a bit that was set twice releases both poses. A
// mover that is pre-empted anywhere delays its own poses only.
namespace {

constexpr std::uint64_t kInside = 1;
constexpr std::uint64_t kOnePose = 2;
constexpr std::uint64_t kPoses = 0xffff'fffe;  // count of poses, modulo a power of two
constexpr std::uint32_t kBitsOfWord = 64;
constexpr int kMaxCapacity = 1000000;

std::uint32_t generation_of(std::uint64_t state) {
  return static_cast<std::uint32_t>(state >> 32);
}

std::uint64_t with_generation(std::uint64_t state, std::uint32_t generation) {
  return std::uint64_t{generation} << 32 | (state & 0xffff'ffff);
}

std::uint64_t with_next_pose(std::uint64_t state) {
  return (state & ~kPoses) | ((state + kOnePose) & kPoses);
}

std::size_t newest(std::uint64_t state) {
  return (state & kOnePose) != 0 ? 1 : 0;
}

bool enter(std::atomic<std::uint64_t>& state, std::uint64_t expected) {
  return state.compare_exchange_strong(expected, expected | kInside, std::memory_order_acquire,
                                       std::memory_order_relaxed);
}

// The upper three rows of the matrix, column by column. Accessed by index sequences, so that compilers keep them in
// registers.
using PoseNumbers = std::array<std::atomic<double>, 12>;
constexpr std::make_index_sequence<12> kPoseNumbers;

template <std::size_t... i>
void write_pose(const Eigen::Isometry3d& X_WO, PoseNumbers& numbers, std::index_sequence<i...>) {
  const double* const entries = X_WO.matrix().data();
  (numbers[i].store(entries[i / 3 * 4 + i % 3], std::memory_order_release), ...);
}

template <std::size_t... i>
std::array<double, sizeof...(i)> read_pose(const PoseNumbers& numbers, std::index_sequence<i...>) {
  return {numbers[i].load(std::memory_order_acquire)...};
}

template <std::size_t... i>
void put_pose(const std::array<double, sizeof...(i)>& numbers, Eigen::Isometry3d& X_WO, std::index_sequence<i...>) {
  double* const entries = X_WO.matrix().data();
  ((entries[i / 3 * 4 + i % 3] = numbers[i]), ...);
}

std::size_t checked_capacity(int capacity) {
  if (capacity < 1 || capacity > kMaxCapacity) {
    throw std::invalid_argument("a world cannot have room for " + std::to_string(capacity) +
                                " objects, only for 1 to 1,000,000");
  }
  return static_cast<std::size_t>(capacity);
}

}  // namespace

class World::State {
 public:
  explicit State(int capacity);

  ObjectId add(const ObjectDescription& object);
  void remove(ObjectId id);
  void enable_groups(int group_a, int group_b);
  void disable_groups(int group_a, int group_b);
  void enable_pair(ObjectId a, ObjectId b);
  void disable_pair(ObjectId a, ObjectId b);
  bool move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept;
  const WorldChanges& take_changes();

 private:
  friend class World;

  /// The newest pose, and room for the next.
  struct alignas(64) Slot {
    std::atomic<std::uint64_t> state{0};                            ///< generation, count of poses, kInside
    std::atomic<std::uint32_t> generation{0};                       ///< of the object that is here; 0: none
    std::array<std::array<std::atomic<double>, 12>, 2> poses_WO{};  ///< by the last bit of that count
  };

  bool is_alive(ObjectId id) const;
  void require_alive(ObjectId id) const;
  std::uint32_t take_free_slot(const Eigen::Isometry3d& X_WO);
  void mark_edited(std::uint32_t slot);
  void take_edits();
  void take_edit(std::uint32_t slot);
  void take_poses();
  bool take_pose(std::uint32_t slot);

  // Written by movers.
  std::vector<Slot> slots_;
  std::vector<std::atomic<std::uint64_t>> moved_;  ///< a bit for each slot whose pose the consumer has not taken

  // Written by editors, under the mutex.
  std::mutex edits_;
  std::vector<WorldObject> registered_;
  std::vector<std::uint32_t> free_;
  std::vector<std::uint32_t> edited_;  ///< slots that differ from `objects_`, each once
  std::vector<std::uint8_t> is_edited_;
  std::optional<DopTreeOptions> options_;  ///< of all trees here
  InterestMatrix interest_;
  bool interest_edited_ = false;

  // Owned by the consumer.
  std::vector<WorldObject> objects_;
  std::vector<WorldObject> retired_;
  InterestMatrix interest_taken_;
  WorldChanges changes_;
};

World::State::State(int capacity)
    : slots_(checked_capacity(capacity)),
      moved_((slots_.size() + kBitsOfWord - 1) / kBitsOfWord),
      registered_(slots_.size()),
      is_edited_(slots_.size()),
      objects_(slots_.size()) {
  const std::size_t size = slots_.size();
  free_.reserve(size);
  for (std::size_t i = size; i > 0; --i)
    free_.push_back(static_cast<std::uint32_t>(i - 1));
  edited_.reserve(size);
  retired_.reserve(size);
  for (auto* list : {&changes_.removed, &changes_.added, &changes_.moved})
    list->reserve(size);
}

ObjectId World::State::add(const ObjectDescription& object) {
  if (object.tree == nullptr) throw std::invalid_argument("an object of a world needs a tree");
  if (object.selection != nullptr && !object.selection->is_of(*object.tree)) {
    throw std::invalid_argument("the selection of triangles of an object was made for another tree than its own");
  }
  if (object.group < 0 || object.group >= InterestMatrix::kGroups) {
    throw std::invalid_argument("the group " + std::to_string(object.group) + " of an object is not one of 0 to 63");
  }
  const std::optional<Eigen::Isometry3d> X_WO = geometry::rigid_pose(object.X_WO);
  if (!X_WO) {
    throw std::invalid_argument("the pose X_WO of an object is not a finite rotation and a translation within 1e9 m");
  }
  const std::lock_guard lock(edits_);
  if (options_.has_value() && !(*options_ == object.tree->options())) {
    throw std::invalid_argument("the trees of a world must have been built with the same options");
  }
  const std::uint32_t slot = take_free_slot(*X_WO);
  const std::uint32_t generation = generation_of(slots_[slot].state.load(std::memory_order_relaxed));
  options_ = object.tree->options();
  registered_[slot] = {{slot, generation}, object.tree, object.hull, *X_WO, object.group, object.selection};
  mark_edited(slot);
  slots_[slot].generation.store(generation, std::memory_order_release);
  return registered_[slot].id;
}

void World::State::remove(ObjectId id) {
  const std::lock_guard lock(edits_);
  require_alive(id);
  slots_[id.index].generation.store(0, std::memory_order_relaxed);
  registered_[id.index] = {};
  mark_edited(id.index);
  free_.push_back(id.index);
  if (free_.size() == slots_.size()) options_.reset();
  if (interest_.forget(id.index)) interest_edited_ = true;
}

void World::State::enable_groups(int group_a, int group_b) {
  const std::lock_guard lock(edits_);
  interest_.enable_groups(group_a, group_b);
  interest_edited_ = true;
}

void World::State::disable_groups(int group_a, int group_b) {
  const std::lock_guard lock(edits_);
  interest_.disable_groups(group_a, group_b);
  interest_edited_ = true;
}

void World::State::enable_pair(ObjectId a, ObjectId b) {
  const std::lock_guard lock(edits_);
  require_alive(a);
  require_alive(b);
  interest_.enable_pair(a.index, b.index);
  interest_edited_ = true;
}

void World::State::disable_pair(ObjectId a, ObjectId b) {
  const std::lock_guard lock(edits_);
  require_alive(a);
  require_alive(b);
  interest_.disable_pair(a.index, b.index);
  interest_edited_ = true;
}

bool World::State::move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept {
  const std::optional<Eigen::Isometry3d> rigid = geometry::rigid_pose(X_WO);
  if (id.index >= slots_.size() || !rigid) return false;
  Slot& slot = slots_[id.index];
  if (id.generation == 0 || slot.generation.load(std::memory_order_acquire) != id.generation) return false;
  const std::uint64_t state = slot.state.load(std::memory_order_relaxed) & ~kInside;
  if (generation_of(state) != id.generation || !enter(slot.state, state)) return false;
  const std::uint64_t next = with_next_pose(state);
  write_pose(*rigid, slot.poses_WO[newest(next)], kPoseNumbers);
  slot.state.store(next, std::memory_order_release);
  moved_[id.index / kBitsOfWord].fetch_or(std::uint64_t{1} << id.index % kBitsOfWord, std::memory_order_release);
  return true;
}

const WorldChanges& World::State::take_changes() {
  changes_.removed.clear();
  changes_.added.clear();
  changes_.moved.clear();
  take_edits();
  retired_.clear();  // outside of the lock, because destroying large trees takes long
  take_poses();
  return changes_;
}

bool World::State::is_alive(ObjectId id) const {
  return id.generation != 0 && id.index < registered_.size() && registered_[id.index].id == id;
}

void World::State::require_alive(ObjectId id) const {
  if (!is_alive(id)) {
    throw std::invalid_argument("the object " + std::to_string(id.index) + " of generation " +
                                std::to_string(id.generation) + " is not, or no longer, in this world");
  }
}

// Takes the free slot that was freed last among those without a mover inside. Its state is then that of the next
// object.
std::uint32_t World::State::take_free_slot(const Eigen::Isometry3d& X_WO) {
  for (std::size_t i = free_.size(); i > 0; --i) {
    const std::uint32_t number = free_[i - 1];
    Slot& slot = slots_[number];
    const std::uint64_t state = slot.state.load(std::memory_order_relaxed) & ~kInside;
    if (!enter(slot.state, state)) continue;
    free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i - 1));
    // Skips generation 0, which means no object, when the count wraps around.
    const std::uint32_t generation = std::max(generation_of(state) + 1, std::uint32_t{1});
    const std::uint64_t next = with_generation(with_next_pose(state), generation);
    write_pose(X_WO, slot.poses_WO[newest(next)], kPoseNumbers);
    slot.state.store(next, std::memory_order_release);
    return number;
  }
  throw std::length_error("the world is full: it has room for " + std::to_string(slots_.size()) + " objects");
}

void World::State::mark_edited(std::uint32_t slot) {
  if (is_edited_[slot] == 0) edited_.push_back(slot);
  is_edited_[slot] = 1;
}

void World::State::take_edits() {
  const std::lock_guard lock(edits_);
  std::sort(edited_.begin(), edited_.end());
  for (const std::uint32_t slot : edited_)
    take_edit(slot);
  edited_.clear();
  changes_.interest = interest_edited_;
  if (interest_edited_) interest_taken_ = interest_;
  interest_edited_ = false;
}

void World::State::take_edit(std::uint32_t slot) {
  is_edited_[slot] = 0;
  WorldObject& object = objects_[slot];
  if (object.id == registered_[slot].id) return;  // the object came and went between two takes
  if (object.id != ObjectId{}) {
    changes_.removed.push_back(slot);
    retired_.push_back(std::move(object));
  }
  object = registered_[slot];
  if (object.id == ObjectId{}) return;
  changes_.added.push_back(slot);
  take_pose(slot);
}

void World::State::take_poses() {
  for (std::size_t word = 0; word < moved_.size(); ++word) {
    if (moved_[word].load(std::memory_order_relaxed) == 0) continue;
    std::uint64_t bits = moved_[word].exchange(0, std::memory_order_acquire);
    for (; bits != 0; bits &= bits - 1) {
      const auto slot = static_cast<std::uint32_t>(word * kBitsOfWord + static_cast<unsigned>(std::countr_zero(bits)));
      if (!take_pose(slot)) continue;
      if (!std::binary_search(changes_.added.begin(), changes_.added.end(), slot)) changes_.moved.push_back(slot);
    }
  }
}

// Returns whether the slot still belongs to the object that the consumer has there.
bool World::State::take_pose(std::uint32_t slot) {
  WorldObject& object = objects_[slot];
  const Slot& source = slots_[slot];
  std::uint64_t before = source.state.load(std::memory_order_acquire) | kInside;
  while (generation_of(before) == object.id.generation) {
    const std::array<double, 12> numbers = read_pose(source.poses_WO[newest(before)], kPoseNumbers);
    const std::uint64_t after = source.state.load(std::memory_order_acquire) | kInside;
    if (after == before) {
      put_pose(numbers, object.X_WO, kPoseNumbers);
      return true;
    }
    before = after;
  }
  return false;
}

World::World(int capacity) : state_(std::make_unique<State>(capacity)) {}
World::~World() = default;

int World::capacity() const {
  return static_cast<int>(state_->slots_.size());
}

ObjectId World::add(const ObjectDescription& object) {
  return state_->add(object);
}

void World::remove(ObjectId id) {
  state_->remove(id);
}

void World::enable_groups(int group_a, int group_b) {
  state_->enable_groups(group_a, group_b);
}

void World::disable_groups(int group_a, int group_b) {
  state_->disable_groups(group_a, group_b);
}

void World::enable_pair(ObjectId a, ObjectId b) {
  state_->enable_pair(a, b);
}

void World::disable_pair(ObjectId a, ObjectId b) {
  state_->disable_pair(a, b);
}

bool World::move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept {
  return state_->move(id, X_WO);
}

const WorldChanges& World::take_changes() {
  return state_->take_changes();
}

std::span<const WorldObject> World::objects() const {
  return state_->objects_;
}

bool World::is_enabled(std::uint32_t slot_a, std::uint32_t slot_b) const {
  const std::vector<WorldObject>& objects = state_->objects_;
  GLISSADE_ASSERT(slot_a < objects.size() && objects[slot_a].id != ObjectId{});
  GLISSADE_ASSERT(slot_b < objects.size() && objects[slot_b].id != ObjectId{});
  return state_->interest_taken_.is_enabled(slot_a, objects[slot_a].group, slot_b, objects[slot_b].group);
}

}  // namespace glissade::collision
