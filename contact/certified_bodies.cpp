#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include <glissade/base/assert.h>
#include <glissade/collision/dop_query.h>
#include <glissade/contact/certified_bodies.h>

#include "certificate/path_certificate.h"
#include "features/contact_search.h"
#include "scene/contact_scene.h"
#include "search/mover_search.h"

namespace glissade::contact {
namespace {

/// Work of the contacts of a pair: rough.
constexpr std::int64_t kWorkOfMoverContacts = 100;

std::vector<std::shared_ptr<const SlidingPart>> joined(std::vector<std::shared_ptr<const SlidingPart>> objects,
                                                       const std::vector<std::shared_ptr<const SlidingPart>>& movers) {
  if (movers.empty()) throw std::invalid_argument("there must be a body that moves");
  objects.insert(objects.end(), movers.begin(), movers.end());
  for (const auto& part : objects) {
    if (part == nullptr) throw std::invalid_argument("a body that moves must not be a null pointer");
  }
  return objects;
}

double greatest(const std::vector<Obstacle>& fixed, double margin) {
  for (const Obstacle& obstacle : fixed)
    margin = std::max(margin, obstacle.margin.value_or(margin));
  return margin;
}

std::vector<int> groups(std::size_t objects, std::size_t movers) {
  std::vector<int> result(objects, ContactScene::kStill);
  result.resize(objects + movers, ContactScene::kChain);
  return result;
}

}  // namespace

class CertifiedBodies::State {
 public:
  State(std::vector<Obstacle> fixed, std::vector<std::shared_ptr<const SlidingPart>> objects,
        const std::vector<std::shared_ptr<const SlidingPart>>& movers, double margin)
      : margin_(margin),
        greatest_margin_(greatest(fixed, margin)),
        first_mover_(objects.size()),
        searches_(searches(fixed, objects, movers, margin)),
        scene_(std::move(fixed), joined(std::move(objects), movers), first_mover_ + movers.size(),
               std::vector<double>(first_mover_ + movers.size(), margin), groups(first_mover_, movers.size())),
        certificate_(scene_) {}

  const ContactScene& scene() const { return scene_; }
  double margin() const { return margin_; }
  double greatest_margin() const { return greatest_margin_; }
  std::size_t first_mover() const { return first_mover_; }

  void place_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
    if (scene_.bodies()[scene_.body_of_mover(object)].X_WB.matrix() == X_WB.matrix()) return;
    scene_.place(object, X_WB);
    for (const auto& search : searches_)
      search->place_object(object, X_WB);
  }

  void place_movers(std::span<const Eigen::Isometry3d> X_WM, std::span<const std::size_t> numbers) {
    for (std::size_t m = 0; m < numbers.size(); ++m) {
      scene_.place(first_mover_ + m, X_WM[numbers[m]]);
      if (!searches_.empty()) searches_[m]->place_mover(X_WM[numbers[m]]);
    }
  }

  bool is_free() {
    const std::span<const PlacedBody> bodies = scene_.bodies();
    const double certain = certificate_.certain_distance();
    for (std::size_t mover = scene_.body_of_mover(first_mover_); mover < bodies.size(); ++mover) {
      for (std::size_t other = 0; other < scene_.body_of_mover(first_mover_); ++other) {
        const Eigen::Isometry3d X_OM = bodies[other].X_WB.inverse(Eigen::Isometry) * bodies[mover].X_WB;
        if (collision::intersects(bodies[other].body->tree, bodies[mover].body->tree, X_OM, workspace_, certain))
          return false;
      }
    }
    return true;
  }

  void look(std::span<const double> reach) {
    for (std::size_t m = 0; m < searches_.size(); ++m)
      searches_[m]->look(reach[m]);
  }

  std::size_t pair_count(std::size_t mover) const { return searches_.empty() ? 0 : searches_[mover]->pair_count(); }

  std::int64_t work() const {
    std::int64_t work = work_;
    for (const auto& search : searches_)
      work += search->work();
    return work;
  }

  void find_contacts(std::vector<Contact>& contacts) {
    contacts.clear();
    const std::size_t first = scene_.body_of_mover(first_mover_);
    for (std::size_t m = 0; m < searches_.size(); ++m) {
      const double reach = searches_[m]->reach();
      pairs_.clear();
      searches_[m]->add_within(reach, body_of_mover(m), pairs_);
      if (pairs_.empty()) continue;
      work_ += kWorkOfMoverContacts * std::ssize(pairs_);
      contact::find_contacts(scene_.bodies(), first, pairs_, reach, margin_, contacts_of_mover_);
      contacts.insert(contacts.end(), contacts_of_mover_.begin(), contacts_of_mover_.end());
    }
    for (Contact& contact : contacts)
      contact.margin = scene_.margin(contact.obstacle, body_of_mover(static_cast<std::size_t>(contact.part)));
  }

  /// `most_taken` as in `PathCertificate::begin`.
  bool certify(const BodiesMotion& motion, std::optional<double> most_taken, std::vector<Contact>& failures) {
    failures.clear();
    to_certify_.clear();
    const double clearance = most_taken ? greatest_margin_ - *most_taken : kMinClearanceOfMargin * margin_;
    for (std::size_t m = 0; m < searches_.size(); ++m) {
      const double concerned = motion.length(m) + clearance + certificate_.certain_distance();
      if (!searches_[m]->look(concerned)) return false;
      searches_[m]->add_within(concerned, body_of_mover(m), to_certify_);
    }
    certificate_.begin(motion, first_mover_, to_certify_, most_taken);
    WorkBudget unlimited;
    certificate_.go_on(unlimited);
    work_ += kUnlimitedWork - unlimited.left;
    for (const UncertifiedPair& failure : certificate_.failures())
      failures.push_back(contact_of(failure));
    return failures.empty();
  }

 private:
  /// None if there is nothing to touch.
  static std::vector<std::unique_ptr<MoverSearch>> searches(
      const std::vector<Obstacle>& fixed, const std::vector<std::shared_ptr<const SlidingPart>>& objects,
      const std::vector<std::shared_ptr<const SlidingPart>>& movers, double margin) {
    std::vector<std::unique_ptr<MoverSearch>> result;
    if (fixed.empty() && objects.empty()) return result;
    for (const auto& mover : movers)
      result.push_back(std::make_unique<MoverSearch>(fixed, objects, mover, margin));
    return result;
  }

  std::int32_t body_of_mover(std::size_t mover) const {
    return static_cast<std::int32_t>(scene_.body_of_mover(first_mover_ + mover));
  }

  /// The nearest corner of the mover's triangle, over the plane that separates the triangles.
  Contact contact_of(const UncertifiedPair& failure) const {
    const PlacedBody& obstacle = scene_.bodies()[static_cast<std::size_t>(failure.bodies.obstacle)];
    const PlacedBody& mover = scene_.bodies()[static_cast<std::size_t>(failure.bodies.part)];
    double top = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& y_W : obstacle.triangle_W(failure.obstacle_triangle))
      top = std::max(top, failure.n_W.dot(y_W));
    double gap = std::numeric_limits<double>::infinity();
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& x_W : mover.triangle_W(failure.part_triangle)) {
      if (failure.n_W.dot(x_W) - top >= gap) continue;
      gap = failure.n_W.dot(x_W) - top;
      p_W = x_W;
    }
    Contact contact{ContactKind::kVertexFace,
                    failure.part_triangle,
                    failure.bodies.obstacle,
                    failure.obstacle_triangle,
                    failure.n_W,
                    p_W,
                    gap};
    contact.part = failure.bodies.part - static_cast<std::int32_t>(scene_.body_of_mover(first_mover_));
    contact.margin = scene_.margin(failure.bodies.obstacle, failure.bodies.part);
    return contact;
  }

  double margin_;
  double greatest_margin_;                              // of all bodies
  std::size_t first_mover_;                             // among the parts of the scene
  std::vector<std::unique_ptr<MoverSearch>> searches_;  // of each mover
  ContactScene scene_;
  PathCertificate certificate_;
  std::int64_t work_ = 0;  // of contacts and certificates
  std::vector<TrianglesOfBodies> pairs_;
  std::vector<Contact> contacts_of_mover_;
  std::vector<PairToCertify> to_certify_;
  collision::QueryWorkspace workspace_;
};

CertifiedBodies::CertifiedBodies(std::vector<Obstacle> fixed, std::vector<std::shared_ptr<const SlidingPart>> objects,
                                 const std::vector<std::shared_ptr<const SlidingPart>>& movers, double margin)
    : state_(std::make_unique<State>(std::move(fixed), std::move(objects), movers, margin)) {}

CertifiedBodies::CertifiedBodies(CertifiedBodies&&) noexcept = default;
CertifiedBodies& CertifiedBodies::operator=(CertifiedBodies&&) noexcept = default;
CertifiedBodies::~CertifiedBodies() = default;

std::size_t CertifiedBodies::fixed_count() const {
  return state_->scene().obstacles().size();
}

std::size_t CertifiedBodies::object_count() const {
  return state_->first_mover();
}

std::size_t CertifiedBodies::mover_count() const {
  return state_->scene().movers().size() - state_->first_mover();
}

double CertifiedBodies::margin() const {
  return state_->margin();
}

double CertifiedBodies::greatest_margin() const {
  return state_->greatest_margin();
}

void CertifiedBodies::place_object(std::size_t object, const Eigen::Isometry3d& X_WB) {
  GLISSADE_ASSERT(object < object_count());
  state_->place_object(object, X_WB);
}

void CertifiedBodies::place_movers(std::span<const Eigen::Isometry3d> X_WM, std::span<const std::size_t> numbers) {
  GLISSADE_ASSERT(numbers.size() == mover_count());
  state_->place_movers(X_WM, numbers);
}

bool CertifiedBodies::is_free() const {
  return state_->is_free();
}

void CertifiedBodies::look(std::span<const double> reach) {
  GLISSADE_ASSERT(reach.size() == mover_count());
  state_->look(reach);
}

std::size_t CertifiedBodies::pair_count(std::size_t mover) const {
  GLISSADE_ASSERT(mover < mover_count());
  return state_->pair_count(mover);
}

std::int64_t CertifiedBodies::work() const {
  return state_->work();
}

void CertifiedBodies::find_contacts(std::vector<Contact>& contacts) {
  state_->find_contacts(contacts);
}

bool CertifiedBodies::certify(const BodiesMotion& motion, std::vector<Contact>& failures) {
  return state_->certify(motion, std::nullopt, failures);
}

bool CertifiedBodies::certify_taking(double most_taken, const BodiesMotion& motion, std::vector<Contact>& failures) {
  GLISSADE_ASSERT(most_taken < margin());
  return state_->certify(motion, most_taken, failures);
}

}  // namespace glissade::contact
