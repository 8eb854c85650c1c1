#pragma once

/// Measures of a hand. Lengths along the hand are ratios of its length HL, those across it of its breadth HB
/// (B. Buchholz et al., Ergonomics 35, 1992; K. N. An et al., J. Biomechanics 12, 1979). Right hand, axes of the palm.

#include <array>
#include <numbers>

namespace glissade::grasping {

inline constexpr double kDegree = std::numbers::pi / 180.0;

struct FingerProportions {
  double metacarpal;  ///< lengths / HL
  double proximal;
  double middle;
  double distal;             ///< to the tip of the skin
  double mcp_x;              ///< centre of the MCP joint / HL
  double mcp_y;              ///< the same / HB
  double proximal_diameter;  ///< diameters / HB
  double middle_diameter;
  double distal_diameter;
};

/// Index, middle, ring and little finger.
inline constexpr std::array<FingerProportions, 4> kFingerProportions{
    {{.378, .265, .143, .097, .447, .252, .229, .198, .176},
     {.373, .277, .170, .108, .446, .000, .216, .197, .180},
     {.338, .259, .165, .107, .409, -.206, .203, .182, .168},
     {.306, .206, .117, .093, .368, -.402, .183, .165, .149}}};

inline constexpr double kCmc_x = .073;  ///< centres of all CMC joints / HL

inline constexpr double kThumbCmc_y = .196;  ///< / HB
inline constexpr double kThumbMetacarpal_HL = .251;
inline constexpr double kThumbProximal_HL = .196;
inline constexpr double kThumbDistal_HL = .158;
inline constexpr double kThumbBaseDiameter = .438;  ///< / HB, with the ball of the thumb
inline constexpr double kThumbProximalDiameter = .229;
inline constexpr double kThumbDistalDiameter = .212;

/// The thumb rolls about an axis that runs from its CMC joint obliquely across the palm. Rolled by 0, it lies in front
/// of the plane of the palm by this angle.
inline constexpr double kThumbRollAxisTilt = 15.0 * kDegree;
inline constexpr double kThumbRollOffset = 20.0 * kDegree;
/// The hinges of the thumb's outer joints are turned about the bone, so that it bends across the palm.
inline constexpr double kThumbPronation = 20.0 * kDegree;

/// How far the ring finger's metacarpal turns with that of the little finger.
inline constexpr double kRingArchFactor = 0.5;

}  // namespace glissade::grasping
