#include "hand/segment_meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "hand/loft.h"

namespace glissade::grasping {
namespace {

constexpr double kFingerCorner = 2.15;
constexpr double kPalmCorner = 2.4;
constexpr int kAroundFinger = 16;
constexpr int kAroundPalm = 16;

/// A section of a metacarpal in ratios: x of the bone's length, all others of the hand's breadth.
struct MetacarpalSection {
  double x;
  double y;
  double width;
  double up;
  double down;
};

geometry::TriangleMesh metacarpal_mesh(const std::vector<MetacarpalSection>& ratios, double length, double breadth,
                                       double end_cap) {
  std::vector<LoftSection> sections;
  for (const MetacarpalSection& r : ratios)
    sections.push_back({r.x * length, r.y * breadth, 0.0, r.width * breadth, r.up * breadth, r.down * breadth});
  return loft(sections, 0.8 * sections.front().width, end_cap * breadth, kPalmCorner, kAroundFinger);
}

}  // namespace

geometry::TriangleMesh phalanx_mesh(double length, double start_radius, double end_radius) {
  std::vector<LoftSection> sections;
  for (const double t : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    const double radius = std::lerp(start_radius, end_radius, t);
    const double middle = std::sin(std::numbers::pi * t);  // waist above and at the sides, flesh below
    sections.push_back({t * length, 0.0, 0.0, radius * (1.0 - 0.05 * middle),
                        radius * (kFingerFlatness - 0.10 * middle), radius * (kFingerFlatness + 0.05 * middle)});
  }
  return loft(sections, kFingerFlatness * start_radius, kFingerFlatness * end_radius, kFingerCorner, kAroundFinger);
}

geometry::TriangleMesh fingertip_mesh(double length, double radius) {
  struct TipSection {
    double x, width, up, down;  // x is a ratio of the length without the cap, the others of the radius
  };
  const double cap = std::min(0.95 * radius, 0.5 * length);
  std::vector<LoftSection> sections;
  for (const TipSection& r : {TipSection{0.0, 1.0, kFingerFlatness, kFingerFlatness},
                              {0.35, 0.98, 0.82, 0.98},
                              {0.7, 0.98, 0.72, 1.05},
                              {1.0, 0.92, 0.64, 0.98}}) {
    sections.push_back({r.x * (length - cap), 0.0, 0.0, r.width * radius, r.up * radius, r.down * radius});
  }
  return loft(sections, kFingerFlatness * radius, cap, kFingerCorner, kAroundFinger);
}

geometry::TriangleMesh thumb_metacarpal_mesh(double length, double hand_breadth) {
  return metacarpal_mesh({{0.0, 0.0, 0.14, 0.10, 0.16},
                          {0.15, 0.0, 0.18, 0.11, 0.20},
                          {0.4, 0.0, 0.20, 0.115, 0.22},
                          {0.65, 0.0, 0.175, 0.11, 0.19},
                          {0.85, 0.0, 0.14, 0.108, 0.14},
                          {1.0, 0.0, 0.12, 0.111, 0.111}},
                         length, hand_breadth, 0.111);
}

geometry::TriangleMesh ring_metacarpal_mesh(double length, double hand_breadth) {
  return metacarpal_mesh({{0.0, 0.0, 0.14, 0.15, 0.17},
                          {0.3, 0.0, 0.14, 0.145, 0.17},
                          {0.6, 0.0, 0.135, 0.135, 0.16},
                          {0.85, 0.0, 0.125, 0.122, 0.148},
                          {1.0, 0.0, 0.115, 0.112, 0.135}},
                         length, hand_breadth, 0.112);
}

geometry::TriangleMesh little_metacarpal_mesh(double length, double hand_breadth) {
  return metacarpal_mesh({{0.0, -0.02, 0.17, 0.14, 0.18},
                          {0.3, -0.02, 0.165, 0.135, 0.19},
                          {0.6, -0.01, 0.145, 0.125, 0.17},
                          {0.85, 0.0, 0.12, 0.113, 0.14},
                          {1.0, 0.0, 0.105, 0.102, 0.12}},
                         length, hand_breadth, 0.102);
}

geometry::TriangleMesh palm_mesh(double hand_length, double hand_breadth) {
  struct PalmSection {
    double x, thumb_side, little_side, up, down;  // x / length, the others / breadth
  };
  std::vector<LoftSection> sections;
  for (const PalmSection& r : {PalmSection{0.0, 0.31, -0.33, 0.165, 0.19},
                               {0.07, 0.345, -0.37, 0.165, 0.205},
                               {0.15, 0.35, -0.34, 0.155, 0.20},
                               {0.25, 0.35, -0.27, 0.145, 0.18},
                               {0.34, 0.36, -0.205, 0.135, 0.165},
                               {0.41, 0.37, -0.155, 0.122, 0.148},
                               {0.45, 0.36, -0.12, 0.112, 0.13}}) {
    sections.push_back({r.x * hand_length, (r.thumb_side + r.little_side) / 2 * hand_breadth, 0.0,
                        (r.thumb_side - r.little_side) / 2 * hand_breadth, r.up * hand_breadth, r.down * hand_breadth});
  }
  return loft(sections, 0.04 * hand_length, 0.13 * hand_breadth, kPalmCorner, kAroundPalm);
}

}  // namespace glissade::grasping
