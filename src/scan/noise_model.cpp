#include "sightline/scan/noise_model.h"

#include <cmath>

#include "sightline/scan/learned_noise.h"

namespace sightline::scan {

void NoiseModel::visit(config::FieldVisitor& visitor) {
  visitor.choice(
      "kind", kind, {"constant", "proportional", "uniform", "isotropic", "intensity", "estimated"},
      "shape of the noise along a beam: always the same; growing with the range; of bounds "
      "(jensfelt eqs 2-4); of points, alike in x and y; falling with the intensity "
      "(pears eq. 2); or learned from the first scans of each scanner and kept");
  visitor.number(
      "sigma", sigma,
      {"m",
       {1e-6, 10.0},
       "standard deviation along a beam, or its constant part; estimated: until scans show it"});
  visitor.number("least_sigma", least_sigma,
                 {"m", {1e-6, 10.0}, "estimated: the standard deviation is never taken for less"});
  visitor.number(
      "sigma_per_metre", sigma_per_metre,
      {"1", {0.0, 1.0}, "proportional: share of the range added to sigma in quadrature"});
  visitor.number(
      "range_half_width", range_half_width,
      {"m", {1e-6, 1.0}, "uniform: half width of the range interval (jensfelt eq. 2, Delta r)"});
  visitor.number("angle_half_width", angle_half_width,
                 {"rad",
                  {0.0, 0.1},
                  "uniform: half width of the angle interval (jensfelt eq. 2, Delta alpha)"});
  visitor.number(
      "intensity_sigma", intensity_sigma,
      {"m intensity",
       {0.0, 1e6},
       "intensity: this over the intensity is added to sigma in quadrature (pears eq. 2)"});
  visitor.number("angular_sigma", angular_sigma,
                 {"rad", {0.0, 0.1}, "standard deviation of a beam's direction; not for uniform"});
}

double NoiseModel::rangeVariance(double range, double intensity) const {
  switch (kind) {
    case NoiseKind::kProportional: {
      const double growing = sigma_per_metre * range;
      return sigma * sigma + growing * growing;
    }
    case NoiseKind::kUniform:
      return range_half_width * range_half_width / 3.0;
    case NoiseKind::kIntensity: {
      // No light, no knowledge: bounded so that a dark return, or one whose intensity is not a
      // number, keeps a finite, useless weight.
      const double falling = intensity_sigma / (intensity > 1e-6 ? intensity : 1e-6);
      return sigma * sigma + falling * falling;
    }
    case NoiseKind::kConstant:
    case NoiseKind::kIsotropic:
    case NoiseKind::kEstimated:
      break;
  }
  return sigma * sigma;
}

double NoiseModel::angularVariance() const {
  if (kind == NoiseKind::kUniform) return angle_half_width * angle_half_width / 3.0;
  return angular_sigma * angular_sigma;
}

Eigen::Matrix2d uniformCovariance(double range, double angle, double range_half_width,
                                  double angle_half_width) {
  const double sinc = angle_half_width > 0.0 ? std::sin(angle_half_width) / angle_half_width : 1.0;
  const double mean_square = 0.5 * (range * range + range_half_width * range_half_width / 3.0);
  const double twice = std::cos(angle_half_width) * sinc;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double square = range * range * sinc * sinc;
  const double aa = mean_square * (1.0 + std::cos(2.0 * angle) * twice) - square * c * c;
  const double bb = mean_square * (1.0 - std::cos(2.0 * angle) * twice) - square * s * s;
  const double ab = mean_square * std::sin(2.0 * angle) * twice - square * s * c;
  Eigen::Matrix2d covariance;
  covariance << aa, ab, ab, bb;
  return covariance;
}

void applyNoise(const NoiseModel& model, Scan& scan) {
  if (model.kind == NoiseKind::kEstimated) return LearnedNoise(model).apply(scan);
  std::vector<double> variances(scan.beams());
  for (std::size_t i = 0; i < scan.beams(); ++i) {
    const double intensity = scan.intensities().empty() ? 0.0 : scan.intensities()[i];
    variances[i] = model.rangeVariance(scan.ranges()[i], intensity);
  }
  scan.setRangeVariances(std::move(variances));
  scan.angular_variance = model.angularVariance();
  scan.transverse_variance = model.kind == NoiseKind::kIsotropic ? model.sigma * model.sigma : 0.0;
}

}  // namespace sightline::scan
