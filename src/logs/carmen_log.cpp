#include "sightline/logs/carmen_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "sightline/logs/fields.h"

namespace sightline::logs {

namespace {

using geometry::Pose2;
using geometry::radians;

// More beams than any scanner has, so that a damaged number does not become an allocation.
constexpr std::size_t kMostBeams = 100'000;

constexpr std::size_t kLongestKind = 32;

// Kinds of messages are written in capitals, as ROBOTLASER1 and SYNC are.
bool couldBeKind(const std::string& word) {
  const auto is_capital = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return word.size() <= kLongestKind && std::all_of(word.begin(), word.end(), is_capital);
}

struct BeamLayout {
  double angle_min;
  double angle_increment;
};

// FLASER lines do not state the field of view. CARMEN takes it from the number of beams, which on a
// SICK LMS tells its mode: 1° and 0.5° over 180°, with or without the last beam, and 0.25° over
// 100°.
BeamLayout layoutOf(std::size_t beams) {
  switch (beams) {
    case 180:
    case 181:
      return {radians(-90.0), radians(1.0)};
    case 360:
    case 361:
      return {radians(-90.0), radians(0.5)};
    case 401:
      return {radians(-50.0), radians(0.25)};
    default:
      return {radians(-90.0), radians(180.0) / static_cast<double>(beams - 1)};
  }
}

std::vector<float> readValues(Fields& fields, std::size_t count, const char* name) {
  std::vector<float> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(fields.number(name)));
  }
  return values;
}

Pose2 readPose(Fields& fields) {
  const double x = fields.finite("x");
  const double y = fields.finite("y");
  return {x, y, fields.finite("theta")};
}

CarmenVelocity readVelocity(Fields& fields) {
  const double translation = fields.finite("tv");
  return {translation, fields.finite("rv")};
}

// Time and host end every line that CARMEN logs, but for the logger's own time, which is not
// needed.
std::int64_t readStamp(Fields& fields) {
  const std::int64_t stamp = fields.stamp("ipc_time");
  constexpr std::int64_t kMostSeconds = std::numeric_limits<std::uint32_t>::max();
  if (std::abs(stamp / 1'000'000'000) > kMostSeconds) {
    fields.fail(fmt::format("ipc_time: {} is no time that a bag can hold", formatStamp(stamp)));
  }
  fields.word("ipc_host");
  return stamp;
}

CarmenLaser readFrontLaser(Fields& fields) {
  CarmenLaser laser;
  const std::size_t beams = fields.count("num_readings", kMostBeams);
  if (beams < 2) fields.fail(fmt::format("num_readings: {} beams make no scan", beams));
  const BeamLayout layout = layoutOf(beams);
  laser.angle_min = layout.angle_min;
  laser.angle_increment = layout.angle_increment;
  laser.ranges = readValues(fields, beams, "a reading");
  readPose(fields);  // of the laser: the robot's with a mounting that the log may have wrong
  laser.robot = readPose(fields);
  laser.stamp = readStamp(fields);
  return laser;
}

void readScanner(Fields& fields, CarmenLaser& laser) {
  fields.number("laser_type");
  laser.angle_min = fields.finite("start_angle");
  fields.finite("field_of_view");
  laser.angle_increment = fields.finite("angular_resolution");
  if (laser.angle_increment == 0.0) fields.fail("angular_resolution: has to differ from zero");
  const double range_max = fields.finite("maximum_range");
  if (range_max > 0.0) laser.range_max = range_max;
  fields.number("accuracy");
  fields.number("remission_mode");
}

void readReadings(Fields& fields, CarmenLaser& laser) {
  const std::size_t beams = fields.count("num_readings", kMostBeams);
  if (beams == 0) fields.fail("num_readings: no beams");
  laser.ranges = readValues(fields, beams, "a reading");
  const std::size_t remissions = fields.count("num_remissions", kMostBeams);
  if (remissions != 0 && remissions != beams) {
    fields.fail(fmt::format("num_remissions: {} for {} readings", remissions, beams));
  }
  laser.remissions = readValues(fields, remissions, "a remission");
}

CarmenLaser readRobotLaser(Fields& fields) {
  CarmenLaser laser;
  readScanner(fields, laser);
  readReadings(fields, laser);
  readPose(fields);  // of the laser
  laser.robot = readPose(fields);
  laser.velocity = readVelocity(fields);
  for (const char* name : {"forward_safety_dist", "side_safety_dist", "turn_axis"}) {
    fields.number(name);
  }
  laser.stamp = readStamp(fields);
  return laser;
}

CarmenOdometry readOdometry(Fields& fields) {
  CarmenOdometry odometry;
  odometry.robot = readPose(fields);
  odometry.velocity = readVelocity(fields);
  fields.number("accel");
  odometry.stamp = readStamp(fields);
  return odometry;
}

CarmenParameter readParameter(Fields& fields) {
  const std::string name = fields.word("param_name");
  return {name, fields.atEnd() ? "" : fields.word("param_value")};
}

}  // namespace

std::optional<CarmenMessage> parseCarmenLine(const std::string& line, const std::string& source,
                                             int number) {
  Fields fields(line, source, number);
  if (fields.atEnd()) return std::nullopt;
  const std::string kind = fields.word("the kind");
  fields.setKey(kind);
  if (kind == "FLASER") return readFrontLaser(fields);
  if (kind == "ROBOTLASER1") return readRobotLaser(fields);
  if (kind == "ODOM") return readOdometry(fields);
  if (kind == "PARAM") return readParameter(fields);
  return std::nullopt;
}

void CarmenReader::skip() {
  Fields fields(line_, lines_.path(), lines_.number());
  if (fields.atEnd()) return;
  const std::string kind = fields.word("the kind");
  if (kind[0] == '#') return;
  if (lines_.isUnterminated() || !couldBeKind(kind)) {
    fields.fail(fmt::format("no message starts with '{}'", kind.substr(0, kLongestKind)));
  }
  ++skipped_[kind];
}

void CarmenReader::sayCutOff(const std::string& sign) {
  cut_off_ = fmt::format("{}:{}: the log is cut off in the middle of a line ({})", lines_.path(),
                         lines_.number(), sign);
}

void CarmenReader::noteFault(const config::Error& error) {
  if (lines_.isUnterminated()) {
    sayCutOff(error.key().empty() ? error.reason() : error.key() + ": " + error.reason());
  } else if (bad_lines_++ == 0) {
    first_fault_ = error.what();
  }
}

std::optional<CarmenMessage> CarmenReader::next() {
  while (lines_.next(line_)) {
    try {
      if (auto message = parseCarmenLine(line_, lines_.path(), lines_.number())) return message;
      skip();
    } catch (const config::Error& error) {
      noteFault(error);
    }
  }
  if (cut_off_.empty() && lines_.isCutOff()) {
    cut_off_ = fmt::format("{}:{}: the log is cut off: its compressed data end too early",
                           lines_.path(), lines_.number());
  }
  return std::nullopt;
}

CarmenLog readCarmenLog(const std::string& path) {
  CarmenLog log;
  CarmenReader reader(path);
  while (auto message = reader.next()) {
    if (auto* laser = std::get_if<CarmenLaser>(&*message)) log.scans.push_back(std::move(*laser));
    if (auto* odometry = std::get_if<CarmenOdometry>(&*message)) log.odometry.push_back(*odometry);
    if (auto* parameter = std::get_if<CarmenParameter>(&*message)) {
      log.parameters[parameter->name] = parameter->value;
    }
  }
  log.skipped = reader.skipped();
  log.bad_lines = reader.badLines();
  log.first_fault = reader.firstFault();
  log.cut_off = reader.cutOff();
  return log;
}

}  // namespace sightline::logs
