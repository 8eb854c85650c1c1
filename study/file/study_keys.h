#pragma once

/// The keys of study files, in one array for each kind of map. docs/studies.md describes each key.

#include <array>
#include <string_view>

namespace glissade::study {

inline constexpr std::array<std::string_view, 12> kStudyKeys{"scene",    "part",    "trajectory", "parameters",
                                                             "sampling", "pilot",   "slides",     "half_width",
                                                             "seed",     "success", "sliding",    "record"};
inline constexpr std::array<std::string_view, 4> kDistributionKeys{"uniform", "normal", "triangular", "one_of"};
inline constexpr std::array<std::string_view, 8> kParameterKeys{"name",       "vary",   "uniform", "normal",
                                                                "triangular", "one_of", "within",  "steps"};
inline constexpr std::array<std::string_view, 5> kSuccessKeys{"distance_m", "angle_deg", "force_N", "torque_Nm",
                                                              "clearance_m"};
inline constexpr std::array<std::string_view, 5> kSlidingKeys{"metaphor", "stiffness_N_per_m", "friction",
                                                              "spiral_search", "depenetrate"};

}  // namespace glissade::study
