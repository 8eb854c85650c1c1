// The pipeline against brute force: random scenes of up to 200 objects that move, rest, jump, come and go, and are of
// changing interest to each other. Pipelines of one, two and four threads must find the pairs that asking about every
// pair of objects finds, and the same triangles.

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glissade/collision/collision_pipeline.h>
#include <glissade/collision/dop_query.h>
#include <glissade/geometry/displacement.h>

#include "random_numbers.h"
#include "sweeps/sweep_meshes.h"
#include "sweeps/sweep_report.h"

namespace glissade::collision {
namespace {

using namespace test_support;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kFramesPerScene = 100;
constexpr std::array<int, 3> kThreads{1, 2, 4};
constexpr int kGroups = 4;

struct Shape {
  std::shared_ptr<const DopTree> tree;
  std::shared_ptr<const ConvexHull> hull;
};

struct Counts {
  std::int64_t frames = 0;
  std::int64_t objects = 0;
  std::int64_t meeting = 0;
  std::int64_t changes = 0;
  std::int64_t edits = 0;
  std::array<std::int64_t, 3> queries{};
};

// A world and a pipeline for each number of threads; all get the same calls.
struct Copy {
  Copy(int threads, const PipelineOptions& options, const realtime::Clock& clock)
      : world(kCapacity), pipeline(world, clock, with_threads(options, threads)) {}

  static PipelineOptions with_threads(PipelineOptions options, int threads) {
    options.threads = threads;
    return options;
  }

  static constexpr int kCapacity = 200;
  World world;
  CollisionPipeline pipeline;
};

class Scene {
 public:
  Scene(std::uint64_t seed, std::int64_t index) : random_(seed * 1'000'003 + static_cast<std::uint64_t>(index)) {
    scale_ = random_.power_of_ten(-3.0, 2.0);
    origin_ = random_.chance(0.3) ? random_.point(random_.power_of_ten(0.0, 3.0) * scale_) : Vector3d::Zero();
    options_.query = static_cast<PairQuery>(random_.integer(0, 2));
    options_.hull_test = random_.chance(0.3) ? HullTest::kPerceptron : HullTest::kExact;
    if (random_.chance(0.5)) options_.greatest_distance = random_.power_of_ten(-6.0, -1.0) * scale_;
    for (const int threads : kThreads)
      copies_.push_back(std::make_unique<Copy>(threads, options_, clock_));
    const int most_objects = random_.chance(0.3) ? Copy::kCapacity : random_.integer(2, Copy::kCapacity);
    // From crowded, where everybody meets many others, to nearly empty.
    room_ = scale_ * std::cbrt(most_objects) * random_.uniform(0.7, 3.0);
    for (int i = 0; i < 12; ++i)
      shapes_.push_back(random_shape());
    while (static_cast<int>(objects_.size()) < most_objects)
      add();
  }

  /// Returns what differs, or an empty string.
  std::string frame(Counts& counts) {
    edit(counts);
    const bool everybody_moves = random_.chance(0.5);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (everybody_moves || random_.chance(0.1)) move(i);
    }
    if (random_.chance(0.2))
      distance_ = random_.chance(0.3) ? 0.0 : random_.uniform(0.0, 1.0) * options_.greatest_distance;
    const std::vector<Answer> expected = brute_force();
    ++counts.frames;
    counts.objects += std::ssize(objects_);
    counts.meeting += std::ssize(expected);
    counts.changes += std::ssize(expected) != meeting_before_ ? 1 : 0;
    ++counts.queries[static_cast<std::size_t>(options_.query)];
    meeting_before_ = std::ssize(expected);
    for (std::size_t c = 0; c < copies_.size(); ++c) {
      const std::string difference = compare(expected, copies_[c]->pipeline.step(distance_));
      if (!difference.empty()) return std::to_string(kThreads[c]) + " threads: " + difference + description();
    }
    return "";
  }

 private:
  struct Object {
    ObjectId id;
    Shape shape;
    Isometry3d X_WO;
    int group;
    double step;  // metres
  };
  struct Answer {
    ObjectPair objects;
    std::vector<TrianglePair> triangle_pairs;
    std::vector<ClosePair> close_pairs;
  };

  Shape random_shape() {
    const double size = scale_ * random_.uniform(0.2, 1.0);
    geometry::TriangleMesh mesh;
    if (random_.chance(0.3)) {
      mesh = random_surface(random_.integer(200, 3000), random_);
      for (Vector3d& x : mesh.vertices)
        x *= size;
    } else {
      mesh = random_mesh(size, random_.chance(0.5) ? Vector3d::Zero() : random_.point(size), random_).mesh;
    }
    Shape shape{std::make_shared<DopTree>(std::make_shared<geometry::TriangleMesh>(mesh)), nullptr};
    if (random_.chance(0.9)) shape.hull = std::make_shared<ConvexHull>(mesh);
    return shape;
  }

  Isometry3d random_pose() {
    Isometry3d X_WO = Isometry3d::Identity();
    X_WO.linear() = random_.rotation();
    X_WO.translation() =
        origin_ + room_ * Vector3d(random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5));
    return X_WO;
  }

  void add() {
    Object object{{},
                  shapes_[static_cast<std::size_t>(random_.integer(0, 11))],
                  random_pose(),
                  random_.integer(0, kGroups - 1),
                  scale_ * random_.power_of_ten(-7.0, -1.0)};
    for (const auto& copy : copies_)
      object.id = copy->world.add({object.shape.tree, object.shape.hull, object.X_WO, object.group});
    objects_.push_back(object);
  }

  void remove() {
    const auto i = static_cast<std::size_t>(random_.integer(0, static_cast<int>(objects_.size()) - 1));
    for (const auto& copy : copies_)
      copy->world.remove(objects_[i].id);
    std::erase_if(disabled_pairs_,
                  [&](const auto& pair) { return pair.first == objects_[i].id || pair.second == objects_[i].id; });
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  void edit(Counts& counts) {
    const auto count = static_cast<int>(objects_.size());
    if (random_.chance(0.1) && count > 1) remove(), ++counts.edits;
    // Often into the slot that has just become free.
    if (random_.chance(0.1) && count < Copy::kCapacity) add(), ++counts.edits;
    if (random_.chance(0.05)) change_groups(), ++counts.edits;
    if (random_.chance(0.1)) change_pair(), ++counts.edits;
  }

  void change_groups() {
    const int a = random_.integer(0, kGroups - 1);
    const int b = random_.integer(0, kGroups - 1);
    const bool enable = random_.chance(0.6);
    enabled_groups_[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = enable;
    enabled_groups_[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)] = enable;
    for (const auto& copy : copies_)
      enable ? copy->world.enable_groups(a, b) : copy->world.disable_groups(a, b);
  }

  void change_pair() {
    const auto any = [&] {
      return objects_[static_cast<std::size_t>(random_.integer(0, static_cast<int>(objects_.size()) - 1))].id;
    };
    const auto pair = std::minmax({any(), any()});
    const bool enable = random_.chance(0.3);
    enable ? static_cast<void>(disabled_pairs_.erase(pair)) : static_cast<void>(disabled_pairs_.insert(pair));
    for (const auto& copy : copies_)
      enable ? copy->world.enable_pair(pair.first, pair.second) : copy->world.disable_pair(pair.second, pair.first);
  }

  void move(std::size_t i) {
    Object& object = objects_[i];
    if (random_.chance(0.01)) {
      object.X_WO = random_pose();
    } else {
      const Vector3d turning = random_.point(0.5 * object.step / scale_);
      const Eigen::AngleAxisd turn(turning.norm(), turning.norm() > 0.0 ? turning.normalized() : Vector3d::UnitX());
      object.X_WO.linear() = (turn * Eigen::Quaterniond(object.X_WO.linear())).normalized().toRotationMatrix();
      object.X_WO.translation() += random_.point(object.step);
    }
    // Poses that have come through a file in single precision, say.
    if (random_.chance(0.01)) object.X_WO.linear() *= 1.0 + random_.uniform(-1e-5, 1e-5);
    for (const auto& copy : copies_)
      copy->world.move(object.id, object.X_WO);
  }

  bool is_enabled(const Object& a, const Object& b) const {
    return enabled_groups_[static_cast<std::size_t>(a.group)][static_cast<std::size_t>(b.group)] &&
           !disabled_pairs_.contains(std::minmax({a.id, b.id}));
  }

  std::vector<Answer> brute_force() {
    std::vector<const Object*> by_slot;
    for (const Object& object : objects_)
      by_slot.push_back(&object);
    std::sort(by_slot.begin(), by_slot.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < by_slot.size(); ++i) {
      for (std::size_t j = i + 1; j < by_slot.size(); ++j) {
        if (is_enabled(*by_slot[i], *by_slot[j])) ask(*by_slot[i], *by_slot[j], answers);
      }
    }
    return answers;
  }

  void ask(const Object& a, const Object& b, std::vector<Answer>& answers) {
    // As the world has them: made rotations.
    const Isometry3d X_AB = geometry::rigid_pose(a.X_WO)->inverse(Eigen::Isometry) * *geometry::rigid_pose(b.X_WO);
    if (!intersects(*a.shape.tree, *b.shape.tree, X_AB, workspace_, distance_)) return;
    Answer answer{{a.id, b.id}, {}, {}};
    if (options_.query == PairQuery::kTrianglePairs)
      intersecting_pairs(*a.shape.tree, *b.shape.tree, X_AB, workspace_, answer.triangle_pairs, distance_);
    if (options_.query == PairQuery::kClosePairs)
      pairs_within(*a.shape.tree, *b.shape.tree, X_AB, distance_, workspace_, answer.close_pairs);
    answers.push_back(answer);
  }

  static bool same(const ClosePair& u, const ClosePair& v) {
    return u.triangles == v.triangles && u.distance == v.distance && u.p_A == v.p_A && u.p_B == v.p_B;
  }

  static std::string compare(const std::vector<Answer>& expected, const FrameResult& result) {
    if (expected.size() != result.meeting.size()) {
      return std::to_string(result.meeting.size()) + " pairs of objects instead of " + std::to_string(expected.size());
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i].objects != result.meeting[i]) return "another pair of objects";
      if (!std::ranges::equal(expected[i].triangle_pairs, result.triangle_pairs(i))) return "other triangles";
      if (!std::ranges::equal(expected[i].close_pairs, result.close_pairs(i), same)) return "other close pairs";
    }
    return "";
  }

  std::string description() const {
    return "\n  " + std::to_string(objects_.size()) + " objects, query " +
           std::to_string(static_cast<int>(options_.query)) + ", distance " + std::to_string(distance_) + ", size " +
           std::to_string(scale_);
  }

  RandomNumbers random_;
  realtime::SteadyClock clock_;
  PipelineOptions options_;
  std::vector<std::unique_ptr<Copy>> copies_;
  double scale_ = 1.0;  // about the size of an object, metres
  double room_ = 1.0;
  Vector3d origin_ = Vector3d::Zero();
  double distance_ = 0.0;
  std::vector<Shape> shapes_;
  std::vector<Object> objects_;
  std::array<std::array<bool, kGroups>, kGroups> enabled_groups_{
      {{true, true, true, true}, {true, true, true, true}, {true, true, true, true}, {true, true, true, true}}};
  std::set<std::pair<ObjectId, ObjectId>> disabled_pairs_;
  std::ptrdiff_t meeting_before_ = 0;
  QueryWorkspace workspace_;
};

void print(const Counts& counts, double seconds) {
  const auto each = [&](std::int64_t count) { return static_cast<double>(count) / static_cast<double>(counts.frames); };
  std::printf(
      "%lld frames at 1, 2 and 4 threads: %.1f objects and %.1f meeting pairs each, %lld edits, %lld frames with "
      "another number of meeting pairs, %.1f s\n",
      static_cast<long long>(counts.frames), each(counts.objects), each(counts.meeting),
      static_cast<long long>(counts.edits), static_cast<long long>(counts.changes), seconds);
  std::printf("verdicts %lld, triangle pairs %lld, close pairs %lld\n", static_cast<long long>(counts.queries[0]),
              static_cast<long long>(counts.queries[1]), static_cast<long long>(counts.queries[2]));
}

bool sweep(const SweepArguments& arguments) {
  const bool one = arguments.only_case >= 0;
  const std::int64_t scenes = (arguments.count + kFramesPerScene - 1) / kFramesPerScene;
  const Stopwatch watch;
  Counts counts;
  SweepDifferences differences;
  for (std::int64_t s = one ? arguments.only_case : 0;
       (one ? s == arguments.only_case : s < scenes) && watch.seconds() < arguments.seconds; ++s) {
    Scene scene(arguments.seed, s);
    for (int i = 0; i < kFramesPerScene; ++i) {
      const std::string difference = scene.frame(counts);
      if (difference.empty()) continue;
      differences.add(difference + "\n  --seed " + std::to_string(arguments.seed) + " --only-case " +
                      std::to_string(s) + ", frame " + std::to_string(i));
      break;
    }
  }
  print(counts, watch.seconds());
  differences.print();
  return differences.count() == 0;
}

}  // namespace
}  // namespace glissade::collision

int main(int argc, char** argv) {
  return glissade::test_support::run_sweep(argc, argv,
                                           "Compares the collision pipeline with brute force over all pairs", "frames",
                                           10'000, glissade::collision::sweep);
}
