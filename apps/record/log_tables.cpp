#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <glissade/apps/durations.h>
#include <glissade/apps/record/log_file.h>
#include <glissade/apps/record/log_tables.h>
#include <glissade/apps/run/force_reason.h>
#include <glissade/apps/say.h>
#include <glissade/apps/text.h>
#include <glissade/devices/event_log.h>
#include <glissade/files/csv.h>
#include <glissade/files/csv_columns.h>
#include <glissade/files/file_checks.h>
#include <glissade/grasping/grasp_analysis.h>
#include <glissade/grasping/hand_model.h>
#include <glissade/haptics/recording.h>

namespace glissade::apps {

namespace {

using Columns = std::vector<std::string>;

/// A file that begins with the first row.
class Table {
 public:
  Table(const std::string& folder, const std::string& name, Columns columns)
      : path_((std::filesystem::path(folder) / name).string()), columns_(std::move(columns)) {
    check_output(path_);
  }

  CsvWriter& new_row() {
    ++rows_;
    return writer_ ? *writer_ : writer_.emplace(path_, columns_);
  }

  void close(std::vector<LogTable>& tables) {
    if (!writer_) {
      std::error_code error;
      if (std::filesystem::exists(path_, error)) warn(path_ + " is not of this log, which has no rows for it");
      return;
    }
    writer_->close();
    tables.push_back({path_, rows_});
  }

 private:
  std::string path_;
  Columns columns_;
  std::optional<CsvWriter> writer_;
  std::int64_t rows_ = 0;
};

Columns glove_columns() {
  Columns columns{"t_s",          "device",     "sequence",   "x_m",          "y_m",
                  "z_m",          "qw",         "qx",         "qy",           "qz",
                  "vx_m_per_s",   "vy_m_per_s", "vz_m_per_s", "wx_rad_per_s", "wy_rad_per_s",
                  "wz_rad_per_s", "grip",       "enabled",    "command_age_s"};
  for (const std::string& column : joint_columns())
    columns.push_back(column);
  return columns;
}

Columns columns_of_hand() {
  Columns columns{"t_s",    "tick",     "hand",  "part",          "fx_N",        "fy_N",          "fz_N",
                  "tx_Nm",  "ty_Nm",    "tz_Nm", "contact_share", "state_age_s", "command_age_s", "energy_J",
                  "reason", "activity", "grasp", "x_m",           "y_m",         "z_m",           "qw",
                  "qx",     "qy",       "qz"};
  for (const std::string& column : joint_columns())
    columns.push_back(column);
  for (const std::string_view joint : hands::kJointNames)
    columns.push_back(std::string(joint) + "_Nm");
  columns.insert(columns.end(), {"form", "touching"});
  return columns;
}

/// Names of segments, as `glissade grasp` has them.
class SegmentNames {
 public:
  /// Of those that touch, separated by spaces.
  std::string of(const grasping::TouchingSegments& touching) const {
    std::string names;
    for (const auto& [segment, name] : names_) {
      if (touching.has(segment)) names += (names.empty() ? "" : " ") + name;
    }
    return names;
  }

 private:
  static std::vector<std::pair<grasping::SegmentMeaning, std::string>> all() {
    const grasping::HandModel hand = grasping::make_hand();
    std::vector<std::pair<grasping::SegmentMeaning, std::string>> names;
    grasping::TouchingSegments named;  // the palm has several links, and the name of the first
    for (std::size_t l = 0; l < hand.meaning.size(); ++l) {
      if (hand.meaning[l].segment == grasping::HandSegment::kNone || named.has(hand.meaning[l])) continue;
      named.add(hand.meaning[l]);
      names.emplace_back(hand.meaning[l], hand.chain.links()[l].name);
    }
    return names;
  }

  std::vector<std::pair<grasping::SegmentMeaning, std::string>> names_ = all();
};

class Tables {
 public:
  explicit Tables(const std::string& folder)
      : ticks_(folder, "ticks.csv",
               {"tick", "t_s", "lateness_us", "duration_us", "contact_set", "requests", "stopped"}),
        parts_(folder, "parts.csv",
               {"t_s",  "tick", "part", "gx_m", "gy_m", "gz_m", "gqw", "gqx",   "gqy",      "gqz",
                "vx_m", "vy_m", "vz_m", "vqw",  "vqx",  "vqy",  "vqz", "state", "contacts", "contact_set_age_s"}),
        hands_(folder, "hands.csv", columns_of_hand()),
        gloves_(folder, "gloves.csv", glove_columns()) {}

  /// Returns false for an event that should have a row and cannot be read.
  bool add(const devices::LogEvent& event) {
    if (const auto tick = haptics::consumed_by_tick(event)) {
      add(*tick);
    } else if (const auto state = devices::haptic_state_of(event)) {
      add(*state);
    } else if (const auto logged = devices::glove_state_of(event)) {
      add(*logged, event.time);
    } else {
      return event.channel != "HAPTIC_TICK" && event.channel != "HAPTIC_STATE" && event.channel != "GLOVE_STATE";
    }
    return true;
  }

  std::vector<LogTable> close() {
    std::vector<LogTable> tables;
    for (Table* const table : {&ticks_, &parts_, &hands_, &gloves_})
      table->close(tables);
    return tables;
  }

 private:
  void add(const haptics::TickRecord& tick) {
    ticks_.new_row()
        .add(tick.number)
        .add(in_seconds(tick.time))
        .add(in_microseconds(tick.time - tick.deadline))
        .add(in_microseconds(tick.duration))
        .add(tick.set_sequence)
        .add(std::ssize(tick.requests.all()))
        .add(std::int64_t{tick.is_stopped})
        .end_row();
  }

  void add(const devices::HapticState& state) {
    for (std::int32_t p = 0; p < state.part_count; ++p) {
      const devices::HapticPartState& part = state.parts[static_cast<std::size_t>(p)];
      parts_.new_row()
          .add(in_seconds(state.time))
          .add(state.sequence)
          .add(std::int64_t{p})
          .add(part.X_WG)
          .add(part.X_WV)
          .add(devices::name_of(part.state))
          .add(std::int64_t{part.contact_count})
          .add(in_seconds(state.contact_set_age))
          .end_row();
    }
    for (std::int32_t h = 0; h < state.hand_count; ++h) {
      const devices::HapticHandState& hand = state.hands[static_cast<std::size_t>(h)];
      CsvWriter& row = hands_.new_row();
      row.add(in_seconds(state.time))
          .add(state.sequence)
          .add(std::int64_t{h})
          .add(std::int64_t{hand.part})
          .add(hand.force_W)
          .add(hand.torque_V_W)
          .add(hand.contact_share)
          .add(in_seconds(hand.state_age))
          .add(in_seconds(hand.command_age))
          .add(devices::energy_left(hand))
          .add(to_text(recorded_reason(state, static_cast<std::size_t>(h))));
      row.add(hands::name_of(hand.visible.activity)).add(hands::name_of(hand.visible.grasp)).add(hand.visible.X_WH);
      for (const double angle : hand.visible.angles)
        row.add(angle);
      for (const double torque : hand.joint_torques)
        row.add(torque);
      row.add(hands::name_of(hand.visible.form))
          .add(segment_names_.of(grasping::TouchingSegments::from_bits(hand.visible.touching)))
          .end_row();
    }
  }

  void add(const devices::LoggedState& logged, std::chrono::nanoseconds time) {
    const devices::GloveState& state = logged.state;
    CsvWriter& row = gloves_.new_row();
    row.add(in_seconds(time)).add(logged.device).add(state.sequence).add(state.X_WH).add(state.v_WH).add(state.w_WH);
    row.add(state.grip).add(std::int64_t{state.is_enabled}).add(in_seconds(state.command_age));
    for (const double angle : state.joint_angles)
      row.add(angle);
    row.end_row();
  }

  SegmentNames segment_names_;
  Table ticks_;
  Table parts_;
  Table hands_;
  Table gloves_;
};

}  // namespace

std::vector<LogTable> write_log_tables(const std::string& log_path, const std::string& folder, std::string& damage) {
  LogFile log(log_path, "tables");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::invalid_argument(folder + ": cannot be created: " + error.message());
  Tables tables(folder);
  while (const std::optional<devices::LogEvent> event = log.next()) {
    if (!tables.add(*event)) log.note_unreadable(*event);
  }
  damage = log.damage();
  return tables.close();
}

}  // namespace glissade::apps
