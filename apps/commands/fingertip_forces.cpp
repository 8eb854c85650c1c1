#include <algorithm>
#include <numeric>
#include <span>

#include <glissade/apps/commands/fingertip_forces.h>
#include <glissade/devices/simulated_glove.h>
#include <glissade/grasping/grasp_simulation.h>

namespace glissade::apps {
namespace {

/// The joint that turns the last segment of each finger alone, by its number in `devices::kGloveJointNames`.
constexpr std::array<std::size_t, kFingers> kLastJoints{2, 6, 9, 13, 17};
static_assert(devices::kGloveJointNames[2] == "thumb_ip" && devices::kGloveJointNames[6] == "index_dip" &&
              devices::kGloveJointNames[9] == "middle_dip" && devices::kGloveJointNames[13] == "ring_dip" &&
              devices::kGloveJointNames[17] == "little_dip");

/// The force (N) of each row, at least zero, so that the torques of all come nearest to `left`: by projected
/// Gauss–Seidel sweeps from zero.
std::array<double, haptics::kMaxFingerRows> forces_of(std::span<const haptics::FingerRow> rows,
                                                      devices::JointValues left) {
  constexpr int kSweeps = 100;
  std::array<double, haptics::kMaxFingerRows> forces{};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const devices::JointValues& rates = rows[i].rates;
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

FingertipForces::FingertipForces(const grasping::HandModel& hand)
    : springs_(grasping::finger_hand(hand).limits, devices::simulated_glove_descriptor()) {}

std::array<double, kFingers> FingertipForces::update(const devices::JointValues& targets,
                                                     const haptics::HandAnswer& hand) {
  const std::span<const haptics::FingerRow> rows = hand.rows();
  const std::array<double, haptics::kMaxFingerRows> forces = forces_of(rows, springs_.update(targets, hand));
  std::array<double, kFingers> of_tips{};
  for (std::size_t finger = 0; finger < kFingers; ++finger) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].rates[kLastJoints[finger]] != 0.0) of_tips[finger] += forces[i];
    }
  }
  return of_tips;
}

}  // namespace glissade::apps
