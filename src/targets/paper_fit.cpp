#include "sightline/targets/paper_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sightline::targets {

namespace {

constexpr double kInch = 0.0254;
constexpr int kShareSteps = 200;  // of 0.005

double length(double from, double to, double low, double high) {
  return std::max(0.0, std::min(to, high) - std::max(from, low));
}

}  // namespace

std::vector<RangeBin> binByRange(const std::vector<Opportunity>& opportunities, double width) {
  std::map<int, RangeBin> bins;
  for (const Opportunity& opportunity : opportunities) {
    const int index = static_cast<int>(opportunity.place.range / width);
    RangeBin& bin = bins[index];
    bin.range = (index + 0.5) * width;
    bin.tried += 1.0;
    bin.detected += opportunity.is_detected ? 1.0 : 0.0;
  }
  std::vector<RangeBin> result;
  for (const auto& [index, bin] : bins) result.push_back(bin);
  return result;
}

DetectionFit fitDetection(const std::vector<RangeBin>& bins, double beam_spacing) {
  DetectionFit best{0.0, 0.0, 1e300};
  for (int d = 0; d <= 200; ++d) {
    const double diameter = 0.01 * d * kInch;
    for (int p = 0; p <= kShareSteps; ++p) {
      const double seen = 1.0 - 0.005 * p;
      double error = 0.0;
      for (const RangeBin& bin : bins) {
        const double covered = std::min(1.0, diameter / (bin.range * beam_spacing));
        const double off = bin.share() - seen * covered;
        error += off * off;
      }
      if (error < best.error) best = {0.005 * p, diameter, error};
    }
  }
  return best;
}

std::vector<ClutterBin> binClutter(const std::vector<ClutterBearing>& clutter,
                                   const FieldOfView& view) {
  const auto count =
      static_cast<std::size_t>(std::ceil(view.width() / (geometry::kPi / 20.0) - 1e-9));
  std::vector<ClutterBin> bins(std::max<std::size_t>(count, 1));
  const double width = view.width() / static_cast<double>(bins.size());
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].from = view.min + static_cast<double>(i) * width;
    bins[i].to = bins[i].from + width;
  }
  double inside = 0.0;
  for (const ClutterBearing& one : clutter) {
    if (!view.contains(one.bearing)) continue;
    const auto bin = static_cast<std::size_t>((one.bearing - view.min) / width);
    bins[std::min(bin, bins.size() - 1)].density += 1.0;
    inside += 1.0;
  }
  for (ClutterBin& bin : bins) bin.density /= std::max(inside, 1.0) * width;
  return bins;
}

ClutterFit fitClutter(const std::vector<ClutterBin>& bins, const FieldOfView& view) {
  ClutterFit best{0.0, 1.0, 1e300};
  for (int w = 0; w <= 200; ++w) {
    const double width = w * geometry::kPi / 400.0;
    std::vector<double> peaks;  // mean density of the peaks over each bin
    for (const ClutterBin& bin : bins) {
      double covered = 0.0;
      for (const double side : {-0.5, 0.5}) {
        const double middle = side * geometry::kPi;
        covered += length(bin.from, bin.to, middle - 0.5 * width, middle + 0.5 * width);
      }
      peaks.push_back(w > 0 ? covered / (2.0 * width * (bin.to - bin.from)) : 0.0);
    }
    for (int p = 0; p <= kShareSteps; ++p) {
      const double share = 0.005 * p;
      double error = 0.0;
      for (std::size_t i = 0; i < bins.size(); ++i) {
        const double off = bins[i].density - share / view.width() - (1.0 - share) * peaks[i];
        error += off * off;
      }
      if (error < best.error) best = {width, share, error};
    }
  }
  return best;
}

std::vector<SigmaPoint> sweepSigma(const std::vector<KnownLook>& looks,
                                   const std::vector<Eigen::Vector2d>& targets_map,
                                   LabellingConfig config, double beam_spacing,
                                   const std::vector<double>& sigmas) {
  std::vector<SigmaPoint> points;
  for (const double sigma : sigmas) {
    config.sigma = sigma;
    const Labels labels = label(looks, targets_map, config);
    const DetectionFit fit = fitDetection(binByRange(labels.opportunities), beam_spacing);
    const double measured = std::max<double>(1.0, static_cast<double>(labels.measurements));
    points.push_back({sigma, fit.error, static_cast<double>(labels.detected) / measured});
  }
  return points;
}

}  // namespace sightline::targets
