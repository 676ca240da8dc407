#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "bench/figures.h"
#include "sightline/geometry/line_segment.h"

namespace sightline::bench {

/// Walls of a scanner that stands still: whether each stays, in one piece, within its covariance.
class Standing {
 public:
  void add(const std::vector<geometry::LineSegment>& segments) {
    for (Wall& wall : walls_) wall.pieces.push_back(0);
    ++scans_;
    for (const auto& segment : segments) take(segment);
  }

  void printFigures(const std::string& name) const {
    Sums sums;
    for (const Wall& wall : walls_) {
      if (2 * wall.seen.size() >= scans_) sums.add(wall, scans_);
    }
    const auto wall_scans = static_cast<double>(sums.wall_scans);
    print(name + "standing.walls", static_cast<double>(sums.walls), "1");
    print(name + "standing.nees", sums.nees / static_cast<double>(sums.seen), "of_2");
    print(name + "standing.vanish", 100.0 * static_cast<double>(sums.vanished) / wall_scans, "%");
    print(name + "standing.split", 100.0 * static_cast<double>(sums.split) / wall_scans, "%");
  }

 private:
  struct Wall {
    geometry::LineSegment first;
    std::vector<geometry::LineSegment> seen;  // the first piece of each scan
    std::vector<std::size_t> pieces;          // by scan
  };
  struct Sums {
    std::size_t walls = 0, seen = 0, wall_scans = 0, vanished = 0, split = 0;
    double nees = 0.0;

    void add(const Wall& wall, std::size_t scans) {
      ++walls;
      seen += wall.seen.size();
      wall_scans += scans;
      for (std::size_t i = 0; i < wall.pieces.size(); ++i) {
        if (i > 0 && wall.pieces[i - 1] > 0 && wall.pieces[i] == 0) ++vanished;
        if (wall.pieces[i] > 1) ++split;
      }
      Eigen::Vector2d mean(0, 0);
      const auto offsetOf = [&](const geometry::LineSegment& segment) {
        return Eigen::Vector2d(geometry::difference(segment.line, wall.first.line));
      };
      for (const auto& segment : wall.seen) mean += offsetOf(segment);
      mean /= static_cast<double>(wall.seen.size());
      for (const auto& segment : wall.seen) {
        const Eigen::Vector2d error = offsetOf(segment) - mean;
        nees += error.dot(segment.line.covariance.inverse() * error);
      }
    }
  };

  /// Within 0.15 m and 5 degrees, at least half of the shorter one beside the other.
  static bool isSame(const geometry::LineSegment& a, const geometry::LineSegment& b) {
    const auto difference = geometry::difference(a.line, b.line);
    if (std::abs(difference[0]) > 0.15 || std::abs(difference[1]) > 0.09) return false;
    const double from = a.ends.along(b.ends.start);
    const double to = a.ends.along(b.ends.end);
    const double overlap =
        std::min(std::max(from, to), a.ends.length()) - std::max(std::min(from, to), 0.0);
    return overlap > 0.5 * std::min(a.ends.length(), b.ends.length());
  }

  void take(const geometry::LineSegment& segment) {
    const auto wall = std::find_if(walls_.begin(), walls_.end(),
                                   [&](const Wall& of) { return isSame(of.first, segment); });
    if (wall == walls_.end()) {
      walls_.push_back({segment, {segment}, std::vector<std::size_t>(scans_, 0)});
      walls_.back().pieces.back() = 1;
    } else if (++wall->pieces.back() == 1) {
      wall->seen.push_back(segment);
    }
  }

  std::vector<Wall> walls_;
  std::size_t scans_ = 0;
};

}  // namespace sightline::bench
