#include <algorithm>

#include <fmt/format.h>

#include "sightline/targets/characterization.h"

namespace sightline::targets {

namespace {

constexpr double kReportInch = 0.0254;

std::string fittedText(const char* name, const Fitted& fitted, double unit, const char* unit_name) {
  if (!fitted.is_determined) return fmt::format("{}: undetermined by these data", name);
  return fmt::format("{}: {:.4g} [{:.4g}, {:.4g}] {}", name, fitted.value / unit, fitted.low / unit,
                     fitted.high / unit, unit_name);
}

void addPaper(const Characterization& found, std::vector<std::string>& lines) {
  const std::size_t detected = found.paper_labels.detected;
  const std::size_t tried = found.paper_labels.opportunities.size();
  const std::size_t clutter = found.paper_labels.clutter.size();
  lines.push_back("by the procedure of the paper, all robots together:");
  lines.push_back(fmt::format("  {} looks, {} measurements: {} detections, {} misses, {} clutter",
                              found.looks, found.paper_labels.measurements, detected,
                              tried - detected, clutter));
  lines.push_back(fmt::format(
      "  overall p_d {:.3f}, mu {:.4f}",
      static_cast<double>(detected) / static_cast<double>(std::max<std::size_t>(tried, 1)),
      static_cast<double>(clutter) / static_cast<double>(found.looks)));
  lines.push_back(fmt::format(
      "  p_fn {:.3f}, d_t {:.2f} in, theta_c {:.4f} pi rad, p_u {:.3f}",
      found.paper_detection.false_negative, found.paper_detection.target_diameter / kReportInch,
      found.paper_clutter.peak_width / geometry::kPi, found.paper_clutter.uniform_share));
}

void addLikelihood(const Characterization& found, std::vector<std::string>& lines) {
  const DetectionLikelihood& detection = found.detection;
  lines.push_back("by maximum likelihood, with 95 % intervals:");
  lines.push_back("  " + fittedText("p_fn", detection.false_negative, 1.0, ""));
  lines.push_back("  " + fittedText("d_t", detection.target_diameter, kReportInch, "in"));
  lines.push_back(fmt::format("  eq. 1 is {}: deviance {:.0f} from the bins, limit {:.0f}",
                              detection.isRefused() ? "refused" : "not refused", detection.deviance,
                              detection.limit));
  lines.push_back("  " + fittedText("mu", found.clutter.mean, 1.0, "a look"));
  lines.push_back("  " + fittedText("theta_c", found.clutter.peak_width, geometry::kPi, "pi rad"));
  lines.push_back("  " + fittedText("p_u", found.clutter.uniform_share, 1.0, ""));
}

void addRobot(const std::string& name, const RobotCharacter& robot,
              std::vector<std::string>& lines) {
  const ErrorFit& errors = robot.errors;
  lines.push_back(
      fmt::format("{}: {} looks, p_d {:.3f}", name, robot.looks,
                  static_cast<double>(robot.detected) /
                      static_cast<double>(std::max<std::size_t>(robot.opportunities, 1))));
  if (errors.sigma > 0.0) {
    lines.push_back(fmt::format(
        "  sigma {:.3f} deg, bias {:.3f} deg, lag {:.1f} +- {:.1f} ms, jitter {:.1f} ms, with "
        "tails {:.2f} times sigma; errors last: the mean of many has {:.1f} times the variance",
        geometry::degrees(errors.sigma), geometry::degrees(errors.bias), 1e3 * errors.lag,
        1e3 * errors.lag_sigma, 1e3 * errors.jitter, errors.tail, robot.error_inflation));
    lines.push_back(fmt::format(
        "  of their variance {:.0f} % is common to a look, {:.0f} % lasts, forgotten in {:.1f} s",
        100.0 * robot.shared.common_share, 100.0 * robot.shared.lasting_share,
        robot.shared.lasting_duration));
    if (errors.distortion) {
      const auto& by_bearing = errors.distortion->errors;
      const auto [low, high] = std::minmax_element(by_bearing.begin(), by_bearing.end());
      lines.push_back(fmt::format("  the bias depends on the bearing: {:.3f} to {:.3f} deg",
                                  geometry::degrees(errors.bias + *low),
                                  geometry::degrees(errors.bias + *high)));
    }
  } else {
    lines.push_back("  sigma, bias, lag: undetermined by so few detections");
  }
  lines.push_back(fmt::format("  field of view {:.3f} to {:.3f} rad, nearest {:.2f} m",
                              robot.view.min, robot.view.max, robot.nearest));
  lines.push_back(fmt::format(
      "  looks nearly independent after {:.1f} s; visible share {:.2f}, forgotten in {:.1f} s",
      robot.independent_after, robot.visibility.share, robot.visibility.duration));
  lines.push_back(fmt::format("  clutter {:.4f} a look, besides {} bearings at other robots",
                              robot.clutter_mean, robot.at_mates));
}

}  // namespace

std::vector<std::string> Characterization::report() const {
  std::vector<std::string> lines;
  addPaper(*this, lines);
  addLikelihood(*this, lines);
  for (const auto& [name, robot] : robots) addRobot(name, robot, lines);
  if (!robots.empty()) {
    lines.push_back(
        fmt::format("targets are {:.3f} m in x and in y from where all bearings see them",
                    robots.begin()->second.place_sigma));
  }
  return lines;
}

}  // namespace sightline::targets
