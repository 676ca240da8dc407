#include "sightline/tracking/rounded_ranges.h"

#include <cmath>

namespace sightline::tracking {

namespace {

constexpr double kLeastStep = 3.0;  // sigmas of a beam; √12 where rounding is all its noise

double rangeVarianceOf(const BeamPoint& point) {
  const Eigen::Vector2d ray = (point.position - point.origin).normalized();
  return ray.dot(point.covariance * ray);
}

// The smallest step from one reading to the next other one; 0 where all read the same.
double leastStep(const std::vector<const BeamPoint*>& points) {
  double least = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = std::abs(points[i]->range - points[i - 1]->range);
    if (step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  return least;
}

// Whether rounding is what makes the ranges noisy.
bool areRounded(const std::vector<const BeamPoint*>& points) {
  const double step = leastStep(points);
  return step == 0.0 || step * step >= kLeastStep * kLeastStep * rangeVarianceOf(*points.front());
}

}  // namespace

double roundedAlike(const std::vector<const BeamPoint*>& points) {
  if (!areRounded(points)) return 0.0;
  const auto beams = static_cast<double>(points.size());
  double steps = 1.0;
  double last = points.front()->range;
  double before = last;  // between two steps the jitter goes to and fro
  for (const BeamPoint* point : points) {
    if (point->range == last || point->range == before) continue;
    before = last;
    last = point->range;
    steps += 1.0;
  }
  return (beams - steps) / (steps * steps);
}

std::vector<fitting::NoisyPoint> stepEdges(const std::vector<const BeamPoint*>& points) {
  std::vector<fitting::NoisyPoint> edges;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const BeamPoint& a = *points[i - 1];
    const BeamPoint& b = *points[i];
    if (b.beam != a.beam + 1 || a.range == b.range) continue;
    const Eigen::Vector2d position = 0.5 * (a.position + b.position);
    const Eigen::Vector2d ray = (position - 0.5 * (a.origin + b.origin)).normalized();
    const Eigen::Vector2d across(-ray.y(), ray.x());
    const double spacing = across.dot(b.position - a.position);
    const double jitter = 0.5 * across.dot((a.covariance + b.covariance) * across);
    edges.push_back({position, (jitter + spacing * spacing / 12.0) * across * across.transpose()});
  }
  return edges;
}

}  // namespace sightline::tracking
