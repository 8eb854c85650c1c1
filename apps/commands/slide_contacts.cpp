#include <algorithm>
#include <vector>

#include <glissade/apps/commands/slide_contacts.h>
#include <glissade/geometry/displacement.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {
namespace {

std::vector<std::string> contact_columns() {
  return {"t_s",          "id",
          "kind",         "part_triangle",
          "obstacle",     "obstacle_triangle",
          "part_feature", "obstacle_feature",
          "px_m",         "py_m",
          "pz_m",         "qx_m",
          "qy_m",         "qz_m",
          "nx",           "ny",
          "nz",           "gap_m",
          "force_N",      "age_ms",
          "friction_x_N", "friction_y_N",
          "friction_z_N"};
}

std::vector<std::string> patch_columns() {
  return {"t_s", "id", "obstacle", "contacts", "px_m", "py_m",  "pz_m",    "nx",
          "ny",  "nz", "fx_N",     "fy_N",     "fz_N", "gap_m", "extent_m"};
}

/// Adding zero turns a negative zero into the plain one.
void add_vector(CsvWriter& out, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i)
    out.add(vector[i] + 0.0);
}

double greatest_margin(const HapticScene& scene, const reference::SlidingSimulation& sliding) {
  double greatest = sliding.margin();
  for (const contact::Obstacle& obstacle : scene.obstacles)
    greatest = std::max(greatest, obstacle.margin.value_or(0.0));
  return greatest;
}

}  // namespace

SlideContactsWriter::SlideContactsWriter(const SlideContactsFiles& files, const HapticScene& scene,
                                         const reference::SlidingSimulation& sliding)
    : scene_(scene),
      sliding_(sliding),
      tracker_(greatest_margin(scene, sliding)),
      patches_(sliding.part().radius()),
      moving_X_WB_(sliding.scripted_X_WB().begin(), sliding.scripted_X_WB().end()) {
  if (!files.contacts.empty()) contacts_out_ = std::make_unique<CsvWriter>(files.contacts, contact_columns());
  if (!files.patches.empty()) patches_out_ = std::make_unique<CsvWriter>(files.patches, patch_columns());
}

void SlideContactsWriter::write(double time_s) {
  const auto contacts = tracker_.update(sliding_.result(), travel_of_obstacles());
  if (contacts_out_) {
    for (const contact::TrackedContact& tracked : contacts)
      write_contact(time_s, tracked);
  }
  if (patches_out_) {
    for (const contact::ContactPatch& patch : patches_.merge(contacts))
      write_patch(time_s, patch);
  }
}

/// Upper bound, in metres, of the motion of all points of moving objects since the last call.
double SlideContactsWriter::travel_of_obstacles() {
  double most = 0.0;
  const auto X_WB = sliding_.scripted_X_WB();
  for (std::size_t i = 0; i < X_WB.size(); ++i) {
    const contact::SlidingPart& part = *scene_.moving[i].part_B;
    const geometry::Displacement d = geometry::displacement_between(moving_X_WB_[i], X_WB[i], part.p_Vref());
    most = std::max(most, geometry::motion_bound(d, part.radius()));
  }
  moving_X_WB_.assign(X_WB.begin(), X_WB.end());
  return most;
}

void SlideContactsWriter::close() {
  if (contacts_out_) contacts_out_->close();
  if (patches_out_) patches_out_->close();
}

void SlideContactsWriter::write_contact(double time_s, const contact::TrackedContact& tracked) {
  const contact::Contact& contact = tracked.contact;
  CsvWriter& out = *contacts_out_;
  out.add(time_s).add(tracked.id).add(contact::name_of(contact.kind)).add(std::int64_t{contact.part_triangle});
  out.add(scene_.body_names[static_cast<std::size_t>(contact.obstacle)]);
  out.add(std::int64_t{contact.obstacle_triangle});
  out.add(std::int64_t{contact.part_feature}).add(std::int64_t{contact.obstacle_feature});
  add_vector(out, contact.p_W);
  add_vector(out, contact.q_W());
  add_vector(out, contact.n_W);
  out.add(contact.gap).add(contact.force).add(tracked.age);
  add_vector(out, contact.friction_W);
  out.end_row();
}

void SlideContactsWriter::write_patch(double time_s, const contact::ContactPatch& patch) {
  CsvWriter& out = *patches_out_;
  out.add(time_s).add(patch.id).add(scene_.body_names[static_cast<std::size_t>(patch.obstacle)]);
  out.add(std::int64_t{patch.count});
  add_vector(out, patch.p_W);
  add_vector(out, patch.n_W);
  add_vector(out, patch.force_on_part_W);
  out.add(patch.gap).add(patch.extent);
  out.end_row();
}

}  // namespace glissade::apps
