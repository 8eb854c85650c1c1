#pragma once

/// Two meshes, and the models of them that all benchmarks share.

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "subject.h"

namespace glissade::bench {

class MeshPair {
 public:
  using Mesh = std::shared_ptr<const geometry::TriangleMesh>;

  /// Two copies of one mesh.
  explicit MeshPair(geometry::TriangleMesh mesh)
      : MeshPair(std::make_shared<const geometry::TriangleMesh>(std::move(mesh))) {}
  explicit MeshPair(const Mesh& mesh) : mesh_A(mesh), mesh_B(mesh) {}
  MeshPair(Mesh of_A, Mesh of_B) : mesh_A(std::move(of_A)), mesh_B(std::move(of_B)) {}

  /// Queries of models, which are built when a subject first needs them. Copies share one model.
  std::unique_ptr<Query> query(const Subject& subject) {
    auto& [model_A, model_B] = models_[subject.model];
    if (!model_A) {
      model_A = subject.build(*mesh_A);
      model_B = mesh_A == mesh_B ? model_A : subject.build(*mesh_B);
    }
    return subject.query(*model_A, *model_B);
  }

  Mesh mesh_A;
  Mesh mesh_B;

 private:
  std::map<std::string, std::pair<std::shared_ptr<Model>, std::shared_ptr<Model>>> models_;
};

}  // namespace glissade::bench
