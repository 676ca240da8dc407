#include <cmath>
#include <filesystem>

#include "sightline/bridge/known_looks.h"
#include "sightline/plot/figure.h"

namespace sightline::bridge {

namespace {

using targets::Characterization;

void drawPanel(const plot::Panel& panel, const std::string& folder, const char* name) {
  plot::Figure figure;
  figure.panels = {panel};
  plot::writePng(figure, (std::filesystem::path(folder) / name).string());
}

plot::Panel detectionPanel(const Characterization& found, double beam_spacing) {
  plot::Series shares{"share of each bin", plot::Style::kPoints, {}};
  plot::Series model{"best fit of eq. 1", plot::Style::kLine, {}};
  const auto& fit = found.paper_detection;
  for (const auto& bin : found.bins) {
    shares.points.push_back({bin.range, bin.share()});
    const double covered = std::min(1.0, fit.target_diameter / (bin.range * beam_spacing));
    model.points.push_back({bin.range, (1.0 - fit.false_negative) * covered});
  }
  return {"Detection model (figure 5b)",
          "range [m]",
          "probability of detection",
          "",
          0.0,
          {shares, model}};
}

plot::Panel sweepPanel(const Characterization& found) {
  plot::Series error{"sum of squared errors", plot::Style::kLineAndPoints, {}};
  plot::Series inliers{
      "share of measurements that are detections", plot::Style::kLineAndPoints, {}};
  for (const auto& point : found.sweep) {
    error.points.push_back({geometry::degrees(point.sigma), point.error});
    inliers.points.push_back({geometry::degrees(point.sigma), point.inlier_share});
  }
  return {"Sweep of sigma (figure 6)", "sigma [deg]", "", "", 0.0, {error, inliers}};
}

plot::Panel clutterPanel(const Characterization& found, const targets::FieldOfView& view) {
  plot::Series density{"bins", plot::Style::kPoints, {}};
  plot::Series model{"best fit of eq. 3", plot::Style::kLine, {}};
  const auto& fit = found.paper_clutter;
  for (const auto& bin : found.clutter_bins) {
    const double middle = 0.5 * (bin.from + bin.to);
    const bool is_peak = std::abs(std::abs(middle) - 0.5 * geometry::kPi) <= 0.5 * fit.peak_width;
    const double peak = is_peak ? (1.0 - fit.uniform_share) / (2.0 * fit.peak_width) : 0.0;
    density.points.push_back({middle, bin.density});
    model.points.push_back({middle, fit.uniform_share / view.width() + peak});
  }
  return {
      "Clutter model (figure 7b)", "bearing [rad]", "density [1/rad]", "", 0.0, {density, model}};
}

plot::Panel countPanel(const Characterization& found) {
  plot::Series counts{"share of looks", plot::Style::kPoints, {}};
  plot::Series model{"Poisson", plot::Style::kLineAndPoints, {}};
  const auto looks = static_cast<double>(found.looks);
  const double mean = found.clutter.mean.value;
  for (std::size_t i = 0; i < found.clutter_counts.size(); ++i) {
    const auto count = static_cast<double>(i);
    counts.points.push_back({count, found.clutter_counts[i] / looks});
    const double log_share =
        count * std::log(std::max(mean, 1e-12)) - mean - std::lgamma(count + 1.0);
    model.points.push_back({count, std::exp(log_share)});
  }
  return {"Clutter cardinality (figure 8)",
          "clutter measurements a look",
          "share of looks",
          "",
          0.0,
          {counts, model}};
}

}  // namespace

void drawCharacterization(const Characterization& found,
                          const targets::CharacterizationConfig& config,
                          const std::string& folder) {
  drawPanel(detectionPanel(found, config.beam_spacing), folder, "detection.png");
  drawPanel(sweepPanel(found), folder, "sigma.png");
  drawPanel(clutterPanel(found, config.field_of_view), folder, "clutter.png");
  drawPanel(countPanel(found), folder, "cardinality.png");
}

}  // namespace sightline::bridge
