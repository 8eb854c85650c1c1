#include <cstdint>
#include <utility>
#include <vector>

#include <glissade/apps/commands/slide_tables.h>
#include <glissade/contact/spring.h>
#include <glissade/reference/sliding_method.h>

namespace glissade::apps {
namespace {

std::vector<std::string> motion_columns(reference::SlidingMethod method) {
  std::vector<std::string> names{"t_s",  "gx_m", "gy_m",  "gz_m",  "gqw",   "gqx",      "gqy",  "gqz",
                                 "vx_m", "vy_m", "vz_m",  "vqw",   "vqx",   "vqy",      "vqz",  "fx_N",
                                 "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm", "contacts", "state"};
  if (method == reference::SlidingMethod::kPaper) names.emplace_back("states");
  return names;
}

std::vector<std::string> moving_columns() {
  return {"t_s", "object", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
}

void add_motion_row(CsvWriter& out, double time_s, reference::SlidingMethod method,
                    const reference::SlidingSimulation& sliding) {
  const contact::SlidingResult& result = sliding.result();
  const contact::Wrench wrench = contact::contact_wrench(sliding.result(), sliding.part().p_Vref());
  out.add(time_s).add(result.X_WG).add(result.X_WV);
  // Adding zero turns a negative zero into the plain one.
  for (int i = 0; i < 3; ++i)
    out.add(wrench.f[i] + 0.0);
  for (int i = 0; i < 3; ++i)
    out.add(wrench.t[i] + 0.0);
  out.add(std::int64_t{result.pushing}).add(contact::name_of(result.state));
  if (method == reference::SlidingMethod::kPaper) out.add(sliding.trace());
  out.end_row();
}

/// One row per object that moves on its own.
void add_moving_rows(CsvWriter& out, double time_s, const HapticScene& scene,
                     const reference::SlidingSimulation& sliding) {
  const std::size_t first = scene.obstacles.size() + 1;
  for (std::size_t i = 0; i < scene.moving.size(); ++i) {
    out.add(time_s).add(scene.body_names[first + i]).add(sliding.scripted_X_WB()[i]).end_row();
  }
}

}  // namespace

SlideTables::SlideTables(SlideTableFiles files, const HapticScene& scene, reference::SlidingMethod method)
    : files_(std::move(files)), scene_(scene), method_(method) {}

void SlideTables::create(const reference::SlidingSimulation& sliding) {
  is_created_ = true;
  if (!files_.motion.empty()) motion_ = std::make_unique<CsvWriter>(files_.motion, motion_columns(method_));
  if (files_.contacts.any()) contacts_ = std::make_unique<SlideContactsWriter>(files_.contacts, scene_, sliding);
  if (!files_.moving.empty()) moving_ = std::make_unique<CsvWriter>(files_.moving, moving_columns());
}

void SlideTables::write(std::chrono::nanoseconds time, const reference::SlidingSimulation& sliding) {
  if (!is_created_) create(sliding);
  const double time_s = std::chrono::duration<double>(time).count();
  if (motion_) add_motion_row(*motion_, time_s, method_, sliding);
  if (contacts_) contacts_->write(time_s);
  if (moving_) add_moving_rows(*moving_, time_s, scene_, sliding);
}

void SlideTables::close() {
  if (motion_) motion_->close();
  if (contacts_) contacts_->close();
  if (moving_) moving_->close();
}

}  // namespace glissade::apps
