// Frames of game engines. Both are mirror images of W, so a rotation by an angle about an axis becomes one by the same
// angle about the negative of the mirrored axis.

#include <cstdint>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "call.h"
#include "convert.h"

namespace glissade::c {

namespace {

struct EngineFrame {
  Eigen::Matrix3d axes;  // from W to the engine: orthogonal, with determinant −1
  double units_per_m;
};

EngineFrame frame_of(std::int32_t engine) {
  Eigen::Matrix3d axes;
  switch (engine) {
    case GLISSADE_UNITY:
      axes << 0, -1, 0, 0, 0, 1, 1, 0, 0;
      return {axes, 1.0};
    case GLISSADE_UNREAL:
      axes << 1, 0, 0, 0, -1, 0, 0, 0, 1;
      return {axes, 100.0};
  }
  throw std::invalid_argument("engine is " + std::to_string(engine) +
                              ", but must be GLISSADE_UNITY (0) or GLISSADE_UNREAL (1)");
}

GlissadePose turned(const GlissadePose& pose, const Eigen::Matrix3d& axes, double scale) {
  const Eigen::Isometry3d checked = pose_of(pose, "pose");  // only the check: the signs of the quaternion stay
  const Eigen::Vector3d p = scale * (axes * checked.translation());
  const Eigen::Vector3d axis = -(axes * Eigen::Vector3d(pose.qx, pose.qy, pose.qz));
  return {p.x(), p.y(), p.z(), pose.qw, axis.x(), axis.y(), axis.z()};
}

void turn(const double* vector, const char* argument, const Eigen::Matrix3d& axes, double* out) {
  const Eigen::Vector3d turned = axes * vector_of(&at(vector, argument), argument);
  Eigen::Map<Eigen::Vector3d>(&at(out, "out")) = turned;
}

}  // namespace

}  // namespace glissade::c

using namespace glissade::c;

GlissadeStatus glissade_pose_to_engine(int32_t engine, const GlissadePose* pose, GlissadePose* out) {
  return call([&] {
    const EngineFrame frame = frame_of(engine);
    at(out, "out") = turned(at(pose, "pose"), frame.axes, frame.units_per_m);
  });
}

GlissadeStatus glissade_pose_from_engine(int32_t engine, const GlissadePose* pose, GlissadePose* out) {
  return call([&] {
    const EngineFrame frame = frame_of(engine);
    at(out, "out") = turned(at(pose, "pose"), frame.axes.transpose(), 1.0 / frame.units_per_m);
  });
}

GlissadeStatus glissade_vector_to_engine(int32_t engine, const double vector[3], double out[3]) {
  return call([&] { turn(vector, "vector", frame_of(engine).axes, out); });
}

GlissadeStatus glissade_vector_from_engine(int32_t engine, const double vector[3], double out[3]) {
  return call([&] { turn(vector, "vector", frame_of(engine).axes.transpose(), out); });
}

GlissadeStatus glissade_torque_to_engine(int32_t engine, const double torque[3], double out[3]) {
  return call([&] { turn(torque, "torque", -frame_of(engine).axes, out); });
}

GlissadeStatus glissade_torque_from_engine(int32_t engine, const double torque[3], double out[3]) {
  return call([&] { turn(torque, "torque", -frame_of(engine).axes.transpose(), out); });
}
