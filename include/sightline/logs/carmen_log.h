#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sightline/config/error.h"
#include "sightline/geometry/pose2.h"
#include "sightline/logs/line_reader.h"

/// Logs of the Carnegie Mellon robot navigation toolkit: one message a line.
namespace sightline::logs {

/// Velocity along the robot's heading [m/s], turning rate [rad/s].
struct CarmenVelocity {
  double translation = 0.0;
  double rotation = 0.0;
};

/// FLASER (front laser, field of view by the number of beams) or ROBOTLASER1 (which states it).
struct CarmenLaser {
  std::int64_t stamp = 0;           ///< ipc_time [ns]
  double angle_min = 0.0;           ///< [rad], from straight ahead
  double angle_increment = 0.0;     ///< [rad]
  std::optional<double> range_max;  ///< [m]; readings from here on are "nothing"
  std::vector<float> ranges;        ///< [m] as logged
  std::vector<float> remissions;    ///< empty or one a beam
  geometry::Pose2 robot;            ///< in the odometry frame, as of the logger
  std::optional<CarmenVelocity> velocity;
};

/// ODOM
struct CarmenOdometry {
  std::int64_t stamp = 0;  ///< ipc_time [ns]
  geometry::Pose2 robot;   ///< in the odometry frame
  CarmenVelocity velocity;
};

/// PARAM
struct CarmenParameter {
  std::string name;
  std::string value;
};

using CarmenMessage = std::variant<CarmenLaser, CarmenOdometry, CarmenParameter>;

/// One line of a log; nothing for comments and kinds that are not read. Throws config::Error with
/// `source`, line number and kind where a line of a known kind cannot be understood.
std::optional<CarmenMessage> parseCarmenLine(const std::string& line, const std::string& source,
                                             int number);

/// Reads a log, plain or gzip, message by message.
class CarmenReader {
 public:
  /// Throws config::Error if the file cannot be opened.
  explicit CarmenReader(const std::string& path) : lines_(path) {}

  /// The next message that is read; nothing at the end, which is also where a log is cut off. A
  /// line that cannot be understood is passed over. Throws config::Error on damaged compression and
  /// on what is no text.
  std::optional<CarmenMessage> next();

  /// Number of lines that could not be understood, and the fault of the first of them.
  std::size_t badLines() const { return bad_lines_; }
  const std::string& firstFault() const { return first_fault_; }
  /// Description of the place where the log is cut off; empty if it is whole.
  const std::string& cutOff() const { return cut_off_; }
  /// Number of lines of each kind that is not read.
  const std::map<std::string, std::size_t>& skipped() const { return skipped_; }

 private:
  void skip();
  void sayCutOff(const std::string& sign);
  void noteFault(const config::Error& error);

  LineReader lines_;
  std::string line_;
  std::size_t bad_lines_ = 0;
  std::string first_fault_;
  std::string cut_off_;
  std::map<std::string, std::size_t> skipped_;
};

/// A whole log, scans and odometry each in the order of their lines: stamps may be late and go back
/// (carmen_stamps.h), be zero or negative.
struct CarmenLog {
  std::vector<CarmenLaser> scans;
  std::vector<CarmenOdometry> odometry;
  std::map<std::string, std::string> parameters;
  std::map<std::string, std::size_t> skipped;  ///< lines of kinds that are not read
  std::size_t bad_lines = 0;                   ///< that could not be understood
  std::string first_fault;                     ///< what was wrong with the first of them, and where
  std::string cut_off;                         ///< where and how, empty if the log is whole
};

/// Throws config::Error where the file cannot be read.
CarmenLog readCarmenLog(const std::string& path);

}  // namespace sightline::logs
