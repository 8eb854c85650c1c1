#pragma once

/// Hands, a ball and a wall in a simulation of grasps, which is checked in each call by code that shares nothing with
/// the trees.

#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <glissade/geometry/displacement.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/grasping/grasp_simulation.h>
#include <glissade/reference/grid_check.h>

#include "clasped_hand.h"
#include "poses.h"
#include "sanitizers.h"

namespace glissade::grasping {

inline constexpr double kBallRadius_m = 0.035;

/// A ball before the palm of the hand that has its root at the origin, and a wall beyond it: at x = 0.25 m.
class HandAndBall {
 public:
  explicit HandAndBall(std::size_t hands = 1, double wall_x = 0.25,
                       contact::Metaphor metaphor = contact::Metaphor::kForceFeedback)
      : ball_(std::make_shared<const geometry::TriangleMesh>(geometry::make_sphere(kBallRadius_m, 2000))),
        wall_(std::make_shared<const geometry::TriangleMesh>(geometry::make_box({0.02, 0.6, 0.6}, 2000))),
        X_WWall_(test_support::at(wall_x, 0.0, 0.0)),
        wall_check_({{wall_, X_WWall_}}),
        ball_check_({{ball_, Eigen::Isometry3d::Identity()}}),
        simulation({{std::make_shared<const contact::ContactBody>(wall_), X_WWall_, "the wall"}},
                   {{.part_V = std::make_shared<const contact::SlidingPart>(ball_),
                     .X_WV_start = test_support::at(0.095, 0.0, -0.056),
                     .metaphor = metaphor}},
                   std::vector<std::shared_ptr<const HandModel>>(hands, test_support::hand_model()), rules()),
        targets_(hands) {}

 private:
  /// Of a call with two steps at most, the way of a part is known.
  static GraspRules rules() {
    GraspRules rules;
    rules.sliding.max_cycles = 2;
    return rules;
  }

  std::shared_ptr<const geometry::TriangleMesh> ball_;
  std::shared_ptr<const geometry::TriangleMesh> wall_;
  Eigen::Isometry3d X_WWall_;
  reference::GridCheck wall_check_;
  reference::GridCheck ball_check_;  // in the frame of the ball

 public:
  GraspSimulation simulation;

  void advance(const Posture& target) {
    targets_[0] = target;
    advance();
  }
  void lose() {
    targets_[0].reset();
    advance();
  }
  std::optional<Posture>& target(std::size_t hand) { return targets_[hand]; }
  void advance() {
    const State before = state();
    simulation.advance(targets_);
    if (++calls_ % kStride != 0) return;
    ASSERT_FALSE(collides());
    ASSERT_FALSE(has_collided_since(before));
  }

  Eigen::Isometry3d X_WV() const { return simulation.parts().result(0).X_WV; }
  double force() const {
    const geometry::Displacement lag = simulation.parts().lag(0);
    return simulation.parts().stiffness(0).translational * lag.v.norm();
  }

  /// By a check without code of the trees: hands against ball and wall, ball against wall.
  bool collides() const {
    bool collides = wall_check_.collides(*ball_, X_WV());
    for (std::size_t h = 0; h < simulation.hand_count(); ++h)
      collides = collides || (is_present(simulation.activity(h)) && hand_collides(simulation.posture(h), X_WV()));
    return collides;
  }

 private:
  static constexpr int kPlaces = 3;                                  // looked at in each step
  static constexpr int kStride = test_support::kSanitized ? 10 : 1;  // of the calls that are looked at

  struct State {
    Eigen::Isometry3d X_WV;
    Eigen::Vector3d p_Vref;
    std::vector<Posture> hands;  ///< those that are nowhere are without values
    std::vector<bool> holds;
  };

  State state() const {
    State state{X_WV(), simulation.parts().p_Vref(0), std::vector<Posture>(simulation.hand_count()), {}};
    for (std::size_t h = 0; h < state.hands.size(); ++h) {
      state.holds.push_back(simulation.held_part(h).has_value());
      if (is_present(simulation.activity(h))) state.hands[h] = simulation.posture(h);
    }
    return state;
  }

  bool hand_collides(const Posture& posture, const Eigen::Isometry3d& X_WB) const {
    std::vector<Eigen::Isometry3d> X_WL(test_support::hand_chain()->links().size());
    test_support::hand_chain()->poses(posture.X_WR, posture.values, X_WL);
    for (std::size_t link = 0; link < X_WL.size(); ++link) {
      const auto& mesh = test_support::hand_chain()->links()[link].mesh;
      if (mesh == nullptr) continue;
      if (wall_check_.collides(*mesh, X_WL[link])) return true;
      if (ball_check_.collides(*mesh, X_WB.inverse(Eigen::Isometry) * X_WL[link])) return true;
    }
    return false;
  }

  /// The same on the ways of the last call. First the ball moves, with the hands that hold it, among the hands that do
  /// not; then the hands move.
  bool has_collided_since(const State& before) const {
    const contact::SlidingResult& ball = simulation.parts().result(0);
    const bool has_moved = !ball.X_WV.isApprox(before.X_WV, 0.0);
    if (has_moved && (ball_has_collided(before, before.X_WV, ball.X_WV_before_step) ||
                      ball_has_collided(before, ball.X_WV_before_step, ball.X_WV)))
      return true;
    for (std::size_t h = 0; h < before.hands.size(); ++h) {
      if (!targets_[h] || before.hands[h].values.empty()) continue;
      Posture from = carried(h, before, X_WV());
      for (const Posture& to : simulation.clasp(h).way()) {
        for (int place = 1; place <= kPlaces; ++place) {
          if (hand_collides(test_support::between(from, to, static_cast<double>(place) / kPlaces), X_WV())) return true;
        }
        from = to;
      }
    }
    return false;
  }

  bool ball_has_collided(const State& before, const Eigen::Isometry3d& X_WV_from,
                         const Eigen::Isometry3d& X_WV_to) const {
    const geometry::Displacement d = geometry::displacement_between(X_WV_from, X_WV_to, before.p_Vref);
    for (int place = 1; place <= kPlaces; ++place) {
      const Eigen::Isometry3d X_WB =
          geometry::displaced(X_WV_from, before.p_Vref, d.scaled(static_cast<double>(place) / kPlaces));
      if (wall_check_.collides(*ball_, X_WB)) return true;
      for (std::size_t h = 0; h < before.hands.size(); ++h) {
        if (!before.hands[h].values.empty() && hand_collides(carried(h, before, X_WB), X_WB)) return true;
      }
    }
    return false;
  }

  /// Where the ball has brought the hand. (No target of these tests moves the wrist of a hand that holds it.)
  Posture carried(std::size_t h, const State& before, const Eigen::Isometry3d& X_WB) const {
    Posture posture = before.hands[h];
    if (before.holds[h]) posture.X_WR = X_WB * before.X_WV.inverse(Eigen::Isometry) * posture.X_WR;
    return posture;
  }

  std::vector<std::optional<Posture>> targets_;
  int calls_ = 0;
};

}  // namespace glissade::grasping
