#include "sightline/motion/head_command.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace sightline::motion {

namespace {

constexpr double kRounding = 1e-6;  // of a step, so that a limit that is one counts as one

std::string faultOfPosition(const HeadLimits& limits, double position) {
  if (!std::isfinite(position)) return "a position that is not finite";
  if (position >= limits.lower && position <= limits.upper) return "";
  return fmt::format("a position of {:.4f} rad, beyond the limits [{:.4f}, {:.4f}]", position,
                     limits.lower, limits.upper);
}

std::string faultOfRate(const HeadLimits& limits, double rate) {
  if (!std::isfinite(rate)) return "a rate that is not finite";
  if (std::abs(rate) <= limits.max_rate) return "";
  return fmt::format("a rate of {:.4f} rad/s, beyond the limit {:.4f}", rate, limits.max_rate);
}

}  // namespace

void HeadLimits::visit(config::FieldVisitor& visitor) {
  const config::Range turn{-geometry::kPi, geometry::kPi};
  visitor.number("lower", lower, {"rad", turn, "limit of the head's joint, clockwise"});
  visitor.number("upper", upper, {"rad", turn, "limit of the head's joint, counter-clockwise"});
  visitor.number("max_rate", max_rate, {"rad/s", {1e-3, 1e3}, "of the head"});
  visitor.number("acceleration", acceleration, {"rad/s^2", {1e-3, 1e6}, "of the head"});
  visitor.number("resolution", resolution,
                 {"rad", {1e-6, 0.1}, "of commanded and reported positions (pears table 1)"});
}

void HeadLimits::check(const std::string& source) const {
  config::validate(*this, source);
  if (lower >= upper) throw config::Error(source, 0, "lower", "is not below upper");
}

double HeadLimits::rounded(double position) const {
  const double step = std::round(position / resolution);
  return resolution * std::clamp(step, std::ceil(lower / resolution - kRounding),
                                 std::floor(upper / resolution + kRounding));
}

std::string HeadLimits::fault(const HeadCommand& command) const {
  if (command.mode == HeadCommand::Mode::kStop) return "";
  if (command.mode == HeadCommand::Mode::kPosition) {
    const std::string fault = faultOfPosition(*this, command.position);
    if (!fault.empty()) return fault;
    if (command.rate < 0.0) return "a rate below 0 on the way to a position; it has no sense there";
  }
  return faultOfRate(*this, command.rate);
}

}  // namespace sightline::motion
