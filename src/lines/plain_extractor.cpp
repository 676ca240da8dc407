#include "sightline/lines/plain_extractor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "sightline/fitting/line_fit.h"
#include "sightline/lines/beam_motion.h"

namespace sightline::lines {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

// Pose of the sensor at a beam, in its frame at the stamp.
Pose2 poseAt(const scan::Scan& scan, std::size_t beam) {
  return scan.sensorMotion().empty() ? Pose2() : scan.sensorMotion()[beam];
}

// Variances of an independent error of the head's angle at each end of a stretch of time, as a turn
// about its axis: (x, y, θ) of the sensor.
Eigen::Matrix3d ofJitter(const scan::Scan& scan, std::size_t beam, double ends) {
  const Eigen::Vector2d arm = poseAt(scan, beam).translation() - scan.motion_noise.jitter_axis;
  const Eigen::Vector3d turn(-arm.y(), arm.x(), 1.0);
  return ends * scan.motion_noise.jitter * turn * turn.transpose();
}

// Covariance of the sensor's coordinates at a beam, in its frame at the stamp.
Eigen::Matrix3d motionTo(const scan::Scan& scan, std::size_t beam) {
  return motionCovariance(scan, beam) + ofJitter(scan, beam, 1.0);
}

// Covariance that comes on top between two beams (eq. 23 for any planar motion).
Eigen::Matrix3d motionBetween(const scan::Scan& scan, std::size_t from, std::size_t to) {
  return motionCovariance(scan, to) - motionCovariance(scan, from) + ofJitter(scan, to, 2.0);
}

double predictedRange(const PolarLine& line, double angle) {  // eq. 27
  return line.rho / std::cos(line.phi - angle);
}

Eigen::RowVector2d observationJacobian(const PolarLine& line, double angle) {  // eq. 30
  const double cosine = std::cos(line.phi - angle);
  return {1.0 / cosine, line.rho * std::tan(line.phi - angle) / cosine};
}

// Distance of neighbouring beams along a line, at one of them.
double spacingAt(const scan::Scan& scan, std::size_t beam, const PolarLine& line) {
  const double facing = std::abs(line.normal().dot(scan.direction(beam)));
  const double across = scan.ranges()[beam] * std::abs(scan.geometry()->angleIncrement());
  return across / std::max(facing, 0.01);
}

std::vector<fitting::NoisyPoint> pointsSeenFrom(const scan::Scan& scan,
                                                const std::vector<std::size_t>& beams) {
  const Pose2 T_last_stamp = poseAt(scan, beams.back()).inverse();
  const Eigen::Matrix2d turn = T_last_stamp.rotation();
  std::vector<fitting::NoisyPoint> points;
  for (const std::size_t beam : beams) {
    points.push_back(
        {T_last_stamp * scan.point(beam), turn * scan.covariance(beam) * turn.transpose()});
  }
  return points;
}

}  // namespace

PlainExtractor::PlainExtractor(const LineExtractorConfig& config) : config_(config) {
  config::validate(config_);
}

// Section 4.6: the line of eq. 38, and its covariance by eq. 39.
bool PlainExtractor::start(const scan::Scan& scan, const std::vector<std::size_t>& beams,
                           Track& track) const {
  const auto points = pointsSeenFrom(scan, beams);
  const auto line = fitting::startLine(points);
  if (!line) return false;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  double chi_square = 0.0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Eigen::Vector2d& point = points[i].position;
    const double angle = std::atan2(point.y(), point.x());
    const Eigen::RowVector2d h = observationJacobian(*line, angle);
    const double innovation = point.norm() - predictedRange(*line, angle);
    information += h.transpose() * h / scan.rangeVariances()[beams[i]];
    chi_square += innovation * innovation / scan.rangeVariances()[beams[i]];
  }
  track = {*line, beams.front(), beams.back(), beams.size(), chi_square};
  track.line.covariance = information.inverse();
  track.motion = motionTo(scan, track.last);
  return track.line.covariance.allFinite();
}

// Eqs 20-25: to the sensor's frame at a beam.
void PlainExtractor::predict(const scan::Scan& scan, std::size_t beam, Track& track) const {
  if (!scan.sensorMotion().empty()) {
    const Pose2 T_now_before = poseAt(scan, beam).inverse() * poseAt(scan, track.last);
    track.line_motion =
        geometry::transformJacobianLine(T_now_before, track.line) * track.line_motion;
    track.line = geometry::transform(T_now_before, track.line);
  }
  if (scan.motion_noise.isZero()) return;
  // A sensor that stands further on than it should sees the line the other way (eqs 24, 25).
  Eigen::Matrix3d T_now_stamp = Eigen::Matrix3d::Identity();
  T_now_stamp.topLeftCorner<2, 2>() = poseAt(scan, beam).rotation().transpose();
  const Eigen::Matrix<double, 2, 3> jacobian =
      -geometry::transformJacobianPose(Pose2(), track.line) * T_now_stamp;
  const Eigen::Matrix3d q = motionBetween(scan, track.last, beam);
  track.line.covariance += jacobian * q * jacobian.transpose();
  track.line_motion += jacobian * q;
  track.motion += q;
}

// Eqs 26-36. False where the observation is not validated.
bool PlainExtractor::update(const scan::Scan& scan, std::size_t beam, Track& track) const {
  Track next = track;
  predict(scan, beam, next);
  PolarLine& line = next.line;
  const double angle = scan.geometry()->angles()[beam];
  const Eigen::RowVector2d h = observationJacobian(line, angle);
  const double innovation = scan.ranges()[beam] - predictedRange(line, angle);
  const double s = h * line.covariance * h.transpose() + scan.rangeVariances()[beam];
  if (!(innovation * innovation <= config_.gate * config_.gate * s)) return false;
  const Eigen::Vector2d gain = line.covariance * h.transpose() / s;
  line.rho += gain[0] * innovation;
  line.phi += gain[1] * innovation;
  line.covariance -= gain * s * gain.transpose();
  next.line_motion -= gain * h * next.line_motion;
  if (line.rho < 0.0) next.line_motion.row(0) = -next.line_motion.row(0);
  line = geometry::canonical(line);
  next.last = beam;
  ++next.beams;
  next.chi_square += innovation * innovation / s;
  track = next;
  return true;
}

PolarLine PlainExtractor::atStamp(const scan::Scan& scan, const Track& track) const {
  const Pose2 T_stamp_last = poseAt(scan, track.last);
  PolarLine line = geometry::transform(T_stamp_last, track.line);
  if (scan.motion_noise.isZero()) return line;
  const Eigen::Matrix2d by_line = geometry::transformJacobianLine(T_stamp_last, track.line);
  const Eigen::Matrix<double, 2, 3> by_motion =
      geometry::transformJacobianPose(T_stamp_last, track.line);
  const Eigen::Matrix2d cross = by_line * track.line_motion * by_motion.transpose();
  line.covariance += by_motion * track.motion * by_motion.transpose() + cross + cross.transpose();
  return line;
}

void PlainExtractor::report(const scan::Scan& scan, const Track& track) {
  if (track.beams < static_cast<std::size_t>(config_.min_beams)) return;
  geometry::LineSegment segment;
  segment.line = atStamp(scan, track);
  segment.ends = {segment.line.project(scan.point(track.first)),
                  segment.line.project(scan.point(track.last))};
  const Eigen::Vector2d along = segment.line.direction();
  const auto sigmaAlong = [&](std::size_t beam) {
    const Eigen::RowVector3d moved =
        along.transpose() * motionJacobian(scan, beam, scan.point(beam));
    const double spacing = spacingAt(scan, beam, segment.line);
    return std::sqrt(along.dot(scan.covariance(beam) * along) + spacing * spacing / 3.0 +
                     moved * motionTo(scan, beam) * moved.transpose());
  };
  segment.start_sigma = sigmaAlong(track.first);
  segment.end_sigma = sigmaAlong(track.last);
  segment.first_beam = track.first;
  segment.last_beam = track.last;
  segment.beams = track.beams;
  segment.chi_square = track.chi_square;
  segment.degrees_of_freedom = track.beams - 2;
  segments_.push_back(segment);
}

const std::vector<geometry::LineSegment>& PlainExtractor::extract(const scan::Scan& scan) {
  segments_.clear();
  std::vector<std::size_t> fresh;  // not on the line before them
  Track track;
  bool tracking = false;
  for (std::size_t beam = 0; beam < scan.beams(); ++beam) {
    if (!scan.isValid(beam)) continue;
    if (tracking && update(scan, beam, track)) continue;
    if (tracking) report(scan, track);
    tracking = false;
    fresh.push_back(beam);
    if (fresh.size() < static_cast<std::size_t>(config_.start_beams)) continue;
    tracking = start(scan, fresh, track);
    fresh.clear();
  }
  if (tracking) report(scan, track);
  return segments_;
}

}  // namespace sightline::lines
