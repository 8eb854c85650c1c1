#include "adroit_hand.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <glissade/geometry/mesh_generators.h>

#include "poses.h"

namespace glissade::test_support {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using grasping::ChainLink;
using grasping::Finger;
using grasping::FlexValue;
using grasping::HandSegment;
using grasping::SegmentMeaning;
using Mesh = std::shared_ptr<const geometry::TriangleMesh>;

constexpr SegmentMeaning kPalm{Finger::kNone, HandSegment::kPalm};

class AdroitBuilder {
 public:
  explicit AdroitBuilder(double margin_m) : margin_m_(margin_m) {}

  std::size_t add_palm(geometry::TriangleMesh mesh) {
    links_.push_back({.name = "palm", .mesh = std::make_shared<geometry::TriangleMesh>(std::move(mesh))});
    meaning_[0] = kPalm;
    return 0;
  }

  /// The link turns with the flex value of its name.
  std::size_t add(const std::string& joint, std::size_t parent, const Isometry3d& X_PJ, const Vector3d& axis_J,
                  const SegmentMeaning& meaning = {}, Mesh mesh = nullptr) {
    values_.push_back({joint, -std::numbers::pi, std::numbers::pi});
    links_.push_back({.name = joint,
                      .parent = parent,
                      .X_PJ = X_PJ,
                      .axis_J = axis_J.normalized(),
                      .terms = {{values_.size() - 1, 1.0}},
                      .mesh = std::move(mesh)});
    meaning_[links_.size() - 1] = meaning;
    return links_.size() - 1;
  }

  void add_finger(const std::string& letters, Finger finger, std::size_t parent, const Vector3d& p_Parent_Knuckle) {
    const Isometry3d knuckle = at(p_Parent_Knuckle.x(), p_Parent_Knuckle.y(), p_Parent_Knuckle.z());
    std::size_t link = add(letters + "J3", parent, knuckle, Vector3d::UnitY());
    link = add(letters + "J2", link, at(0.0), Vector3d::UnitX(), {finger, HandSegment::kInner}, capsule(0.045, 0.01));
    link = add(letters + "J1", link, at(0.0, 0.0, 0.045), Vector3d::UnitX(), {finger, HandSegment::kMiddle},
               capsule(0.025, 0.00805));
    add(letters + "J0", link, at(0.0, 0.0, 0.025), Vector3d::UnitX(), {finger, HandSegment::kOuter},
        capsule(0.024, 0.00705));
  }

  void add_thumb(std::size_t palm) {
    Isometry3d base = at(0.034, -0.009, 0.029);
    base.rotate(AngleAxisd(0.785, Vector3d::UnitY()));
    std::size_t link = add("THJ4", palm, base, -Vector3d::UnitZ());
    link = add("THJ3", link, at(0.0), Vector3d::UnitX(), {Finger::kThumb, HandSegment::kInner}, capsule(0.038, 0.013));
    link = add("THJ2", link, at(0.0, 0.0, 0.038), Vector3d::UnitX());
    link = add("THJ1", link, at(0.0), Vector3d::UnitY(), {Finger::kThumb, HandSegment::kMiddle}, capsule(0.032, 0.011));
    add("THJ0", link, at(0.0, 0.0, 0.032), Vector3d::UnitY(), {Finger::kThumb, HandSegment::kOuter},
        capsule(0.026, 0.00918));
  }

  geometry::TriangleMesh box(const Vector3d& centre, const Vector3d& half_size) const {
    const Vector3d size = 2.0 * (half_size + Vector3d::Constant(margin_m_));
    return geometry::transformed(geometry::make_box(size, 12), at(centre.x(), centre.y(), centre.z()));
  }

  grasping::HandModel hand() const { return {{}, grasping::KinematicChain(values_, links_), meaning_}; }

 private:
  /// From the origin to `length` along z.
  Mesh capsule(double length, double radius) const {
    constexpr int kSteps = 6;
    std::vector<Eigen::Vector2d> profile;
    for (int end = 0; end < 2; ++end) {
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = 0.5 * std::numbers::pi * (end == 0 ? i - kSteps : i) / kSteps;
        const bool is_on_axis = i == (end == 0 ? 0 : kSteps);
        profile.emplace_back(is_on_axis ? 0.0 : (radius + margin_m_) * std::cos(angle),
                             end * length + (radius + margin_m_) * std::sin(angle));
      }
    }
    return std::make_shared<geometry::TriangleMesh>(geometry::make_revolution(profile, false, 24));
  }

  double margin_m_;
  std::vector<FlexValue> values_;
  std::vector<ChainLink> links_;
  std::array<SegmentMeaning, grasping::kHandLinks> meaning_{};
};

}  // namespace

std::shared_ptr<const grasping::HandModel> make_adroit_hand(double margin_m) {
  AdroitBuilder builder(margin_m);
  const std::size_t palm =
      builder.add_palm(geometry::merge(std::vector{builder.box({0.011, 0.0, 0.038}, {0.032, 0.0111, 0.049}),
                                                   builder.box({-0.032, 0.0, 0.014}, {0.011, 0.0111, 0.025})}));
  builder.add_finger("FF", Finger::kIndex, palm, {0.033, 0.0, 0.095});
  builder.add_finger("MF", Finger::kMiddle, palm, {0.011, 0.0, 0.099});
  builder.add_finger("RF", Finger::kRing, palm, {-0.011, 0.0, 0.095});
  const std::size_t metacarpal =
      builder.add("LFJ4", palm, at(-0.017, 0.0, 0.044), {0.571, 0.0, 0.821}, kPalm,
                  std::make_shared<geometry::TriangleMesh>(builder.box({-0.0165, 0.0, 0.01}, {0.0095, 0.0111, 0.025})));
  builder.add_finger("LF", Finger::kLittle, metacarpal, {-0.017, 0.0, 0.044});
  builder.add_thumb(palm);
  return std::make_shared<const grasping::HandModel>(builder.hand());
}

grasping::Posture adroit_posture(const AdroitRow& row) {
  return {adroit_palm(row), {row.joints.begin() + 2, row.joints.end()}};
}

}  // namespace glissade::test_support
