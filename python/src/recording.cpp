#include "recording.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glissade/devices/event_log.h>
#include <glissade/haptics/recording.h>

#include "arrays.h"
#include "for_each.h"
#include "mesh_files.h"
#include "module.h"
#include "unlocked.h"

namespace glissade::python {

namespace {

using Matrix = double[4][4];
using Word = char32_t[16];  // as NumPy has texts of a fixed length

struct TickRow {
  double t_s, lateness_us, duration_us;
  std::int64_t tick, contact_set;
  bool is_stopped;
};
struct PartRow {
  double t_s;
  std::int64_t tick;
  std::int32_t part, contacts;
  Matrix X_WG, X_WV;
  double contact_set_age_s;
  Word state;
};
struct HandRow {
  double t_s;
  std::int64_t tick;
  std::int32_t hand, part;
  double f_W_N[3], t_W_Nm[3];
  double joint_torques_Nm[hands::kJoints];
  double contact_share, state_age_s, command_age_s, energy_J;
  std::int32_t reasons, glove_reasons;
  Matrix X_WH;
  double angles_rad[hands::kJoints];
  Word activity, grasp;
};
struct ContactRow {
  double t_s;
  std::int64_t tick;
  std::int32_t part;
  double p_W_m[3], n_W[3];
};
struct GloveRow {
  double t_s;
  std::int64_t device, sequence;
  Matrix X_WH;
  double v_WH_m_per_s[3], w_WH_rad_per_s[3];
  double angles_rad[hands::kJoints];
  std::int64_t grip;
  bool is_enabled;
  double command_age_s;
};

double seconds_of(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

void copy(const Eigen::Isometry3d& X, Matrix& out) {
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(&out[0][0]);
  matrix = X.matrix();
}
void copy(const Eigen::Vector3d& vector, double (&out)[3]) {
  std::copy_n(vector.data(), 3, +out);
}
void copy(const hands::JointValues& values, double (&out)[hands::kJoints]) {
  std::copy_n(values.data(), values.size(), +out);
}
void copy(std::string_view word, Word& out) {
  std::copy_n(word.begin(), std::min(word.size(), std::size(out)), +out);
}

/// The tables while they are read, without Python objects.
struct Rows {
  std::vector<TickRow> ticks;
  std::vector<PartRow> parts;
  std::vector<HandRow> hands;
  std::vector<ContactRow> contacts;
  std::vector<GloveRow> gloves;
  std::int32_t hand_count = 0;
  std::int32_t part_count = 0;
  std::int64_t unreadable = 0;
  std::string damage;

  void add(const devices::LogEvent& event);
  void add(const haptics::TickRecord& tick);
  void add(const devices::HapticState& state);
  void add(const devices::LoggedState& logged, std::chrono::nanoseconds time);
};

void Rows::add(const devices::LogEvent& event) {
  if (const auto tick = haptics::consumed_by_tick(event)) {
    add(*tick);
  } else if (const auto state = devices::haptic_state_of(event)) {
    add(*state);
  } else if (const auto logged = devices::glove_state_of(event)) {
    add(*logged, event.time);
  } else if (event.channel == "HAPTIC_TICK" || event.channel == "HAPTIC_STATE" || event.channel == "GLOVE_STATE") {
    ++unreadable;
  }
}

void Rows::add(const haptics::TickRecord& tick) {
  ticks.push_back({.t_s = seconds_of(tick.time),
                   .lateness_us = 1e6 * seconds_of(tick.time - tick.deadline),
                   .duration_us = 1e6 * seconds_of(tick.duration),
                   .tick = tick.number,
                   .contact_set = tick.set_sequence,
                   .is_stopped = tick.is_stopped});
}

void Rows::add(const devices::HapticState& state) {
  hand_count = std::max(hand_count, state.hand_count);
  part_count = std::max(part_count, state.part_count);
  for (std::int32_t p = 0; p < state.part_count; ++p) {
    const devices::HapticPartState& part = state.parts[static_cast<std::size_t>(p)];
    PartRow& row = parts.emplace_back(PartRow{.t_s = seconds_of(state.time), .tick = state.sequence, .part = p});
    row.contacts = part.contact_count;
    copy(part.X_WG, row.X_WG);
    copy(part.X_WV, row.X_WV);
    row.contact_set_age_s = seconds_of(state.contact_set_age);
    copy(devices::name_of(part.state), row.state);
  }
  for (std::int32_t h = 0; h < state.hand_count; ++h) {
    const devices::HapticHandState& hand = state.hands[static_cast<std::size_t>(h)];
    HandRow& row = hands.emplace_back(HandRow{.t_s = seconds_of(state.time), .tick = state.sequence, .hand = h});
    row.part = hand.part;
    copy(hand.force_W, row.f_W_N);
    copy(hand.torque_V_W, row.t_W_Nm);
    copy(hand.joint_torques, row.joint_torques_Nm);
    row.contact_share = hand.contact_share;
    row.state_age_s = seconds_of(hand.state_age);
    row.command_age_s = seconds_of(hand.command_age);
    row.energy_J = devices::energy_left(hand);
    row.reasons = devices::to_bits(hand.reasons);
    row.glove_reasons = devices::to_bits(hand.glove_reasons);
    copy(hand.visible.X_WH, row.X_WH);
    copy(hand.visible.angles, row.angles_rad);
    copy(hands::name_of(hand.visible.activity), row.activity);
    copy(hands::name_of(hand.visible.grasp), row.grasp);
  }
  for (std::int32_t c = 0; c < state.contact_count; ++c) {
    const devices::HapticContact& contact = state.contacts[static_cast<std::size_t>(c)];
    ContactRow& row = contacts.emplace_back(ContactRow{.t_s = seconds_of(state.time), .tick = state.sequence});
    row.part = contact.part;
    copy(state.parts[static_cast<std::size_t>(contact.part)].X_WV * contact.p_V.cast<double>(), row.p_W_m);
    copy(contact.n_W.cast<double>(), row.n_W);
  }
}

void Rows::add(const devices::LoggedState& logged, std::chrono::nanoseconds time) {
  const devices::GloveState& state = logged.state;
  GloveRow& row = gloves.emplace_back(
      GloveRow{.t_s = seconds_of(time), .device = logged.device, .sequence = state.sequence, .grip = state.grip});
  copy(state.X_WH, row.X_WH);
  copy(state.v_WH, row.v_WH_m_per_s);
  copy(state.w_WH, row.w_WH_rad_per_s);
  copy(state.joint_angles, row.angles_rad);
  row.is_enabled = state.is_enabled;
  row.command_age_s = seconds_of(state.command_age);
}

/// A field of a row: its name, its type as NumPy writes it, and its place.
struct Field {
  const char* name;
  const char* type;
  std::size_t offset;
};

constexpr const char* kMatrixType = "(4,4)f8";
constexpr const char* kVectorType = "(3,)f8";
constexpr const char* kJointsType = "(22,)f8";
constexpr const char* kWordType = "U16";
static_assert(hands::kJoints == 22 && sizeof(Word) == 16 * 4 && sizeof(bool) == 1);

template <typename Row>
py::array table(const std::vector<Row>& rows, std::initializer_list<Field> fields) {
  py::list names;
  py::list types;
  py::list offsets;
  for (const Field& field : fields) {
    names.append(field.name);
    types.append(field.type);
    offsets.append(field.offset);
  }
  return py::array(py::dtype(names, types, offsets, sizeof(Row)), rows.size(), rows.data());
}

// The fields of a row have the names of its members.
#define GLISSADE_FIELD(Row, member, type) \
  Field {                                 \
#member, type, offsetof(Row, member)  \
  }

py::array ticks_of(const Rows& rows) {
  return table(rows.ticks, {GLISSADE_FIELD(TickRow, tick, "i8"), GLISSADE_FIELD(TickRow, t_s, "f8"),
                            GLISSADE_FIELD(TickRow, lateness_us, "f8"), GLISSADE_FIELD(TickRow, duration_us, "f8"),
                            GLISSADE_FIELD(TickRow, contact_set, "i8"), GLISSADE_FIELD(TickRow, is_stopped, "?")});
}

py::array parts_of(const Rows& rows) {
  return table(rows.parts, {GLISSADE_FIELD(PartRow, t_s, "f8"), GLISSADE_FIELD(PartRow, tick, "i8"),
                            GLISSADE_FIELD(PartRow, part, "i4"), GLISSADE_FIELD(PartRow, X_WG, kMatrixType),
                            GLISSADE_FIELD(PartRow, X_WV, kMatrixType), GLISSADE_FIELD(PartRow, state, kWordType),
                            GLISSADE_FIELD(PartRow, contacts, "i4"), GLISSADE_FIELD(PartRow, contact_set_age_s, "f8")});
}

py::array hands_of(const Rows& rows) {
  return table(
      rows.hands,
      {GLISSADE_FIELD(HandRow, t_s, "f8"), GLISSADE_FIELD(HandRow, tick, "i8"), GLISSADE_FIELD(HandRow, hand, "i4"),
       GLISSADE_FIELD(HandRow, part, "i4"), GLISSADE_FIELD(HandRow, f_W_N, kVectorType),
       GLISSADE_FIELD(HandRow, t_W_Nm, kVectorType), GLISSADE_FIELD(HandRow, joint_torques_Nm, kJointsType),
       GLISSADE_FIELD(HandRow, contact_share, "f8"), GLISSADE_FIELD(HandRow, state_age_s, "f8"),
       GLISSADE_FIELD(HandRow, command_age_s, "f8"), GLISSADE_FIELD(HandRow, energy_J, "f8"),
       GLISSADE_FIELD(HandRow, reasons, "i4"), GLISSADE_FIELD(HandRow, glove_reasons, "i4"),
       GLISSADE_FIELD(HandRow, activity, kWordType), GLISSADE_FIELD(HandRow, grasp, kWordType),
       GLISSADE_FIELD(HandRow, X_WH, kMatrixType), GLISSADE_FIELD(HandRow, angles_rad, kJointsType)});
}

py::array contacts_of(const Rows& rows) {
  return table(rows.contacts, {GLISSADE_FIELD(ContactRow, t_s, "f8"), GLISSADE_FIELD(ContactRow, tick, "i8"),
                               GLISSADE_FIELD(ContactRow, part, "i4"), GLISSADE_FIELD(ContactRow, p_W_m, kVectorType),
                               GLISSADE_FIELD(ContactRow, n_W, kVectorType)});
}

py::array gloves_of(const Rows& rows) {
  return table(
      rows.gloves,
      {GLISSADE_FIELD(GloveRow, t_s, "f8"), GLISSADE_FIELD(GloveRow, device, "i8"),
       GLISSADE_FIELD(GloveRow, sequence, "i8"), GLISSADE_FIELD(GloveRow, X_WH, kMatrixType),
       GLISSADE_FIELD(GloveRow, v_WH_m_per_s, kVectorType), GLISSADE_FIELD(GloveRow, w_WH_rad_per_s, kVectorType),
       GLISSADE_FIELD(GloveRow, grip, "i8"), GLISSADE_FIELD(GloveRow, is_enabled, "?"),
       GLISSADE_FIELD(GloveRow, command_age_s, "f8"), GLISSADE_FIELD(GloveRow, angles_rad, kJointsType)});
}

#undef GLISSADE_FIELD

Rows read_rows(const std::string& file) {
  const Unlocked unlocked;
  Rows rows;
  SignalCheck check;
  devices::EventLogReader log(file);
  while (const std::optional<devices::LogEvent> event = log.next()) {
    rows.add(*event);
    check();
  }
  rows.damage = log.damage();
  return rows;
}

Recording read_recording(const py::object& path) {
  const std::string file = path_from(path);
  const Rows rows = read_rows(file);
  std::string warning = rows.damage;
  if (rows.unreadable > 0)
    warning += (warning.empty() ? file : "; " + file) + ": " + std::to_string(rows.unreadable) +
               " events cannot be read and are left out";
  if (!warning.empty() && PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  return {file,
          ticks_of(rows),
          parts_of(rows),
          hands_of(rows),
          contacts_of(rows),
          gloves_of(rows),
          rows.hand_count,
          rows.part_count};
}

}  // namespace

void add_recording(py::module_& module) {
  py::class_<Recording>(module, "Recording", R"(An event log of a haptic loop as tables.

Each table is a structured array of NumPy: recording.parts["X_WV"] has the shape (n, 4, 4). The names of the fields have
units; docs/python.md lists them.)")
      .def_readonly("path", &Recording::path, "of the file")
      .def_readonly("ticks", &Recording::ticks, "a row for each tick: when it began, and how long it lasted")
      .def_readonly("parts", &Recording::parts, "a row for each tick and part: ghost, visible part and state")
      .def_readonly("hands", &Recording::hands, "a row for each tick and hand: force, torques, grasp and reasons")
      .def_readonly("contacts", &Recording::contacts, "a row for each tick and contact that pushes")
      .def_readonly("gloves", &Recording::gloves, "a row for each measurement of a glove")
      .def("__repr__", [](const Recording& of) {
        return "<glissade.Recording of " + std::to_string(of.ticks.shape(0)) + " ticks>";
      });
  module.def("read_recording", &read_recording, py::arg("path"),
             R"(Reads an event log: of HapticServer(record=...), of the program `glissade`, or of lcm-logger.

Reads up to the first damage; damage and events that cannot be read are a Python warning. Raises ValueError, naming the
file, for a file that is no event log. For tables (CSV) of the program, use numpy.genfromtxt.)");
}

}  // namespace glissade::python
