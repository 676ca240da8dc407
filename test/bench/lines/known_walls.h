#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "bench/figures.h"
#include "scenes.h"
#include "score.h"
#include "sightline/lines/line_moments.h"
#include "sightline/lines/piece.h"
#include "view.h"

namespace sightline::bench {

/// A bound for rooms without furniture: what is found by one who knows the noise, and which walls
/// there are in which order, and has only to tell by maximum likelihood between which beams they
/// meet.
class KnownWalls {
 public:
  void add(const View& view) {
    beams_.assign(view.scan);
    takeTrueRuns(view);
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i + 1 < runs_.size(); ++i) settle(runs_[i], runs_[i + 1]);
    }
    for (lines::Piece& run : runs_) lines::refine(beams_, kGateSquared, run);
    for (std::size_t i = 0; i < runs_.size(); ++i) count(view, i);
  }

  void printFigures(const std::string& name) const {
    print("lines." + name + ".known_walls.f1",
          static_cast<double>(found_) / static_cast<double>(wanted_), "1");
  }

 private:
  static constexpr int kRounds = 5;
  static constexpr std::size_t kFewest = 5;  // beams of a wall
  static constexpr double kGateSquared = 3.5 * 3.5;

  void takeTrueRuns(const View& view) {
    runs_.clear();
    spans_.clear();
    for (std::size_t i = 0; i < beams_.size; ++i) {
      const std::size_t span = spanOf(view, i);
      if (runs_.empty() || spans_.back() != span) {
        spans_.push_back(span);
        runs_.emplace_back();
        runs_.back().first = i;
      }
      runs_.back().end = i + 1;
    }
  }
  static std::size_t spanOf(const View& view, std::size_t beam) {
    const Eigen::Vector2d point = view.true_ranges[beam] * view.scan.direction(beam);
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < view.spans.size(); ++k) {
      if (view.spans[k].ends.distance(point) < view.spans[nearest].ends.distance(point)) {
        nearest = k;
      }
    }
    return nearest;
  }

  void settle(lines::Piece& before, lines::Piece& after) const {
    lines::LineMoments left;
    lines::LineMoments right = lines::momentsOf(beams_, before.first, after.end);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t at = before.first; at + kFewest < after.end; ++at) {
      const lines::LineMoments moments = lines::momentsOf(beams_, at);
      left += moments;
      right -= moments;
      if (at + 1 < before.first + kFewest) continue;
      const double cost =
          left.cost() + right.cost() +
          lines::apartSquared(left, right, beams_.direction(at), beams_.direction(at + 1));
      if (cost >= least) continue;
      least = cost;
      before.end = after.first = at + 1;
      before.line = left.line();
      after.line = right.line();
    }
  }

  void count(const View& view, std::size_t i) {
    const VisibleSpan& span = view.spans[spans_[i]];
    if (!isWanted(span)) return;
    ++wanted_;
    geometry::Segment ends = span.floor_ends;
    if (i > 0) ends.start = crossing(i - 1, i);
    if (i + 1 < runs_.size()) ends.end = crossing(i, i + 1);
    if (matches(runs_[i].line.polar(), ends, span)) ++found_;
  }
  Eigen::Vector2d crossing(std::size_t i, std::size_t k) const {
    const lines::LineEstimate& a = runs_[i].line;
    const lines::LineEstimate& b = runs_[k].line;
    Eigen::Matrix2d normals;
    normals << a.normal_x, a.normal_y, b.normal_x, b.normal_y;
    return normals.inverse() * Eigen::Vector2d(a.rho, b.rho);
  }

  lines::BeamArray beams_;
  std::vector<lines::Piece> runs_;
  std::vector<std::size_t> spans_;  // of each run
  std::size_t wanted_ = 0;
  std::size_t found_ = 0;
};

/// The same scans as run() has.
inline void boundOfObtuse(const std::string& name, const Sensor& sensor, int poses) {
  std::mt19937 random(2026);
  KnownWalls bound;
  for (int i = 0; i < poses; ++i) {
    const Scene scene = obtuseRoom(random);
    bound.add(Viewer(scene.world, sensor, scene.pose).view(random));
  }
  bound.printFigures(name);
}

}  // namespace sightline::bench
