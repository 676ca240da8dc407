#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "bench/figures.h"
#include "sightline/geometry/line_segment.h"
#include "sightline/geometry/statistics.h"
#include "view.h"

namespace sightline::bench {

/// 95 % of χ² with two degrees of freedom.
constexpr double kGate95 = geometry::kChiSquare95Of2;

struct LineErrors {
  std::vector<double> rho_mm, phi_mrad, end_mm;
  std::size_t in_gate = 0;
  std::size_t ends_within_2_sigma = 0;
  double nees = 0.0;

  void addEnds(const geometry::LineSegment& segment, const geometry::Segment& true_ends) {
    const Eigen::Vector2d along = segment.line.direction();
    const auto isWithin = [&](const Eigen::Vector2d& error, double sigma) {
      return std::abs(along.dot(error)) <= 2.0 * sigma;
    };
    if (isWithin(segment.ends.start - true_ends.start, segment.start_sigma)) ++ends_within_2_sigma;
    if (isWithin(segment.ends.end - true_ends.end, segment.end_sigma)) ++ends_within_2_sigma;
  }

  void add(const geometry::PolarLine& line, const geometry::PolarLine& truth,
           const geometry::Segment& ends, const geometry::Segment& true_ends) {
    const Eigen::Vector2d error = geometry::difference(line, truth);
    const double squared = error.dot(line.covariance.inverse() * error);
    rho_mm.push_back(1e3 * std::abs(error[0]));
    phi_mrad.push_back(1e3 * std::abs(error[1]));
    end_mm.push_back(1e3 * (ends.start - true_ends.start).norm());
    end_mm.push_back(1e3 * (ends.end - true_ends.end).norm());
    nees += squared;
    if (squared <= kGate95) ++in_gate;
  }
  double meanNees() const { return nees / static_cast<double>(rho_mm.size()); }
  double share() const {
    return 100.0 * static_cast<double>(in_gate) / static_cast<double>(rho_mm.size());
  }
};

/// Whether a segment is this span: within 5°, the midpoints within 0.10 m, at least half
/// overlapping.
inline bool matches(const geometry::PolarLine& line, const geometry::Segment& ends,
                    const VisibleSpan& span) {
  const double turn = geometry::difference(line, span.line)[1];
  if (std::abs(turn) > geometry::radians(5.0)) return false;
  if ((ends.midpoint() - span.ends.midpoint()).norm() > 0.10) return false;
  const double a = span.ends.along(ends.start);
  const double b = span.ends.along(ends.end);
  const double overlap =
      std::min(std::max(a, b), span.ends.length()) - std::max(std::min(a, b), 0.0);
  return overlap >= 0.5 * span.ends.length();
}

/// Lies on the span, whatever part of it.
inline bool liesOn(const geometry::LineSegment& segment, const VisibleSpan& span) {
  const double turn = geometry::difference(segment.line, span.line)[1];
  return std::abs(turn) < geometry::radians(5.0) &&
         span.ends.distance(segment.ends.midpoint()) < 0.10;
}

/// Spans that ought to be found.
inline bool isWanted(const VisibleSpan& span) {
  return span.beams >= 12 && span.ends.length() >= 0.6;
}

/// Places where more than four beams in a row, and more than 0.45 m, pass through a segment.
inline std::size_t openingsUnder(const geometry::LineSegment& segment, const View& view) {
  constexpr double kBehind = 0.1;  // m
  const std::size_t count = view.scan.beams();
  const std::size_t last = segment.last_beam + (segment.last_beam < segment.first_beam ? count : 0);
  std::size_t openings = 0;
  std::size_t passing = 0;
  Eigen::Vector2d before(0, 0);
  for (std::size_t i = segment.first_beam; i <= last; ++i) {
    const std::size_t beam = i % count;
    const Eigen::Vector2d direction = view.scan.direction(beam);
    const Eigen::Vector2d origin = view.scan.sensorMotion().empty()
                                       ? Eigen::Vector2d::Zero()
                                       : view.scan.sensorMotion()[beam].translation();
    const double range =
        -segment.line.signedDistance(origin) / segment.line.normal().dot(direction);
    if (view.true_ranges[beam] > range + kBehind) {
      ++passing;
      continue;
    }
    const Eigen::Vector2d here = origin + range * direction;
    if (passing > 4 && (here - before).norm() > 0.45) ++openings;
    passing = 0;
    before = here;
  }
  return openings;
}

/// One scenario's figures.
struct Score {
  std::size_t wanted = 0, found = 0, excess = 0, fragmented = 0, floor_found = 0;
  LineErrors errors, floor;
  std::vector<double> microseconds, conversion;
  std::size_t bridged = 0;  ///< openings that a segment goes across

  /// Answers which spans were found by which segment (−1: none).
  std::vector<int> add(const View& view, const std::vector<geometry::LineSegment>& segments) {
    std::vector<bool> used(segments.size(), false);
    std::vector<int> matched(view.spans.size(), -1);
    for (const bool wanted_ones : {true, false}) {
      for (std::size_t i = 0; i < view.spans.size(); ++i) {
        if (isWanted(view.spans[i]) == wanted_ones)
          matched[i] = claim(view.spans[i], segments, used);
      }
    }
    for (std::size_t i = 0; i < view.spans.size(); ++i) count(view.spans[i], matched[i], segments);
    excess += static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    for (const auto& segment : segments) bridged += openingsUnder(segment, view);
    return matched;
  }

  double foundPercent() const {
    return 100.0 * static_cast<double>(found) / static_cast<double>(wanted);
  }

  void printFigures(const std::string& scenario) const {
    const std::string name = "lines." + scenario + ".";
    const auto n = static_cast<double>(wanted);
    const auto tp = static_cast<double>(found);
    print(name + "f1", 2.0 * tp / (tp + n + static_cast<double>(excess)), "1");
    print(name + "found", foundPercent(), "%");
    print(name + "false", static_cast<double>(excess), "segments");
    print(name + "fragmented", 100.0 * static_cast<double>(fragmented) / n, "%");
    printErrors(name, errors);
    print(name + "nees", errors.meanNees(), "of_2");
    print(name + "ends_within_2_sigma",
          100.0 * static_cast<double>(errors.ends_within_2_sigma) /
              static_cast<double>(errors.end_mm.size()),
          "%");
    print(name + "bridged", static_cast<double>(bridged), "openings");
    print(name + "rho_over_floor", median(errors.rho_mm) / median(floor.rho_mm), "1");
    print(name + "phi_over_floor", median(errors.phi_mrad) / median(floor.phi_mrad), "1");
    print(name + "us_median", median(microseconds), "us");
    print(name + "us_p99", quantile(microseconds, 0.99), "us");
    print(name + "per_conversion", median(microseconds) / median(conversion), "1");
    printErrors(name + "floor.", floor);
    print(name + "floor.f1",
          2.0 * static_cast<double>(floor_found) / (static_cast<double>(floor_found) + n), "1");
  }

 private:
  static void printErrors(const std::string& name, const LineErrors& errors) {
    print(name + "rho_median_mm", median(errors.rho_mm), "mm");
    print(name + "phi_median_mrad", median(errors.phi_mrad), "mrad");
    print(name + "endpoint_median_mm", median(errors.end_mm), "mm");
    print(name + "in_gate", errors.share(), "%");
  }
  static int claim(const VisibleSpan& span, const std::vector<geometry::LineSegment>& segments,
                   std::vector<bool>& used) {
    int best = -1;
    double least = 1.0;
    for (std::size_t j = 0; j < segments.size(); ++j) {
      const double apart = (segments[j].ends.midpoint() - span.ends.midpoint()).norm();
      if (used[j] || apart > least || !matches(segments[j].line, segments[j].ends, span)) continue;
      least = apart;
      best = static_cast<int>(j);
    }
    if (best >= 0) used[static_cast<std::size_t>(best)] = true;
    return best;
  }
  void count(const VisibleSpan& span, int match,
             const std::vector<geometry::LineSegment>& segments) {
    if (!isWanted(span)) return;
    ++wanted;
    if (matches(span.floor, span.floor_ends, span)) ++floor_found;
    const auto pieces = std::count_if(segments.begin(), segments.end(),
                                      [&](const auto& segment) { return liesOn(segment, span); });
    if (pieces > 1) ++fragmented;
    if (match < 0) return;
    ++found;
    const auto& segment = segments[static_cast<std::size_t>(match)];
    errors.add(segment.line, span.line, segment.ends, span.ends);
    errors.addEnds(segment, span.ends);
    floor.add(span.floor, span.line, span.floor_ends, span.ends);
  }
};

}  // namespace sightline::bench
