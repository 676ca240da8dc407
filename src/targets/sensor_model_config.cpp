#include "sightline/targets/sensor_model_config.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "sightline/config/error.h"

namespace sightline::targets {

namespace {

constexpr config::Range kProbability{0.0, 1.0};
constexpr config::Range kBearing{-geometry::kPi, geometry::kPi};

bool isRising(const std::vector<double>& edges) {
  return edges.size() >= 2 &&
         std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()) == edges.end();
}

void checkTable(const DetectionTable& table, const std::string& source) {
  const auto refuse = [&](const char* key, const std::string& reason) {
    throw config::Error(source, 0, std::string("detection.table.") + key, reason);
  };
  if (!isRising(table.range_edges)) refuse("range_edges", "two or more rising numbers are needed");
  if (!isRising(table.bearing_edges)) refuse("bearing_edges", "two or more rising ones are needed");
  const std::size_t bins = (table.range_edges.size() - 1) * (table.bearing_edges.size() - 1);
  if (table.probabilities.size() == bins) return;
  refuse("probabilities",
         fmt::format("{} numbers where the edges make {} bins", table.probabilities.size(), bins));
}

void checkDistortion(const DistortionConfig& distortion, const std::string& source) {
  const auto refuse = [&](const char* key, const char* reason) {
    throw config::Error(source, 0, std::string("bearing.distortion.") + key, reason);
  };
  if (!isRising(distortion.bearings)) refuse("bearings", "two or more rising numbers are needed");
  if (distortion.errors.size() != distortion.bearings.size()) refuse("errors", "one a bearing");
}

// The bin of a value; nothing outside.
std::optional<std::size_t> binOf(const std::vector<double>& edges, double value) {
  if (!(value >= edges.front() && value <= edges.back())) return std::nullopt;
  const auto above = std::upper_bound(edges.begin(), edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin()) - 1;
}

}  // namespace

FieldOfView FieldOfView::within(const FieldOfView& other) const {
  return {std::max(min, other.min), std::min(max, other.max)};
}

void FieldOfView::visit(config::FieldVisitor& visitor) {
  visitor.number("min", min, {"rad", kBearing, "rightmost bearing, b_min (dames eq. 1)"});
  visitor.number("max", max, {"rad", kBearing, "leftmost bearing, b_max (dames eq. 1)"});
}

double DetectionTable::at(double range, double bearing) const {
  const auto row = binOf(range_edges, range);
  const auto column = binOf(bearing_edges, bearing);
  if (!row || !column) return 0.0;
  return probabilities[*row * (bearing_edges.size() - 1) + *column];
}

void DetectionTable::visit(config::FieldVisitor& visitor) {
  visitor.numbers("range_edges", range_edges,
                  {"m", {0.0, 1e6}, "edges of the bins of range, rising"});
  visitor.numbers("bearing_edges", bearing_edges,
                  {"rad", kBearing, "edges of the bins of bearing, rising"});
  visitor.numbers("probabilities", probabilities,
                  {"1", kProbability, "one a bin, the bearings of the first range first"});
}

void DetectionConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("false_negative", false_negative,
                 {"1", kProbability, "probability of a miss at any range, p_fn (dames eq. 1)"});
  visitor.number("target_diameter", target_diameter,
                 {"m", {0.0, 10.0}, "effective diameter of a target, d_t (dames eq. 1)"});
  visitor.number("beam_spacing", beam_spacing,
                 {"rad", {1e-6, 1.0}, "angle between two beams, theta_sep (dames eq. 1)"});
  visitor.number("range_min", range_min, {"m", {0.0, 1e6}, "nearer ones are not seen"});
  visitor.number("range_max", range_max,
                 {"m", {1e-3, 1e4}, "farther ones are not seen, r_max (dames eq. 1)"});
  visitor.group("table", table);
}

void VisibilityConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("share", share,
                 {"1",
                  {0.01, 1.0},
                  "of the time in which a robot can see a target in view at all; 1: each look is "
                  "independent of the last"});
  visitor.number("duration", duration,
                 {"s", {1e-3, 1e5}, "time constant after which it may be otherwise"});
}

double DistortionConfig::at(double bearing) const {
  const double inside = std::clamp(bearing, bearings.front(), bearings.back());
  const std::size_t left = binOf(bearings, inside).value();
  const double share = (inside - bearings[left]) / (bearings[left + 1] - bearings[left]);
  return errors[left] + share * (errors[left + 1] - errors[left]);
}

void DistortionConfig::visit(config::FieldVisitor& visitor) {
  visitor.numbers("bearings", bearings, {"rad", kBearing, "true bearings, rising"});
  visitor.numbers("errors", errors,
                  {"rad", {-1.0, 1.0}, "measured less true bearing at each of them, besides bias"});
}

// Errors change so little over one of them that two steps suffice.
double BearingConfig::trueBearing(double measured) const {
  const double first = geometry::wrapAngle(measured - biasAt(measured));
  return geometry::wrapAngle(measured - biasAt(first));
}

void BearingConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("sigma", sigma,
                 {"rad", {1e-6, 1.0}, "standard deviation of a bearing, sigma (dames eq. 2)"});
  visitor.number("bias", bias, {"rad", {-1.0, 1.0}, "measured less true bearing"});
  visitor.group("distortion", distortion);
  visitor.number(
      "lag", lag,
      {"s", {-10.0, 10.0}, "time that looks are stamped late, made good by the turn rate"});
  visitor.number(
      "jitter", jitter,
      {"s", {0.0, 10.0}, "standard deviation of that time, by which bearings err more in turns"});
  visitor.number("tail", tail,
                 {"1",
                  {1.0, 10.0},
                  "standard deviation of all errors over sigma, for errors with heavy tails"});
  visitor.number("common_share", common_share,
                 {"1",
                  {0.0, 0.99},
                  "share of the variance that the bearings of one look have in common, as of a "
                  "heading that is off; 0: each errs by itself"});
  visitor.number("lasting_share", lasting_share,
                 {"1",
                  {0.0, 0.99},
                  "share of the variance of errors that last over a robot's looks; more looks "
                  "from one place do not average them out"});
  visitor.number("lasting_duration", lasting_duration,
                 {"s", {1e-3, 1e6}, "time constant after which these are other ones"});
  visitor.number("place_sigma", place_sigma,
                 {"m",
                  {0.0, 10.0},
                  "standard deviation, in x and in y, of where a target is from where all bearings "
                  "see it; part of the covariance of every target"});
}

void ClutterConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("mean", mean,
                 {"1", {0.0, 1e4}, "expected clutter measurements a look, mu (dames eq. 3)"});
  visitor.number("uniform_share", uniform_share,
                 {"1", kProbability, "share spread over the field of view, p_u (dames eq. 3)"});
  visitor.number(
      "peak_width", peak_width,
      {"rad", {0.0, geometry::kPi}, "width of the peaks at +-pi/2, theta_c (dames eq. 3)"});
  visitor.number(
      "glint_share", glint_share,
      {"1", kProbability,
       "share of the clutter that comes of surfaces that shine towards one side, such as "
       "bare metal, in every look from there; 0: looks are independent"});
  visitor.number("glint_width", glint_width,
                 {"rad", {1e-4, geometry::kPi}, "standard deviation of that side"});
  visitor.number("faint_share", faint_share,
                 {"1", kProbability,
                  "share of the clutter that comes of things that are seen from all sides, but "
                  "seldom, such as poles of bare metal; with glint_share 1 at most"});
  visitor.number("faint_detection", faint_detection,
                 {"1", kProbability, "probability that such a thing is seen over a target's"});
}

void SensorModelConfig::visit(config::FieldVisitor& visitor) {
  visitor.group("field_of_view", field_of_view);
  visitor.group("detection", detection);
  visitor.group("visibility", visibility);
  visitor.group("bearing", bearing);
  visitor.group("clutter", clutter);
}

void SensorModelConfig::check(const std::string& source) const {
  config::validate(*this, source);
  const auto refuse = [&](const char* key, const char* reason) {
    throw config::Error(source, 0, key, reason);
  };
  if (field_of_view.width() <= 0.0) refuse("field_of_view", "max has to be above min");
  if (detection.range_min >= detection.range_max)
    refuse("detection.range_min", "not below range_max");
  if (detection.table) checkTable(*detection.table, source);
  if (bearing.distortion) checkDistortion(*bearing.distortion, source);
  if (clutter.glint_share + clutter.faint_share > 1.0) {
    refuse("clutter.faint_share", "with glint_share above 1");
  }
  if (clutter.uniform_share == 1.0) return;
  if (clutter.peak_width == 0.0) refuse("clutter.peak_width", "0 with a share in the peaks");
  const double edge = 0.5 * (geometry::kPi + clutter.peak_width);
  if (field_of_view.min <= -edge && field_of_view.max >= edge) return;
  refuse("clutter.peak_width",
         "the peaks leave the field of view: the clutter does not integrate to its mean");
}

SensorModelConfig SensorModelConfig::readFile(const std::string& path) {
  SensorModelConfig config;
  config::read(config::Node::readFile(path), config);
  config.check(path);
  return config;
}

}  // namespace sightline::targets
