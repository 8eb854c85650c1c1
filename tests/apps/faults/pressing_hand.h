#pragma once

/// A server and a glove as processes of their own: the hand presses a box on a plate. A test disturbs them; afterwards
/// the record of the glove tells what the hand got.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "process.h"
#include "relay.h"
#include "temporary_folder.h"

namespace glissade::test_support {

/// A period of the glove.
struct GlovePeriod {
  double t = 0.0;  ///< s, on the clock of `monotonic_now`
  Eigen::Vector3d f_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_W = Eigen::Vector3d::Zero();
  std::string reason;
};

/// What a glove's hand got.
class GloveRecord {
 public:
  explicit GloveRecord(const std::string& file);

  const std::vector<GlovePeriod>& periods() const { return periods_; }
  std::vector<GlovePeriod> between(std::chrono::nanoseconds first, std::chrono::nanoseconds last) const;

 private:
  std::vector<GlovePeriod> periods_;
};

/// A hand presses with more than this force.
inline constexpr double kPressing_N = 5.0;

/// The greatest force of these periods.
double greatest_force(const std::vector<GlovePeriod>& periods);
/// The greatest force along the plate.
double greatest_sideways(const std::vector<GlovePeriod>& periods);

/// What the server and the first glove are started with.
struct PressingHandOptions {
  int plate_triangles = 200;
  int box_triangles = 12;
  /// Rows of the hand's script from 0.3 s on; empty: the hand presses 30 mm deep and stays there.
  std::string motion{};
  std::string more_objects{};  ///< of the scene, in lines of their own
  std::vector<std::string> glove_options{};
  std::string preload{};  ///< a library that is loaded into the server
};

class PressingHand {
 public:
  /// Starts relay, glove and server, and waits until the hand presses.
  explicit PressingHand(const PressingHandOptions& options = {});

  Relay& relay() { return relay_; }
  Process& server() { return *server_; }
  Process& glove() { return *glove_; }

  /// Another server for the same glove.
  std::unique_ptr<Process> start_server() const;
  /// A glove whose hand starts at `x_m`, and presses there. The record goes to `record`.
  std::unique_ptr<Process> start_glove(double x_m, const std::string& record, const std::string& device = "1") const;

  /// Ends the glove and reads its record.
  GloveRecord end_glove();
  /// Ends the server; returns what it wrote to standard error.
  std::string end_server();

  const TemporaryFolder& folder() const { return folder_; }

 private:
  PressingHandOptions options_;
  TemporaryFolder folder_;
  Relay relay_;
  std::unique_ptr<Process> glove_;
  std::unique_ptr<Process> server_;
};

}  // namespace glissade::test_support
