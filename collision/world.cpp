#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include <glissade/collision/rigid_pose.h>
#include <glissade/collision/world.h>

namespace glissade::collision {

// How movers, editors and the consumer meet.
//
// One mover is inside a slot at a time. It enters by setting kMoving in the slot's state, which succeeds only while the
// state is that of its own object at rest: right generation, alive, nobody inside. It fills and publishes the triple
// buffer, marks the slot in `moved_`, and leaves. An editor removes an object by clearing kAlive, which never waits for
// a mover inside; but the slot is not given to another object before that mover has left. So the triple buffer has one
// writer at any time. Entering acquires what leaving has released, so writers follow each other properly, whichever
// threads they are; through `add`, that holds from one object of a slot to the next.
//
// A pose carries the generation of its object. The consumer uses it only for an object of this generation: poses
// of an object that was removed move nothing. The pose of an object that was added too late for this take stays in the
// reader's part of the triple buffer, where the take that learns of the object looks for it.
//
// Newest wins: the mover publishes, then sets the bit (release). The consumer clears bits (acquire), then reads the
// buffer. Where it has seen the bit, it sees that pose or a newer one; where it has not, the bit stays for the next
// take. All changes of the bits are read-modify-write, so a bit that was set twice releases both poses. A mover that is
// pre-empted anywhere holds up its own pose and no other.
namespace {

constexpr std::uint64_t kAlive = 1;
constexpr std::uint64_t kMoving = 2;
constexpr std::uint32_t kBitsOfWord = 64;
constexpr int kMaxCapacity = 1000000;

std::uint64_t state_at_rest(std::uint32_t generation) {
  return std::uint64_t{generation} << 32 | kAlive;
}

std::size_t checked_capacity(int capacity) {
  if (capacity < 1 || capacity > kMaxCapacity) {
    throw std::invalid_argument("a world cannot have room for " + std::to_string(capacity) +
                                " objects, only for 1 to 1,000,000");
  }
  return static_cast<std::size_t>(capacity);
}

}  // namespace

World::World(int capacity)
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

World::~World() = default;

ObjectId World::add(const ObjectDescription& object) {
  if (object.tree == nullptr) throw std::invalid_argument("an object of a world needs a tree");
  if (object.group < 0 || object.group >= InterestMatrix::kGroups) {
    throw std::invalid_argument("the group " + std::to_string(object.group) + " of an object is not one of 0 to 63");
  }
  const std::optional<Eigen::Isometry3d> X_WO = rigid_pose(object.X_WO);
  if (!X_WO) {
    throw std::invalid_argument("the pose X_WO of an object is not a finite rotation and a translation within 1e9 m");
  }
  const std::lock_guard lock(edits_);
  if (options_.has_value() && !(*options_ == object.tree->options())) {
    throw std::invalid_argument("the trees of a world must have been built with the same options");
  }
  const std::uint32_t slot = take_free_slot();
  options_ = object.tree->options();
  const std::uint64_t former = slots_[slot].state.load(std::memory_order_relaxed) >> 32;
  // Generation 0 is no object, also when the count begins anew.
  const std::uint32_t generation = std::max(static_cast<std::uint32_t>(former + 1), std::uint32_t{1});
  registered_[slot] = {{slot, generation}, object.tree, object.hull, *X_WO, object.group};
  mark_edited(slot);
  slots_[slot].state.store(state_at_rest(generation), std::memory_order_release);
  return registered_[slot].id;
}

void World::remove(ObjectId id) {
  const std::lock_guard lock(edits_);
  require_alive(id);
  slots_[id.index].state.fetch_and(~kAlive, std::memory_order_relaxed);
  registered_[id.index] = {};
  mark_edited(id.index);
  free_.push_back(id.index);
  if (free_.size() == slots_.size()) options_.reset();
  if (interest_.forget(id.index)) interest_edited_ = true;
}

void World::attend_groups(int group_a, int group_b) {
  const std::lock_guard lock(edits_);
  interest_.attend_groups(group_a, group_b);
  interest_edited_ = true;
}

void World::ignore_groups(int group_a, int group_b) {
  const std::lock_guard lock(edits_);
  interest_.ignore_groups(group_a, group_b);
  interest_edited_ = true;
}

void World::attend(ObjectId a, ObjectId b) {
  const std::lock_guard lock(edits_);
  require_alive(a);
  require_alive(b);
  interest_.attend(a.index, b.index);
  interest_edited_ = true;
}

void World::ignore(ObjectId a, ObjectId b) {
  const std::lock_guard lock(edits_);
  require_alive(a);
  require_alive(b);
  interest_.ignore(a.index, b.index);
  interest_edited_ = true;
}

bool World::move(ObjectId id, const Eigen::Isometry3d& X_WO) noexcept {
  const std::optional<Eigen::Isometry3d> rigid = rigid_pose(X_WO);
  if (id.index >= slots_.size() || !rigid) return false;
  Slot& slot = slots_[id.index];
  const std::uint64_t at_rest = state_at_rest(id.generation);
  std::uint64_t state = at_rest;
  if (!slot.state.compare_exchange_strong(state, at_rest | kMoving, std::memory_order_acquire,
                                          std::memory_order_relaxed)) {
    return false;
  }
  NewestPose& newest = slot.pose.write_slot();
  newest.X_WO = *rigid;
  newest.generation = id.generation;
  slot.pose.publish();
  moved_[id.index / kBitsOfWord].fetch_or(std::uint64_t{1} << id.index % kBitsOfWord, std::memory_order_release);
  slot.state.fetch_and(~kMoving, std::memory_order_release);
  return true;
}

const WorldChanges& World::take_changes() {
  changes_.removed.clear();
  changes_.added.clear();
  changes_.moved.clear();
  take_edits();
  retired_.clear();  // outside of the lock: large trees take their time
  take_poses();
  return changes_;
}

bool World::is_alive(ObjectId id) const {
  return id.generation != 0 && id.index < registered_.size() && registered_[id.index].id == id;
}

void World::require_alive(ObjectId id) const {
  if (!is_alive(id)) {
    throw std::invalid_argument("the object " + std::to_string(id.index) + " of generation " +
                                std::to_string(id.generation) + " is not, or no longer, in this world");
  }
}

// The slot that was freed last and has no mover inside.
std::uint32_t World::take_free_slot() {
  for (std::size_t i = free_.size(); i > 0; --i) {
    const std::uint32_t slot = free_[i - 1];
    if ((slots_[slot].state.load(std::memory_order_acquire) & kMoving) != 0) continue;
    free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i - 1));
    return slot;
  }
  throw std::length_error("the world is full: it has room for " + std::to_string(slots_.size()) + " objects");
}

void World::mark_edited(std::uint32_t slot) {
  if (is_edited_[slot] == 0) edited_.push_back(slot);
  is_edited_[slot] = 1;
}

void World::take_edits() {
  const std::lock_guard lock(edits_);
  std::sort(edited_.begin(), edited_.end());
  for (const std::uint32_t slot : edited_)
    take_edit(slot);
  edited_.clear();
  changes_.interest = interest_edited_;
  if (interest_edited_) interest_taken_ = interest_;
  interest_edited_ = false;
}

void World::take_edit(std::uint32_t slot) {
  is_edited_[slot] = 0;
  WorldObject& object = objects_[slot];
  if (object.id == registered_[slot].id) return;  // came and went between two takes
  if (object.id != ObjectId{}) {
    changes_.removed.push_back(slot);
    retired_.push_back(std::move(object));
  }
  object = registered_[slot];
  if (object.id == ObjectId{}) return;
  changes_.added.push_back(slot);
  const NewestPose& newest = slots_[slot].pose.latest();
  if (newest.generation == object.id.generation) object.X_WO = newest.X_WO;
}

void World::take_poses() {
  for (std::size_t word = 0; word < moved_.size(); ++word) {
    if (moved_[word].load(std::memory_order_relaxed) == 0) continue;
    std::uint64_t bits = moved_[word].exchange(0, std::memory_order_acquire);
    for (; bits != 0; bits &= bits - 1) {
      const auto slot = static_cast<std::uint32_t>(word * kBitsOfWord + static_cast<unsigned>(std::countr_zero(bits)));
      WorldObject& object = objects_[slot];
      if (!slots_[slot].pose.update()) continue;
      const NewestPose& newest = slots_[slot].pose.value();
      if (newest.generation != object.id.generation) continue;
      object.X_WO = newest.X_WO;
      if (!std::binary_search(changes_.added.begin(), changes_.added.end(), slot)) changes_.moved.push_back(slot);
    }
  }
}

}  // namespace glissade::collision
