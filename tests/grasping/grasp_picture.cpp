#include "grasp_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace glissade::test_support {
namespace {

using Eigen::Array3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kObject = -1;
constexpr double kInFront_m = 0.5e-3;
constexpr double kStep_m = 4e-3;
constexpr int kFine = 2;  // samples of a pixel in each direction

/// A triangle in W and what it belongs to: a link, or the object.
struct Face {
  std::array<Vector3d, 3> corners;
  int owner;
};

void add_mesh(const geometry::TriangleMesh& mesh, const Eigen::Isometry3d& X_WM, int owner, std::vector<Face>& faces) {
  for (const geometry::Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) -> Vector3d { return X_WM * mesh.vertices[static_cast<std::size_t>(t[i])]; };
    faces.push_back({{corner(0), corner(1), corner(2)}, owner});
  }
}

void add_hand(const grasping::KinematicChain& chain, const grasping::Posture& posture, std::vector<Face>& faces) {
  std::vector<Eigen::Isometry3d> X_WL(chain.links().size());
  chain.poses(posture.X_WR, posture.values, X_WL);
  for (std::size_t link = 0; link < X_WL.size(); ++link) {
    if (chain.links()[link].mesh != nullptr)
      add_mesh(*chain.links()[link].mesh, X_WL[link], static_cast<int>(link), faces);
  }
}

std::vector<Face> faces_of(const GraspTrial& trial, const LabelledGrasp& grasp) {
  std::vector<Face> faces;
  add_mesh(trial.object(), grasp.X_WB, kObject, faces);
  add_hand(trial.hand().clasp.chain(), trial.hand().clasp.posture(), faces);
  return faces;
}

/// What a parallel projection shows.
struct View {
  Matrix3d R_VW = Matrix3d::Identity();
  Vector2d middle = Vector2d::Zero();
  double width_m = 0.0;
};

/// The view along this direction that has all hands in it.
View view_of(const Matrix3d& R_VW, const std::vector<Face>& faces) {
  constexpr double kFrame_m = 0.012;
  Eigen::AlignedBox3d box;
  for (const Face& face : faces) {
    if (face.owner == kObject) continue;
    for (const Vector3d& p_W : face.corners)
      box.extend(R_VW * p_W);
  }
  return {R_VW, box.center().head<2>(), box.sizes().head<2>().maxCoeff() + 2.0 * kFrame_m};
}

/// What each sample of an image shows.
class Canvas {
 public:
  Canvas(int size, const View& view, const std::vector<Face>& faces, std::span<const char> touching)
      : size_(size), samples_(count()) {
    const double scale = size / view.width_m;
    for (const Face& face : faces) {
      // Segments overlap at their joints: those that touch are shown there.
      const bool touches = face.owner >= 0 && touching[static_cast<std::size_t>(face.owner)] != 0;
      std::array<Vector3d, 3> p;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d p_V = view.R_VW * face.corners[i] + (touches ? kInFront_m : 0.0) * Vector3d::UnitZ();
        p[i] = {0.5 * size + scale * (p_V.x() - view.middle.x()), 0.5 * size - scale * (p_V.y() - view.middle.y()),
                p_V.z()};
      }
      const Vector3d n_V = view.R_VW * (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]);
      if (n_V.norm() > 0.0) fill(p, n_V.normalized(), face.owner);
    }
  }

  struct Sample {
    double depth = -std::numeric_limits<double>::infinity();
    Vector3d n_V = Vector3d::Zero();
    int owner = kObject - 1;
  };
  const Sample& at(int x, int y) const { return samples_[static_cast<std::size_t>(y * size_ + x)]; }
  int size() const { return size_; }

 private:
  std::size_t count() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }

  void fill(const std::array<Vector3d, 3>& p, const Vector3d& n_V, int owner) {
    const auto edge = [](const Vector3d& a, const Vector3d& b, double x, double y) {
      return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
    };
    const double area = edge(p[0], p[1], p[2].x(), p[2].y());
    if (std::abs(area) < 1e-12) return;
    const auto range = [&](int axis) {
      const double low = std::min({p[0][axis], p[1][axis], p[2][axis]});
      const double high = std::max({p[0][axis], p[1][axis], p[2][axis]});
      return std::array{std::clamp(static_cast<int>(low), 0, size_ - 1),
                        std::clamp(static_cast<int>(high), 0, size_ - 1)};
    };
    const auto [left, right] = range(0);
    const auto [top, bottom] = range(1);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double a = edge(p[1], p[2], x + 0.5, y + 0.5) / area;
        const double b = edge(p[2], p[0], x + 0.5, y + 0.5) / area;
        const double c = 1.0 - a - b;
        if (a < 0.0 || b < 0.0 || c < 0.0) continue;
        const double depth = a * p[0].z() + b * p[1].z() + c * p[2].z();
        Sample& sample = samples_[static_cast<std::size_t>(y * size_ + x)];
        if (depth > sample.depth) sample = {depth, n_V.z() < 0.0 ? Vector3d(-n_V) : n_V, owner};
      }
    }
  }

  int size_;
  std::vector<Sample> samples_;
};

/// Views along 26 directions, the hand's or the world's vertical upright.
std::vector<Matrix3d> views(const Vector3d& up_W) {
  std::vector<Matrix3d> result;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        // Slightly aside of the axes, so that no side of a box is seen edge-on.
        const Vector3d towards = Vector3d(x + 0.13, y + 0.21, z + 0.17).normalized();
        if ((x == 0 && y == 0 && z == 0) || std::abs(towards.dot(up_W)) > 0.95) continue;
        Matrix3d R_VW;
        R_VW.row(2) = towards;
        R_VW.row(0) = up_W.cross(towards).normalized();
        R_VW.row(1) = towards.cross(R_VW.row(0).transpose());
        result.push_back(R_VW);
      }
    }
  }
  return result;
}

/// How well the touching segments and the object are in sight.
double score(const Canvas& canvas, std::span<const char> touching) {
  std::vector<int> seen(touching.size() + 1, 0);
  for (int y = 0; y < canvas.size(); ++y) {
    for (int x = 0; x < canvas.size(); ++x) {
      const int owner = canvas.at(x, y).owner;
      if (owner >= kObject) ++seen[static_cast<std::size_t>(owner + 1)];
    }
  }
  const double pixels = canvas.size() * canvas.size();
  double sum = std::min(1.0, seen[0] / (0.05 * pixels));
  int all = 0;
  for (std::size_t link = 0; link < touching.size(); ++link) {
    all += seen[link + 1];
    if (touching[link] != 0) sum += std::min(1.0, seen[link + 1] / (0.012 * pixels));
  }
  return sum + all / pixels;
}

using Colors = std::function<Array3d(int owner)>;

Colors colors_of_touch(std::span<const char> touching) {
  return [touching](int owner) -> Array3d {
    if (owner == kObject) return {130.0, 165.0, 205.0};
    if (touching[static_cast<std::size_t>(owner)] != 0) return {222.0, 90.0, 60.0};
    return {238.0, 208.0, 182.0};
  };
}

/// By the kind of the segment; palm and wrist in the color of skin.
Colors colors_of_kind(const grasping::HandModel& hand) {
  return [&hand](int owner) -> Array3d {
    const grasping::HandSegment segment = hand.meaning[static_cast<std::size_t>(owner)].segment;
    if (segment == grasping::HandSegment::kInner) return {120.0, 170.0, 215.0};
    if (segment == grasping::HandSegment::kMiddle) return {235.0, 195.0, 95.0};
    if (segment == grasping::HandSegment::kOuter) return {215.0, 115.0, 85.0};
    return {238.0, 208.0, 182.0};
  };
}

/// Whether something else, or the same thing farther away by more than `step` (metres), begins to the right or below.
bool is_outline(const Canvas& canvas, int x, int y, double step) {
  const Canvas::Sample& sample = canvas.at(x, y);
  for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
    if (x + dx >= canvas.size() || y + dy >= canvas.size()) continue;
    const Canvas::Sample& next = canvas.at(x + dx, y + dy);
    if ((next.owner == kObject) != (sample.owner == kObject) || std::abs(next.depth - sample.depth) > step) return true;
  }
  return false;
}

Array3d color_of(const Canvas& canvas, int x, int y, const Colors& colors) {
  const Canvas::Sample& sample = canvas.at(x, y);
  if (sample.owner < kObject) return Array3d::Constant(255.0);
  const double light = 0.4 + 0.6 * std::max(0.0, sample.n_V.dot(Vector3d(-0.3, 0.4, 0.866)));
  return colors(sample.owner) * light * (is_outline(canvas, x, y, kStep_m) ? 0.45 : 1.0);
}

/// The canvas has kFine times the size of the picture. The outline of `over`, if not null, is drawn over it.
Picture picture_of(const Canvas& canvas, const Colors& colors, const Canvas* over = nullptr) {
  const int size = canvas.size() / kFine;
  const Array3d line(60.0, 60.0, 60.0);
  Picture picture = blank(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      Array3d color = Array3d::Zero();
      for (int i = 0; i < kFine * kFine; ++i) {
        const int fine_x = kFine * x + i % kFine;
        const int fine_y = kFine * y + i / kFine;
        const bool is_over = over != nullptr && is_outline(*over, fine_x, fine_y, 8.0 * kStep_m);
        color += (is_over ? line : color_of(canvas, fine_x, fine_y, colors)) / (kFine * kFine);
      }
      for (int channel = 0; channel < 3; ++channel)
        picture.rgb[static_cast<std::size_t>(3 * (y * size + x) + channel)] = static_cast<std::uint8_t>(color[channel]);
    }
  }
  return picture;
}

}  // namespace

void Picture::paste(const Picture& other, int left, int top) {
  for (int y = 0; y < other.height; ++y) {
    const auto row = other.rgb.begin() + static_cast<std::ptrdiff_t>(3) * y * other.width;
    std::copy(row, row + static_cast<std::ptrdiff_t>(3) * other.width,
              rgb.begin() + static_cast<std::ptrdiff_t>(3) * ((top + y) * width + left));
  }
}

void Picture::save(const std::filesystem::path& file) const {
  std::ofstream out(file, std::ios::binary);
  out << "P6\n" << width << " " << height << "\n255\n";
  for (const std::uint8_t value : rgb)
    out.put(static_cast<char>(value));
  if (!out.flush()) throw std::invalid_argument(file.string() + " cannot be written");
}

Picture blank(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), std::uint8_t{255})};
}

Picture draw_grasp(const GraspTrial& trial, const LabelledGrasp& grasp, int size) {
  const std::vector<Face> faces = faces_of(trial, grasp);
  const std::span<const char> touching = trial.hand().clasp.touching();
  constexpr int kThumbnail = 80;
  View best;
  double best_score = -1.0;
  for (const Matrix3d& R_VW : views(grasp.up_W)) {
    const View view = view_of(R_VW, faces);
    const double here = score(Canvas(kThumbnail, view, faces, touching), touching);
    if (here <= best_score) continue;
    best_score = here;
    best = view;
  }
  return picture_of(Canvas(kFine * size, best, faces, touching), colors_of_touch(touching));
}

Picture draw_segments(const grasping::HandModel& hand, const Matrix3d& R_VW, int size) {
  std::vector<Face> faces;
  add_hand(hand.chain, open_hand(), faces);
  const std::vector<char> none(hand.chain.links().size(), 0);
  return picture_of(Canvas(kFine * size, view_of(R_VW, faces), faces, none), colors_of_kind(hand));
}

std::vector<Picture> draw_clasping(const LabelledGrasp& grasp, std::span<const int> times_ms, const Matrix3d& R_VW,
                                   int size) {
  GraspTrial trial(grasp);
  std::vector<Face> in_sight;  // in all pictures
  for (const int ms : times_ms)
    add_hand(trial.hand().clasp.chain(), target_at(grasp, ms), in_sight);
  const View view = view_of(R_VW, in_sight);
  std::vector<Picture> pictures;
  for (int ms = 0; pictures.size() < times_ms.size(); ++ms) {
    const grasping::Posture target = target_at(grasp, ms);
    trial.advance(target);
    if (ms != times_ms[pictures.size()]) continue;
    const std::span<const char> touching = trial.hand().clasp.touching();
    std::vector<Face> wanted;
    add_hand(trial.hand().clasp.chain(), target, wanted);
    const Canvas over(kFine * size, view, wanted, std::vector<char>(touching.size(), 0));
    const Canvas canvas(kFine * size, view, faces_of(trial, grasp), touching);
    pictures.push_back(picture_of(canvas, colors_of_touch(touching), &over));
  }
  return pictures;
}

}  // namespace glissade::test_support
