#include "ode_reference.h"

#include <array>
#include <cmath>
#include <cstdarg>

#include <ode/ode.h>

#include <glissade/contact/spring.h>

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kStep_s = 1e-3;
constexpr double kErp = 0.2;
constexpr double kCfm = 1e-9;
constexpr double kMass_kg = 1.0;
constexpr double kAtRest_m_per_s = 1e-9;
constexpr double kPartSize_m = 0.1;
constexpr int kMostContacts = 16;

void keep_ode_alive() {
  struct Session {
    Session() {
      dInitODE2(0);
      // The solver's message about redundant contacts, such as four feet on a plane; it then drops one of them.
      dSetMessageHandler([](int, const char*, va_list) {});
    }
    ~Session() { dCloseODE(); }
  };
  static const Session session;
}

void place(dGeomID geom, const Isometry3d& X_W) {
  dMatrix3 rotation = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rotation[4 * row + column] = X_W(row, column);
  }
  dGeomSetRotation(geom, rotation);
  dGeomSetPosition(geom, X_W(0, 3), X_W(1, 3), X_W(2, 3));
}

Vector3d vector(const dReal* x) {
  return {x[0], x[1], x[2]};
}

}  // namespace

struct OdeHeldPart::State {
  dWorldID world = nullptr;
  dJointGroupID joints = nullptr;
  dBodyID body = nullptr;
  dGeomID part = nullptr;
  std::vector<dGeomID> obstacles;
  contact::CouplingStiffness stiffness{};
  double inertia = 0.0;
  double friction = 0.0;
  Vector3d slip_W;
  std::vector<std::unique_ptr<dJointFeedback>> feedback;  // of the contacts of the last step

  void pull(const Isometry3d& X_WV, const Isometry3d& X_WG) const;
  void touch(dGeomID obstacle);
};

OdeHeldPart::OdeHeldPart(const OdeWorld& world, const OdePart& part, const contact::CouplingStiffness& stiffness,
                         const Isometry3d& X_WV)
    : state_(std::make_unique<State>()) {
  keep_ode_alive();
  State& s = *state_;
  s.stiffness = stiffness;
  s.inertia = kMass_kg * stiffness.rotational / stiffness.translational;
  s.friction = world.friction;
  s.slip_W = world.slip_W;
  s.world = dWorldCreate();
  dWorldSetERP(s.world, kErp);
  dWorldSetCFM(s.world, kCfm);
  s.joints = dJointGroupCreate(0);
  s.body = dBodyCreate(s.world);
  dMass mass;
  dMassSetParameters(&mass, kMass_kg, 0, 0, 0, s.inertia, s.inertia, s.inertia, 0, 0, 0);
  dBodySetMass(s.body, &mass);
  s.part = part.radius > 0.0 ? dCreateSphere(nullptr, part.radius)
                             : dCreateBox(nullptr, part.size.x(), part.size.y(), part.size.z());
  dGeomSetBody(s.part, s.body);
  place(s.part, X_WV);
  for (const OdePlane& plane : world.planes)
    s.obstacles.push_back(dCreatePlane(nullptr, plane.n.x(), plane.n.y(), plane.n.z(), plane.d));
  for (const OdeBox& box : world.boxes) {
    s.obstacles.push_back(dCreateBox(nullptr, box.size.x(), box.size.y(), box.size.z()));
    place(s.obstacles.back(), box.X_W);
  }
}

OdeHeldPart::~OdeHeldPart() {
  dJointGroupDestroy(state_->joints);
  for (const dGeomID obstacle : state_->obstacles)
    dGeomDestroy(obstacle);
  dGeomDestroy(state_->part);
  dWorldDestroy(state_->world);
}

/// Spring to the ghost and damper to the world.
void OdeHeldPart::State::pull(const Isometry3d& X_WV, const Isometry3d& X_WG) const {
  const geometry::Displacement error = geometry::displacement_between(X_WV, X_WG, Vector3d::Zero());
  const Vector3d f = stiffness.translational * error.v -
                     2.0 * std::sqrt(stiffness.translational * kMass_kg) * vector(dBodyGetLinearVel(body));
  const Vector3d t = stiffness.rotational * error.w -
                     2.0 * std::sqrt(stiffness.rotational * inertia) * vector(dBodyGetAngularVel(body));
  dBodyAddForce(body, f.x(), f.y(), f.z());
  dBodyAddTorque(body, t.x(), t.y(), t.z());
}

void OdeHeldPart::State::touch(dGeomID obstacle) {
  std::array<dContact, kMostContacts> contacts{};
  const int count = dCollide(part, obstacle, kMostContacts, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& contact = contacts[static_cast<std::size_t>(i)];
    if (friction > 0.0) {
      contact.surface.mode = dContactApprox1 | dContactFDir1;
      contact.surface.mu = friction;
      const Vector3d n = vector(contact.geom.normal);
      const Vector3d along = (slip_W - n.dot(slip_W) * n).normalized();
      for (int k = 0; k < 3; ++k)
        contact.fdir1[k] = along[k];
    }
    const dJointID joint = dJointCreateContact(world, joints, &contact);
    dJointAttach(joint, body, nullptr);
    feedback.push_back(std::make_unique<dJointFeedback>());
    dJointSetFeedback(joint, feedback.back().get());
  }
}

void OdeHeldPart::step(const Isometry3d& X_WG) {
  State& s = *state_;
  dJointGroupEmpty(s.joints);
  s.feedback.clear();
  s.pull(X_WV(), X_WG);
  for (const dGeomID obstacle : s.obstacles)
    s.touch(obstacle);
  dWorldStep(s.world, kStep_s);
}

std::optional<int> OdeHeldPart::settle(const Isometry3d& X_WG, int most_steps) {
  int still = 0;
  for (int i = 1; i <= most_steps; ++i) {
    step(X_WG);
    const double fastest = speed() + kPartSize_m * vector(dBodyGetAngularVel(state_->body)).norm();
    still = fastest < kAtRest_m_per_s ? still + 1 : 0;
    if (still == 20) return i;
  }
  return std::nullopt;
}

Isometry3d OdeHeldPart::X_WV() const {
  const dReal* const p = dBodyGetPosition(state_->body);
  const dReal* const q = dBodyGetQuaternion(state_->body);
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  X.translation() = vector(p);
  return X;
}

contact::Wrench OdeHeldPart::contact_wrench() const {
  contact::Wrench sum;
  for (const auto& feedback : state_->feedback) {
    sum.f += vector(feedback->f1);
    sum.t += vector(feedback->t1);
  }
  return sum;
}

double OdeHeldPart::speed() const {
  return vector(dBodyGetLinearVel(state_->body)).norm();
}

}  // namespace glissade::test_support
