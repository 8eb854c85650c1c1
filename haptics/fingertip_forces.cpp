#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include <glissade/haptics/finger_forces.h>

#include "loop/finger_rows.h"

namespace glissade::haptics {
namespace {

/// The joint that turns the last segment of each finger alone, by its number in `hands::kJointNames`.
constexpr std::array<std::size_t, kFingers> kLastJoints{2, 6, 9, 13, 17};
static_assert(hands::kJointNames[2] == "thumb_ip" && hands::kJointNames[6] == "index_dip" &&
              hands::kJointNames[9] == "middle_dip" && hands::kJointNames[13] == "ring_dip" &&
              hands::kJointNames[17] == "little_dip");

/// The force (N) of each row, at least zero, so that the torques of all come nearest to `left`: by projected
/// Gauss–Seidel sweeps from zero.
std::array<double, kMaxFingerRows> forces_of(std::span<const FingerRow> rows, hands::JointValues left) {
  constexpr int kSweeps = 100;
  std::array<double, kMaxFingerRows> forces{};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const hands::JointValues& rates = rows[i].rates;
      const double square = std::inner_product(rates.begin(), rates.end(), rates.begin(), 0.0);
      if (square == 0.0) continue;
      const double wanted = std::inner_product(rates.begin(), rates.end(), left.begin(), 0.0) / square;
      const double force = std::max(0.0, forces[i] + wanted);
      for (std::size_t j = 0; j < left.size(); ++j)
        left[j] -= (force - forces[i]) * rates[j];
      forces[i] = force;
    }
  }
  return forces;
}

}  // namespace

HandAnswer answer_of(const grasping::GraspSimulation& simulation, std::size_t hand) {
  HandAnswer answer;
  FingerRows().tell(simulation, hand, answer);
  return answer;
}

std::array<double, kFingers> FingertipForces::update(const hands::JointValues& targets, const HandAnswer& hand) {
  const std::span<const FingerRow> rows = hand.rows();
  const std::array<double, kMaxFingerRows> forces = forces_of(rows, springs_.update(targets, hand));
  std::array<double, kFingers> of_tips{};
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].rates[kLastJoints[finger]] != 0.0) of_tips[finger] += forces[i];
    }
  }
  return of_tips;
}

}  // namespace glissade::haptics
