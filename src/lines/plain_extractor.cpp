#include "sightline/lines/plain_extractor.h"

#include <cmath>

#include <Eigen/LU>

#include "sightline/fitting/line_fit.h"

namespace sightline::lines {

namespace {

using geometry::PolarLine;
using geometry::Pose2;

// Of the sensor at a beam, in its frame at the stamp.
Pose2 poseAt(const scan::Scan& scan, std::size_t beam) {
  return scan.sensorMotion().empty() ? Pose2() : scan.sensorMotion()[beam];
}

double predictedRange(const PolarLine& line, double angle) {  // eq. 27
  return line.rho / std::cos(line.phi - angle);
}

Eigen::RowVector2d observationJacobian(const PolarLine& line, double angle) {  // eq. 30
  const double cosine = std::cos(line.phi - angle);
  return {1.0 / cosine, line.rho * std::tan(line.phi - angle) / cosine};
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
  return track.line.covariance.allFinite();
}

// Eqs 20-36. False where the observation is not validated.
bool PlainExtractor::update(const scan::Scan& scan, std::size_t beam, Track& track) const {
  const Pose2 T_now_before = poseAt(scan, beam).inverse() * poseAt(scan, track.last);
  PolarLine line =
      scan.sensorMotion().empty() ? track.line : geometry::transform(T_now_before, track.line);
  const double angle = scan.geometry()->angles()[beam];
  const Eigen::RowVector2d h = observationJacobian(line, angle);
  const double innovation = scan.ranges()[beam] - predictedRange(line, angle);
  const double s = h * line.covariance * h.transpose() + scan.rangeVariances()[beam];
  if (!(innovation * innovation <= config_.gate * config_.gate * s)) return false;
  const Eigen::Vector2d gain = line.covariance * h.transpose() / s;
  line.rho += gain[0] * innovation;
  line.phi += gain[1] * innovation;
  line.covariance -= gain * s * gain.transpose();
  track = {geometry::canonical(line), track.first, beam, track.beams + 1,
           track.chi_square + innovation * innovation / s};
  return true;
}

void PlainExtractor::report(const scan::Scan& scan, const Track& track) {
  if (track.beams < static_cast<std::size_t>(config_.min_beams)) return;
  geometry::LineSegment segment;
  segment.line = geometry::transform(poseAt(scan, track.last), track.line);
  segment.ends = {segment.line.project(scan.point(track.first)),
                  segment.line.project(scan.point(track.last))};
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
    if (fresh.size() < kStart) continue;
    tracking = start(scan, fresh, track);
    fresh.clear();
  }
  if (tracking) report(scan, track);
  return segments_;
}

}  // namespace sightline::lines
