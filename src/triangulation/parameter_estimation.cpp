#include "sightline/triangulation/parameter_estimation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/NonLinearOptimization>

#include "sightline/triangulation/flat_target.h"
#include "sightline/triangulation/linear_start.h"
#include "sightline/triangulation/photocurrents.h"

namespace sightline::triangulation {

namespace {

using Information = Eigen::Matrix<double, kParameterCount, kParameterCount>;

// Interface that the solver asks for.
struct LeastSquaresProblem {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  int inputs() const { return kParameterCount; }
  int values() const { return static_cast<int>(residuals.size()); }
  int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& values_out) const {
    try {
      values_out = residuals.at(parameters);
    } catch (const config::Error&) {
      values_out.setConstant(1e6);  // no such sensor: a step that the solver takes back
    }
    return 0;
  }
  int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const {
    jacobian = residuals.jacobianAt(parameters);
    return 0;
  }

  const CalibrationResiduals& residuals;
};

Information informationAt(const CalibrationResiduals& residuals, const ParameterVector& at) {
  const auto jacobian = residuals.jacobianAt(at);
  return jacobian.transpose() * jacobian;
}

// A parameter known no better than this is not determined: beyond it a first-order standard
// deviation means little.
ParameterVector worstSigmas(const ParameterVector& at) {
  ParameterVector sigmas;
  sigmas << 0.1 * at[0], 0.1 * at[1], geometry::radians(0.5), 5e-3, 5e-3, 5e-3,
      geometry::radians(1.0);
  return sigmas;
}

std::vector<std::string> undetermined(const Information& information, const ParameterVector& at) {
  const ParameterVector worst = worstSigmas(at);
  const Information scaled = worst.asDiagonal() * information * worst.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Information> solver(scaled);
  // Rounding leaves this much of an eigenvalue that is 0.
  const double least = 1e-13 * solver.eigenvalues()[kParameterCount - 1];
  const ParameterVector variances = solver.eigenvectors().array().square().matrix() *
                                    solver.eigenvalues().cwiseMax(least).cwiseInverse();
  std::vector<std::string> names;
  for (int i = 0; i < kParameterCount; ++i) {
    if (!(variances[i] < 1.0)) names.emplace_back(kParameterNames[static_cast<std::size_t>(i)].key);
  }
  return names;
}

void requireDetermined(const CalibrationResiduals& residuals, const ParameterVector& at,
                       const std::string& source) {
  const auto names = undetermined(informationAt(residuals, at), at);
  if (names.empty()) return;
  throw config::Error(source, 0, fmt::format("{}", fmt::join(names, ", ")),
                      "not determined by this recording; it needs plain and striped targets at "
                      "several depths, across the field of view");
}

// Images of the plain targets, with those left out of which the detector's end may cut a part.
std::vector<ImageReading> imagesOf(const CalibrationRecording& recording,
                                   const SensorParameters& nominal, double beam_width) {
  const ProjectionGeometry geometry(nominal.intrinsics);
  const double length = nominal.intrinsics.detector_length;
  std::vector<ImageReading> images;
  for (const TargetPlacement& target : recording.placements) {
    if (target.stripes) continue;
    for (const BeamAverage& seen : target.beams) {
      const double scan_angle = nominal.scan.scanAngle(static_cast<double>(seen.beam));
      const SpotOnTarget spot =
          spotOnTarget(geometry, target.depth - nominal.origin.x,
                       scan_angle + nominal.origin.projected_vergence, beam_width);
      if (std::abs(seen.image_position) + spot.half_length > 0.5 * length) continue;
      const double sigma = imagePositionSigma(seen.current, nominal.noise_current, length) /
                           std::sqrt(seen.readings);
      images.push_back({target.depth, scan_angle, seen.image_position, sigma});
    }
  }
  return images;
}

std::vector<StripeEdge> edgesOf(const CalibrationRecording& recording,
                                const SensorParameters& nominal, double beam_width) {
  std::vector<StripeEdge> edges;
  for (const TargetPlacement& target : recording.placements) {
    const auto found = findStripeEdges(target, nominal, beam_width);
    edges.insert(edges.end(), found.begin(), found.end());
  }
  return edges;
}

// [m] at the edge's depth per [rad] of scan angle.
double lateralPerAngle(const StripeEdge& edge, const ScanOrigin& origin) {
  const double ahead = edge.depth - origin.x;
  const double aside = edge.y - origin.y;
  return (ahead * ahead + aside * aside) / ahead;
}

double lateralError(const StripeEdge& edge, const ScanOrigin& origin) {
  const double predicted =
      std::atan2(edge.y - origin.y, edge.depth - origin.x) - origin.projected_vergence;
  return (edge.scan_angle - predicted) * lateralPerAngle(edge, origin);
}

// Variance that the noise of the currents leaves unexplained, by moments.
double unexplainedScatter(const std::vector<StripeEdge>& edges, const ScanOrigin& origin) {
  const double freedom = static_cast<double>(edges.size()) - 3.0;
  double squares = 0.0;
  double explained = 0.0;
  for (const StripeEdge& edge : edges) {
    const double error = lateralError(edge, origin);
    const double sigma = edge.sigma * lateralPerAngle(edge, origin);
    squares += error * error;
    explained += sigma * sigma * freedom / static_cast<double>(edges.size());
  }
  return freedom > 0.0 ? std::sqrt(std::max(0.0, squares - explained) / freedom) : 0.0;
}

void addScatter(double scatter, const ScanOrigin& origin, std::vector<StripeEdge>& edges) {
  for (StripeEdge& edge : edges) {
    edge.sigma = std::hypot(edge.sigma, scatter / lateralPerAngle(edge, origin));
  }
}

void takeOutShift(const ParameterVector& at, double detector_length, double beam_width,
                  std::vector<ImageReading>& images) {
  Intrinsics intrinsics;
  ScanOrigin origin;
  intrinsics.detector_length = detector_length;
  fromVector(at, intrinsics, origin);
  const ProjectionGeometry geometry(intrinsics);
  for (ImageReading& image : images) {
    image.image_position -= spotOnTarget(geometry, image.depth - origin.x,
                                         image.scan_angle + origin.projected_vergence, beam_width)
                                .shift;
  }
}

double chiSquareAt(const CalibrationResiduals& residuals, const ParameterVector& at) {
  try {
    return residuals.at(at).squaredNorm();
  } catch (const config::Error&) {
    return std::numeric_limits<double>::infinity();  // no such sensor
  }
}

// The linear solution, unless noise has spoilt it so that the nominal sensor is nearer.
ParameterVector startFor(const CalibrationResiduals& residuals, const ScanOrigin& origin,
                         const Intrinsics& nominal) {
  ParameterVector as_built = toVector(nominal, origin);
  const auto linear = startIntrinsics(residuals.images(), origin, nominal.detector_length);
  if (!linear) return as_built;
  ParameterVector solved = toVector(*linear, origin);
  return chiSquareAt(residuals, solved) < chiSquareAt(residuals, as_built) ? solved : as_built;
}

ParameterVector solve(const CalibrationResiduals& residuals, const ParameterVector& start) {
  LeastSquaresProblem problem{residuals};
  Eigen::LevenbergMarquardt<LeastSquaresProblem> solver(problem);
  solver.parameters.xtol = 1e-12;
  solver.parameters.ftol = 1e-12;
  Eigen::VectorXd parameters = start;
  solver.minimize(parameters);
  return parameters;
}

// Requires that the next Gauss-Newton step is small against the standard deviations, as it is at a
// minimum; at the end of a parameter's range, or where the solver gave up, it is not.
void requireMinimum(const CalibrationResiduals& residuals, const ParameterVector& at,
                    const Eigen::VectorXd& values, const Information& covariance,
                    const std::string& source) {
  const ParameterVector step = covariance * (residuals.jacobianAt(at).transpose() * values);
  for (int i = 0; i < kParameterCount; ++i) {
    if (std::abs(step[i]) < 0.01 * std::sqrt(covariance(i, i))) continue;
    throw config::Error(source, 0, kParameterNames[static_cast<std::size_t>(i)].key,
                        "no value within its range fits this recording best");
  }
}

ParameterEstimate joined(const CalibrationResiduals& residuals, const ParameterVector& start,
                         const std::string& source) {
  const ParameterVector solution = solve(residuals, start);
  requireDetermined(residuals, solution, source);
  ParameterEstimate estimate;
  fromVector(solution, estimate.intrinsics, estimate.origin);
  estimate.covariance = informationAt(residuals, solution).inverse();
  estimate.residuals = residuals.at(solution);
  requireMinimum(residuals, solution, estimate.residuals, estimate.covariance, source);
  config::validate(estimate.origin, source);
  estimate.images = residuals.images();
  estimate.edges = residuals.edges();
  return estimate;
}

}  // namespace

double ParameterEstimate::sigma(int parameter) const {
  return std::sqrt(covariance(parameter, parameter));
}

double ParameterEstimate::imageRms() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const double error = residuals[static_cast<Eigen::Index>(i)] * images[i].sigma;
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(images.size()));
}

double ParameterEstimate::edgeRms() const {
  double sum = 0.0;
  for (const StripeEdge& edge : edges) sum += std::pow(lateralError(edge, origin), 2);
  return std::sqrt(sum / static_cast<double>(edges.size()));
}

double ParameterEstimate::reducedChiSquare() const {
  const auto freedom = static_cast<double>(residuals.size() - kParameterCount);
  return freedom > 0.0 ? residuals.squaredNorm() / freedom : 1.0;
}

ParameterEstimate estimateParameters(const CalibrationRecording& recording,
                                     const SensorParameters& nominal, double beam_width,
                                     const std::string& source) {
  const double length = nominal.intrinsics.detector_length;
  auto images = imagesOf(recording, nominal, beam_width);
  auto edges = edgesOf(recording, nominal, beam_width);
  requireDetermined({images, edges, length}, toVector(nominal.intrinsics, nominal.origin), source);

  const ScanOrigin origin = startOrigin(edges).value_or(nominal.origin);
  config::validate(origin, source);
  const double scatter = unexplainedScatter(edges, origin);
  addScatter(scatter, origin, edges);
  const ParameterVector start = startFor({images, edges, length}, origin, nominal.intrinsics);
  takeOutShift(start, length, beam_width, images);

  ParameterEstimate estimate = joined({std::move(images), std::move(edges), length}, start, source);
  estimate.intrinsics.detector_length = length;
  estimate.edge_scatter = scatter;
  return estimate;
}

}  // namespace sightline::triangulation
