#include "sightline/tracking/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "sightline/geometry/angle.h"

namespace sightline::tracking {

namespace {

constexpr struct {
  // A normal comes from neighbours over this length of surface [m]: with 1 cm of noise it is good
  // to two degrees.
  double least_span = 0.4;
  std::size_t most_neighbours = 12;  // on either side
  // Neighbours of a line stray from it by no more than this, root mean square [m].
  double most_scatter = 0.03;
  double most_gap = 0.35;  // between neighbours [m]
  int bins = 45;           // of the directions modulo 90°
  double near = 0.05;      // directions that make a peak lie this close to it [rad]
  double apart = 0.14;     // of two peaks [rad]
  double least_share = 0.33;
} kSurfaces;

constexpr double kRightAngle = 0.5 * geometry::kPi;

// Index of the furthest beam that goes on the same surface, towards lower or higher beams.
std::size_t extend(const scan::Scan& scan, std::size_t from, int step) {
  std::size_t at = from;
  for (std::size_t n = 0; n < kSurfaces.most_neighbours; ++n) {
    const auto next = static_cast<std::ptrdiff_t>(at) + step;
    if (next < 0 || next >= static_cast<std::ptrdiff_t>(scan.beams())) break;
    const auto index = static_cast<std::size_t>(next);
    if (!scan.isValid(index)) break;
    if ((scan.point(index) - scan.point(at)).norm() > kSurfaces.most_gap) break;
    at = index;
    if ((scan.point(at) - scan.point(from)).norm() > 0.5 * kSurfaces.least_span) break;
  }
  return at;
}

std::optional<SurfacePoint> surfaceAt(const scan::Scan& scan, std::size_t beam) {
  const std::size_t first = extend(scan, beam, -1);
  const std::size_t last = extend(scan, beam, 1);
  if (last < first + 3) return std::nullopt;
  const double count = static_cast<double>(last - first + 1);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = first; i <= last; ++i) mean += scan.point(i) / count;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (std::size_t i = first; i <= last; ++i) {
    const Eigen::Vector2d off = scan.point(i) - mean;
    scatter += off * off.transpose() / count;
  }
  const double along = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  Eigen::Vector2d normal(-std::sin(along), std::cos(along));
  const double across = normal.dot(scatter * normal);
  if (across > kSurfaces.most_scatter * kSurfaces.most_scatter) return std::nullopt;
  if (scatter.trace() < 25.0 * across) return std::nullopt;
  const Eigen::Vector2d position = scan.point(beam);
  if (normal.dot(position) > 0.0) normal = -normal;
  const double length = (scan.point(last) - scan.point(first)).norm() / count;
  return SurfacePoint{position, normal, length};
}

double foldedDirection(const SurfacePoint& piece) {
  const double angle = std::atan2(piece.normal.y(), piece.normal.x());
  return angle - kRightAngle * std::floor(angle / kRightAngle);
}

double foldedDifference(double a, double b) {
  return std::remainder(a - b, kRightAngle);
}

// Mean direction of the pieces near one, and their length.
std::pair<double, double> refinePeak(const std::vector<SurfacePoint>& pieces, double near) {
  std::complex<double> sum = 0.0;
  double length = 0.0;
  for (const SurfacePoint& piece : pieces) {
    const double direction = foldedDirection(piece);
    if (std::abs(foldedDifference(direction, near)) > kSurfaces.near) continue;
    sum += std::polar(piece.length, 4.0 * direction);
    length += piece.length;
  }
  const double mean = 0.25 * std::arg(sum);
  return {mean - kRightAngle * std::floor(mean / kRightAngle), length};
}

}  // namespace

std::vector<SurfacePoint> surfacePoints(const scan::Scan& scan, std::size_t most) {
  std::vector<SurfacePoint> points;
  const std::size_t stride =
      std::max<std::size_t>(1, scan.beams() / std::max<std::size_t>(1, most));
  for (std::size_t i = stride / 2; i < scan.beams(); i += stride) {
    if (!scan.isValid(i)) continue;
    const auto point = surfaceAt(scan, i);
    if (!point) continue;
    points.push_back(*point);
    points.back().length *= static_cast<double>(stride);
  }
  return points;
}

std::vector<double> mainDirections(const std::vector<SurfacePoint>& pieces) {
  std::vector<double> lengths(static_cast<std::size_t>(kSurfaces.bins), 0.0);
  const double bin = kRightAngle / kSurfaces.bins;
  for (const SurfacePoint& piece : pieces) {
    const auto at = static_cast<std::size_t>(foldedDirection(piece) / bin) % lengths.size();
    lengths[at] += piece.length;
  }
  std::vector<std::pair<double, double>> peaks;  // length, direction
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (lengths[i] <= 0.0) continue;
    const auto [direction, length] = refinePeak(pieces, (static_cast<double>(i) + 0.5) * bin);
    if (length > 0.0) peaks.emplace_back(length, direction);
  }
  std::sort(peaks.rbegin(), peaks.rend());
  std::vector<double> directions;
  for (const auto& [length, direction] : peaks) {
    if (directions.empty()) {
      directions.push_back(direction);
    } else if (length >= kSurfaces.least_share * peaks.front().first &&
               std::abs(foldedDifference(direction, directions.front())) > kSurfaces.apart) {
      directions.push_back(direction);
      break;
    }
  }
  return directions;
}

std::vector<SurfacePoint> wallPieces(const world::RoomMap& map) {
  std::vector<SurfacePoint> pieces;
  for (const world::Room& room : map.rooms()) {
    for (const world::Wall& wall : room.walls) {
      for (const world::Span& span : wall.spans) {
        const Eigen::Vector2d middle =
            wall.segment.start + 0.5 * (span.from + span.to) * wall.segment.direction();
        pieces.push_back({middle, wall.segment.leftNormal(), span.to - span.from});
      }
    }
  }
  return pieces;
}

}  // namespace sightline::tracking
