#include "near_bodies.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <glissade/collision/dop_query.h>
#include <glissade/geometry/mesh_generators.h>
#include <glissade/geometry/triangle_pair.h>

#include "sweeps/sweep_meshes.h"
#include "tree_triangles.h"

namespace glissade::test_support {
namespace {

using contact::PlacedBody;
using contact::TreeItem;
using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using geometry::TrianglePoints;

/// A triangle with area at the pose of its body.
struct PlacedTriangle {
  std::int32_t number;
  geometry::TrianglePoints points;
  AlignedBox3d box;
};

std::vector<PlacedTriangle> placed_triangles(const PlacedBody& body) {
  std::vector<std::int32_t> numbers;
  add_triangles_of_node(body.body->tree, 0, numbers);
  std::vector<PlacedTriangle> triangles;
  for (const std::int32_t number : numbers) {
    PlacedTriangle& triangle = triangles.emplace_back(PlacedTriangle{number, body.triangle_W(number), {}});
    for (const Eigen::Vector3d& x : triangle.points)
      triangle.box.extend(x);
  }
  return triangles;
}

std::vector<std::int32_t> triangles_of(const contact::ContactBody& body, const TreeItem& item) {
  std::vector<std::int32_t> triangles;
  if (item.kind == TreeItem::Kind::kTriangle) triangles.push_back(static_cast<std::int32_t>(item.number));
  if (item.kind == TreeItem::Kind::kLeaf) add_triangles_of_leaf(body.tree, item.number, triangles);
  if (item.kind == TreeItem::Kind::kNode) add_triangles_of_node(body.tree, item.number, triangles);
  return triangles;
}

const PlacedBody& body_of(std::span<const PlacedBody> bodies, std::int32_t number) {
  return bodies[static_cast<std::size_t>(number)];
}

/// The smallest distance between a part and all bodies with lower numbers.
double clearance(const contact::ContactScene& scene, std::size_t part) {
  collision::QueryWorkspace workspace;
  const std::size_t number = scene.body_of_mover(part);
  const PlacedBody& placed = scene.bodies()[number];
  double least = std::numeric_limits<double>::infinity();
  for (const PlacedBody& other : scene.bodies().first(number)) {
    const Isometry3d X_OV = other.X_WB.inverse(Eigen::Isometry) * placed.X_WB;
    least = std::min(least, collision::distance(other.body->tree, placed.body->tree, X_OV, workspace).distance);
  }
  return least;
}

/// Moves a part from far away straight towards a point, until its clearance is hardly more than `gap`.
void approach(contact::ContactScene& scene, std::size_t part, double far, double gap, RandomNumbers& random) {
  const contact::ContactBody& body = *scene.bodies()[scene.body_of_mover(part)].body;
  const Eigen::Vector3d direction = random.direction();
  Isometry3d X_WV = Isometry3d::Identity();
  X_WV.linear() = random.chance(0.5) ? random.rotation() : random.cube_rotation();
  X_WV.translation() = far * direction + random.point(0.1 * far) - X_WV.linear() * body.tree.center();
  scene.place(part, X_WV);
  // The distance decreases by at most the length of the motion.
  for (int i = 0; i < 30; ++i) {
    const double now = clearance(scene, part);
    X_WV.translation() -= (now - gap) * direction;
    if (now < 1.1 * gap || X_WV.translation().dot(direction) < -far) return;  // arrived, or past all bodies
    scene.place(part, X_WV);
  }
}

}  // namespace

double distance_of(std::span<const PlacedBody> bodies, const contact::TrianglesOfBodies& pair) {
  return geometry::triangle_distance(body_of(bodies, pair.bodies.obstacle).triangle_W(pair.obstacle_triangle),
                                     body_of(bodies, pair.bodies.part).triangle_W(pair.part_triangle))
      .distance;
}

std::map<contact::TrianglesOfBodies, double> near_triangles(std::span<const PlacedBody> bodies, std::size_t first_part,
                                                            double radius) {
  std::vector<std::vector<PlacedTriangle>> placed;
  for (const PlacedBody& body : bodies)
    placed.push_back(placed_triangles(body));
  std::map<contact::TrianglesOfBodies, double> near;
  for (std::size_t part = first_part; part < bodies.size(); ++part) {
    for (std::size_t other = 0; other < part; ++other) {
      for (const PlacedTriangle& o : placed[other]) {
        for (const PlacedTriangle& p : placed[part]) {
          if (o.box.exteriorDistance(p.box) > 1.001 * radius) continue;
          const double distance = geometry::triangle_distance(o.points, p.points).distance;
          if (distance > radius) continue;
          const contact::BodyPair pair{static_cast<std::int32_t>(other), static_cast<std::int32_t>(part)};
          near[{pair, o.number, p.number}] = distance;
        }
      }
    }
  }
  return near;
}

std::vector<contact::TrianglesOfBodies> triangles_of(std::span<const PlacedBody> bodies,
                                                     const contact::PairToCertify& pair_to_certify) {
  const std::vector<std::int32_t> of_V =
      triangles_of(*body_of(bodies, pair_to_certify.bodies.part).body, pair_to_certify.item_V);
  std::vector<contact::TrianglesOfBodies> pairs;
  for (const std::int32_t o :
       triangles_of(*body_of(bodies, pair_to_certify.bodies.obstacle).body, pair_to_certify.item_O)) {
    for (const std::int32_t p : of_V)
      pairs.push_back({pair_to_certify.bodies, o, p});
  }
  return pairs;
}

std::shared_ptr<const contact::SlidingPart> random_part(double size, RandomNumbers& random) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  const int kind = random.integer(0, 3);
  if (kind == 0) *mesh = geometry::make_plate({size, size * random.uniform(0.2, 1.0)}, random.integer(20, 120));
  if (kind == 1) *mesh = geometry::make_torus(0.6 * size, 0.2 * size, random.integer(60, 120));
  if (kind >= 2) *mesh = random_mesh(size, random.point(size), random).mesh;
  return std::make_shared<const contact::SlidingPart>(std::move(mesh));
}

std::unique_ptr<contact::ContactScene> random_contact_scene(double size, double margin, double gap,
                                                            RandomNumbers& random) {
  std::vector<contact::Obstacle> obstacles;
  const int obstacle_count = random.integer(1, 2);
  for (int i = 0; i < obstacle_count; ++i) {
    contact::Obstacle obstacle{random_part(size * random.uniform(0.5, 2.0), random)};
    obstacle.X_WO.linear() = random.chance(0.5) ? random.rotation() : random.cube_rotation();
    obstacle.X_WO.translation() = random.point(size);
    obstacles.push_back(obstacle);
  }
  std::vector<std::shared_ptr<const contact::SlidingPart>> parts;
  const int part_count = random.integer(1, 2);
  for (int i = 0; i < part_count; ++i)
    parts.push_back(random_part(size * random.uniform(0.3, 1.0), random));
  const std::vector<double> margins(parts.size(), margin);
  auto scene = std::make_unique<contact::ContactScene>(obstacles, parts, margins);
  for (std::size_t p = 0; p < parts.size(); ++p)
    approach(*scene, p, 8.0 * size, gap, random);
  return scene;
}

bool can_make_contact(const contact::ContactScene& scene, const contact::TrianglesOfBodies& pair) {
  const auto topology_of = [&](std::int32_t body) -> const geometry::MeshTopology& {
    return scene.bodies()[static_cast<std::size_t>(body)].body->topology;
  };
  return topology_of(pair.bodies.obstacle)
      .can_stop_each_other(pair.obstacle_triangle, topology_of(pair.bodies.part), pair.part_triangle);
}

}  // namespace glissade::test_support
