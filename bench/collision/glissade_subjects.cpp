#include <string>

#include "kernels/instruction_set.h"
#include "subject.h"

namespace glissade::bench {
namespace {

using collision::DopTree;
using collision::DopTreeOptions;
using collision::InstructionSet;
using Eigen::Isometry3d;
using geometry::TriangleMesh;

struct GlissadeModel : Model {
  explicit GlissadeModel(const geometry::TriangleMesh& mesh, const DopTreeOptions& options)
      : tree(std::make_shared<const geometry::TriangleMesh>(mesh), options) {}
  DopTree tree;
};

const DopTree& tree_of(const Model& model) {
  return dynamic_cast<const GlissadeModel&>(model).tree;
}

template <typename Workspace>
class GlissadeQuery : public Query {
 public:
  GlissadeQuery(const Model& model_A, const Model& model_B, InstructionSet set)
      : tree_A_(tree_of(model_A)), tree_B_(tree_of(model_B)), instruction_set_(set) {}

  void prepare() override { collision::use_instruction_set(instruction_set_); }
  void forget() override {
    if constexpr (requires { workspace_.forget(); }) workspace_.forget();
  }
  bool intersects(const Isometry3d& X_AB) override { return collision::intersects(tree_A_, tree_B_, X_AB, workspace_); }
  std::int64_t count_pairs(const Isometry3d& X_AB) override {
    collision::intersecting_pairs(tree_A_, tree_B_, X_AB, workspace_, pairs_);
    return static_cast<std::int64_t>(pairs_.size());
  }
  double distance(const Isometry3d& X_AB) override {
    return collision::distance(tree_A_, tree_B_, X_AB, workspace_).distance;
  }
  std::optional<collision::QueryCounters> counters() const override { return workspace_.counters(); }

 private:
  const DopTree& tree_A_;
  const DopTree& tree_B_;
  InstructionSet instruction_set_;
  Workspace workspace_;
  std::vector<collision::TrianglePair> pairs_;
};

InstructionSet best_instruction_set() {
  return collision::available_instruction_sets().front();
}

template <typename Workspace = collision::QueryWorkspace>
Subject make_subject(const std::string& name, const DopTreeOptions& options, InstructionSet set) {
  const std::string model = "glissade k" + std::to_string(options.directions) + (options.thin_slab ? " slab" : "") +
                            (options.realignment == collision::Realignment::kBruteForce ? " brute force" : "");
  return {
      .name = name,
      .model = model,
      .build = [options](const geometry::TriangleMesh& mesh) { return std::make_unique<GlissadeModel>(mesh, options); },
      .query = [set](
                   const Model& model_A,
                   const Model& model_B) { return std::make_unique<GlissadeQuery<Workspace>>(model_A, model_B, set); }};
}

}  // namespace

Subject glissade_subject() {
  return make_subject("glissade", {}, best_instruction_set());
}

Subject glissade_coherent() {
  return make_subject<collision::CoherentWorkspace>("glissade-coherent", {}, best_instruction_set());
}

std::vector<Subject> glissade_instruction_sets() {
  std::vector<Subject> subjects;
  for (const InstructionSet set : collision::available_instruction_sets()) {
    if (set != best_instruction_set())
      subjects.push_back(make_subject("glissade-" + std::string(collision::name_of(set)), {}, set));
  }
  return subjects;
}

std::vector<Subject> glissade_as_published() {
  const DopTreeOptions affine{.thin_slab = false};
  const DopTreeOptions brute_force{.thin_slab = false, .realignment = collision::Realignment::kBruteForce};
  return {make_subject("glissade-no-slab", affine, best_instruction_set()),
          make_subject("glissade-brute-force", brute_force, best_instruction_set())};
}

std::vector<Subject> glissade_directions() {
  std::vector<Subject> subjects;
  for (const int k : {6, 14, 18, 26}) {  // 24 is the default
    const std::string name = "glissade-k" + std::to_string(k);
    subjects.push_back(make_subject(name, {.directions = k}, best_instruction_set()));
    subjects.push_back(make_subject(name + "-no-slab", {.directions = k, .thin_slab = false}, best_instruction_set()));
  }
  return subjects;
}

}  // namespace glissade::bench
