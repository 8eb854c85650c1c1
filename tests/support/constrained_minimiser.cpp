#include "constrained_minimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <Eigen/Cholesky>

#include <glissade/geometry/displacement.h>

#include "hull_oracle.h"

namespace glissade::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using geometry::Displacement;

constexpr double kFirstBarrier = 1e-3;  // of the energy at the start
constexpr double kLastBarrier = 1e-13;  // joules
constexpr double kBarrierFactor = 0.2;
constexpr int kNewtonSteps = 1000;  // for one barrier

/// n·x = d, with n towards the part.
struct Plane {
  Vector3d n;
  double d;
};

/// A point of the search space.
struct State {
  Isometry3d X_WV;
  std::vector<Plane> planes;
};

/// Two directions across n, by which it can be turned.
Eigen::Matrix<double, 3, 2> across(const Vector3d& n) {
  Eigen::Matrix<double, 3, 2> T;
  T.col(0) = n.unitOrthogonal();
  T.col(1) = n.cross(T.col(0));
  return T;
}

class BarrierMethod {
 public:
  BarrierMethod(const RestProblem& problem, const Isometry3d& X_WG, double longest_step)
      : problem_(problem), X_WG_(X_WG), longest_step_(longest_step) {
    for (const ConvexPiece& piece : problem.part_V) {
      for (const Vector3d& x : piece)
        radius_ = std::max(radius_, (x - problem.p_Vref).norm());
    }
  }

  /// A plane for every pair of pieces, halfway between them.
  State start_at(const Isometry3d& X_WV) const {
    State state{X_WV, {}};
    for (const ConvexPiece& piece : problem_.part_V) {
      for (const ConvexPiece& obstacle : problem_.obstacles_W) {
        const HullOracle hulls(obstacle, piece, X_WV);
        const Vector3d between = hulls.difference();
        if (!(between.norm() > problem_.margin))
          throw std::invalid_argument("the part starts no farther than the margin from an obstacle");
        Plane plane{between.normalized(), -std::numeric_limits<double>::infinity()};
        for (const Vector3d& a : obstacle)
          plane.d = std::max(plane.d, plane.n.dot(a));
        plane.d += 0.5 * (between.norm() - problem_.margin);
        state.planes.push_back(plane);
      }
    }
    return state;
  }

  bool minimize(State& state, double barrier) {
    for (int i = 0; i < kNewtonSteps; ++i) {
      differentiate(state, barrier);
      const VectorXd step = newton_step();
      const double decrease = -gradient_.dot(step);
      // Half of the decrement estimates the possible gain.
      if (decrease < 1e-3 * barrier) return true;
      if (!walk(state, step, decrease, barrier)) return decrease < 0.1 * barrier;
    }
    return false;
  }

  double energy(const Isometry3d& X_WV) const {
    const geometry::Displacement error = geometry::displacement_between(X_WV, X_WG_, problem_.p_Vref);
    return 0.5 * (problem_.stiffness.translational * error.v.squaredNorm() +
                  problem_.stiffness.rotational * error.w.squaredNorm());
  }

 private:
  /// The objective; infinite where a constraint is violated.
  double value(const State& state, double barrier) const {
    double sum_of_logs = 0.0;
    double least = std::numeric_limits<double>::infinity();
    std::size_t p = 0;
    for (const ConvexPiece& piece : problem_.part_V) {
      for (const ConvexPiece& obstacle : problem_.obstacles_W) {
        const Plane& plane = state.planes[p++];
        for (const Vector3d& a : obstacle)
          add_log(plane.d - plane.n.dot(a), sum_of_logs, least);
        for (const Vector3d& b : piece)
          add_log(plane.n.dot(state.X_WV * b) - plane.d - problem_.margin, sum_of_logs, least);
      }
    }
    if (!(least > 0.0)) return std::numeric_limits<double>::infinity();
    return energy(state.X_WV) - barrier * sum_of_logs;
  }

  static void add_log(double slack, double& sum_of_logs, double& least) {
    least = std::min(least, slack);
    if (slack > 0.0) sum_of_logs += std::log(slack);
  }

  /// Gradient and Hessian by (v, w) of the part and, for each plane, (two turns, shift). Rotations are varied along
  /// x(s) = exp(s w) x, normals likewise along great circles, so second derivatives belong to these paths.
  void differentiate(const State& state, double barrier) {
    const auto unknowns = static_cast<Eigen::Index>(6 + 3 * state.planes.size());
    gradient_ = VectorXd::Zero(unknowns);
    hessian_ = MatrixXd::Zero(unknowns, unknowns);
    differentiate_energy(state.X_WV);
    const Vector3d p_Wref = state.X_WV * problem_.p_Vref;
    std::size_t p = 0;
    for (const ConvexPiece& piece : problem_.part_V) {
      for (const ConvexPiece& obstacle : problem_.obstacles_W) {
        const Plane& plane = state.planes[p];
        const auto at = static_cast<Eigen::Index>(6 + 3 * p++);
        const Eigen::Matrix<double, 3, 2> T = across(plane.n);
        for (const Vector3d& a : obstacle)
          differentiate_obstacle_corner(plane, T, a, at, barrier);
        for (const Vector3d& b : piece)
          differentiate_part_corner(plane, T, state.X_WV * b, p_Wref, at, barrier);
      }
    }
  }

  /// Along exp(s w) the length a of the rotation vector has second derivative 1 along itself and (a/2) cot(a/2) across.
  void differentiate_energy(const Isometry3d& X_WV) {
    const geometry::Displacement error = geometry::displacement_between(X_WV, X_WG_, problem_.p_Vref);
    gradient_.segment<3>(0) = -problem_.stiffness.translational * error.v;
    gradient_.segment<3>(3) = -problem_.stiffness.rotational * error.w;
    const double half = 0.5 * error.w.norm();
    const double across_it = half > 1e-6 ? half / std::tan(half) : 1.0;
    Matrix3d H = across_it * Matrix3d::Identity();
    if (half > 1e-6) H += (1.0 - across_it) * error.w * error.w.transpose() / error.w.squaredNorm();
    hessian_.block<3, 3>(0, 0) = problem_.stiffness.translational * Matrix3d::Identity();
    hessian_.block<3, 3>(3, 3) = problem_.stiffness.rotational * H;
  }

  /// slack = d − n·a.
  void differentiate_obstacle_corner(const Plane& plane, const Eigen::Matrix<double, 3, 2>& T, const Vector3d& a,
                                     Eigen::Index at, double barrier) {
    const double slack = plane.d - plane.n.dot(a);
    Vector3d g;
    g << -T.transpose() * a, 1.0;
    Matrix3d H = Matrix3d::Zero();
    H.topLeftCorner<2, 2>() = plane.n.dot(a) * Eigen::Matrix2d::Identity();
    gradient_.segment<3>(at) -= barrier / slack * g;
    hessian_.block<3, 3>(at, at) += barrier / slack * (g * g.transpose() / slack - H);
  }

  /// slack = n·x − d − m.
  void differentiate_part_corner(const Plane& plane, const Eigen::Matrix<double, 3, 2>& T, const Vector3d& x,
                                 const Vector3d& p_Wref, Eigen::Index at, double barrier) {
    const Vector3d r = x - p_Wref;
    const Vector3d& n = plane.n;
    const double slack = n.dot(x) - plane.d - problem_.margin;
    Eigen::Matrix<double, 9, 1> g;
    g << n, r.cross(n), T.transpose() * x, -1.0;
    Eigen::Matrix<double, 9, 9> H = Eigen::Matrix<double, 9, 9>::Zero();
    H.block<3, 3>(3, 3) = 0.5 * (n * r.transpose() + r * n.transpose()) - n.dot(r) * Matrix3d::Identity();
    H.block<3, 2>(0, 6) = T;
    H.block<3, 1>(3, 6) = r.cross(T.col(0));
    H.block<3, 1>(3, 7) = r.cross(T.col(1));
    H.block<2, 6>(6, 0) = H.block<6, 2>(0, 6).transpose();
    H.block<2, 2>(6, 6) = -n.dot(x) * Eigen::Matrix2d::Identity();
    H = (barrier / slack * (g * g.transpose() / slack - H)).eval();
    g *= barrier / slack;
    gradient_.segment<6>(0) -= g.head<6>();
    gradient_.segment<3>(at) -= g.tail<3>();
    hessian_.block<6, 6>(0, 0) += H.topLeftCorner<6, 6>();
    hessian_.block<6, 3>(0, at) += H.topRightCorner<6, 3>();
    hessian_.block<3, 6>(at, 0) += H.bottomLeftCorner<3, 6>();
    hessian_.block<3, 3>(at, at) += H.bottomRightCorner<3, 3>();
  }

  /// Where the Hessian is not positive definite, enough of a positive definite matrix is added.
  VectorXd newton_step() const {
    const VectorXd scale = hessian_.diagonal().cwiseAbs().cwiseSqrt().cwiseMax(1e-12).cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * hessian_ * scale.asDiagonal();
    const auto unknowns = scaled.rows();
    for (double shift = 0.0;; shift = std::max(1e-8, 10.0 * shift)) {
      const Eigen::LLT<MatrixXd> factor(scaled + shift * MatrixXd::Identity(unknowns, unknowns));
      if (factor.info() == Eigen::Success)
        return -(scale.asDiagonal() * factor.solve(scale.asDiagonal() * gradient_)).eval();
    }
  }

  /// Moves along `step` as far as the value decreases sufficiently; false if it does not decrease.
  bool walk(State& state, const VectorXd& step, double decrease, double barrier) const {
    const double before = value(state, barrier);
    const double length = step.segment<3>(0).norm() + step.segment<3>(3).norm() * radius_;
    for (double fraction = std::min(1.0, longest_step_ / length); fraction > 1e-12; fraction *= 0.5) {
      State next = moved(state, fraction * step);
      if (value(next, barrier) < before - 1e-4 * fraction * decrease) {
        state = std::move(next);
        return true;
      }
    }
    return false;
  }

  State moved(const State& state, const VectorXd& step) const {
    const geometry::Displacement d{step.segment<3>(0), step.segment<3>(3)};
    State next{geometry::displaced(state.X_WV, problem_.p_Vref, d), state.planes};
    for (std::size_t p = 0; p < next.planes.size(); ++p) {
      Plane& plane = next.planes[p];
      const auto at = static_cast<Eigen::Index>(6 + 3 * p);
      const Eigen::Vector2d turn = step.segment<2>(at);
      const double angle = turn.norm();
      if (angle > 0.0)
        plane.n = (std::cos(angle) * plane.n + std::sin(angle) / angle * across(plane.n) * turn).normalized();
      plane.d += step[at + 2];
    }
    return next;
  }

  const RestProblem& problem_;
  Isometry3d X_WG_;
  double longest_step_;
  double radius_ = 0.0;
  VectorXd gradient_;
  MatrixXd hessian_;
};

double least_distance(const RestProblem& problem, const Isometry3d& X_WV) {
  double least = std::numeric_limits<double>::infinity();
  for (const ConvexPiece& piece : problem.part_V) {
    for (const ConvexPiece& obstacle : problem.obstacles_W)
      least = std::min(least, HullOracle(obstacle, piece, X_WV).distance());
  }
  return least;
}

}  // namespace

RestOptimum find_rest(const RestProblem& problem, const Isometry3d& X_WG, const Isometry3d& X_WV_start,
                      double longest_step) {
  BarrierMethod method(problem, X_WG, longest_step);
  State state = method.start_at(X_WV_start);
  RestOptimum optimum;
  for (double barrier = kFirstBarrier * method.energy(X_WV_start); barrier > kLastBarrier; barrier *= kBarrierFactor)
    optimum.converged = method.minimize(state, barrier);
  optimum.X_WV = state.X_WV;
  optimum.energy = method.energy(state.X_WV);
  optimum.least_distance = least_distance(problem, state.X_WV);
  return optimum;
}

ConvexPiece piece_of(const geometry::TriangleMesh& mesh, const Isometry3d& X) {
  ConvexPiece piece;
  for (const Vector3d& x : mesh.vertices)
    piece.emplace_back(X * x);
  return piece;
}

}  // namespace glissade::test_support
