#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "body_worn.h"
#include "sightline/dead_reckoning/angle_histogram.h"
#include "sightline/dead_reckoning/dead_reckoner_config.h"
#include "sightline/dead_reckoning/histogram_matcher.h"
#include "sightline/dead_reckoning/surface_points.h"
#include "sightline/dead_reckoning/translation_search.h"
#include "sightline/plot/figure.h"

/// The figures of saarinen section 4.3.4, drawn anew from a simulated walk through rooms and
/// corridors: saarinen_4_8.png, two scans one after the other in a fast turn, and with floor in the
/// second; 4_11, correlation of their angle histograms by step size; 4_12, correlation values over
/// the positions in a corridor; 4_13, the squares of the iterative searcher.
namespace sightline::bench {

class ThesisPlots {
 public:
  explicit ThesisPlots(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directories(folder);
    const Building building = serpentineBuilding(30.0, 1);
    views_ = BodyWornWalk(building, 80.0, 1).look();
  }

  void draw() const {
    drawScans();
    drawAngles();
    drawValues();
    drawSearch();
  }

 private:
  using Pose2 = geometry::Pose2;
  using Panel = plot::Panel;
  using Series = plot::Series;
  static constexpr double kHalf = 1.28;  // of the square that is searched [m]

  // The scan for which a measure is largest, which is not the first.
  std::size_t mostOf(const std::function<double(std::size_t)>& measure) const {
    std::size_t best = 1;
    for (std::size_t i = 2; i < views_.size(); ++i) {
      if (measure(i) > measure(best)) best = i;
    }
    return best;
  }
  Pose2 stepTo(std::size_t i) const {
    return geometry::between(views_[i - 1].T_map_base, views_[i].T_map_base);
  }
  std::size_t fastestTurn() const {
    return mostOf([&](std::size_t i) { return std::abs(stepTo(i).theta()); });
  }
  std::size_t mostFloor() const {
    return mostOf([&](std::size_t i) {
      return std::count(views_[i].on_floor.begin(), views_[i].on_floor.end(), true);
    });
  }
  // In the middle of the first corridor.
  std::size_t inCorridor() const {
    return mostOf([&](std::size_t i) {
      return -(views_[i].T_map_base.translation() - Eigen::Vector2d(9.0, 0.0)).norm();
    });
  }

  Series returnsOf(std::size_t i, const std::string& title, const Pose2& T_frame_base,
                   bool on_floor) const {
    Series series{title, plot::Style::kPoints, {}};
    const BodyWornView& view = views_[i];
    for (std::size_t beam = 0; beam < view.scan.beams(); ++beam) {
      if (!view.scan.isValid(beam) || view.on_floor[beam] != on_floor) continue;
      const Eigen::Vector2d point = T_frame_base * view.scan.point(beam);
      series.points.push_back({point.x(), point.y()});
    }
    return series;
  }

  void write(const std::string& name, const plot::Figure& figure) const {
    const std::string path = (folder_ / name).string();
    plot::writePng(figure, path);
    fmt::print("# {}\n", path);
  }

  void drawScans() const {
    const std::size_t turn = fastestTurn();
    const std::size_t floor = mostFloor();
    const Pose2 step = stepTo(floor);
    Panel heading{fmt::format("a) a turn of {:.0f} degrees between two scans",
                              geometry::degrees(stepTo(turn).theta())),
                  "x [m]",
                  "y [m]",
                  {},
                  0.0,
                  {returnsOf(turn - 1, "scan before", {}, false),
                   returnsOf(turn, "current scan", {}, false)}};
    Panel reflections{"b) floor in the current scan",
                      "x [m]",
                      "y [m]",
                      {},
                      0.0,
                      {returnsOf(floor - 1, "scan before", {}, false),
                       returnsOf(floor, "current scan", step, false),
                       returnsOf(floor, "floor or ceiling", step, true)}};
    write("saarinen_4_8.png", {1400, 700, 2, {heading, reflections}});
  }

  dead_reckoning::SurfaceScan surfacesOf(std::size_t i) const {
    return dead_reckoning::readSurfaces(views_[i].scan, Pose2(), Eigen::Vector3d::Zero());
  }

  // S(k) of eq. 4.7 over turns of ±40°, its largest value 1.
  static Series correlation(const std::string& title, const std::vector<double>& reference,
                            const std::vector<double>& scan) {
    Series series{title, plot::Style::kLine, {}};
    const auto bins = static_cast<long>(scan.size());
    double most = 0.0;
    for (long k = -2 * bins / 9; k <= 2 * bins / 9; ++k) {
      double sum = 0.0;
      for (long i = 0; i < bins; ++i) {
        sum += scan[static_cast<std::size_t>(i)] *
               reference[static_cast<std::size_t>((i + k + bins) % bins)];
      }
      most = std::max(most, sum);
      series.points.push_back({180.0 * static_cast<double>(k) / static_cast<double>(bins), sum});
    }
    for (plot::Point& point : series.points) point.y /= most;
    return series;
  }

  void drawAngles() const {
    const std::size_t now = fastestTurn();
    const auto reference = surfacesOf(now - 1);
    const auto scan = surfacesOf(now);
    Panel panel{fmt::format("correlation of the angle histograms, true turn {:.1f} degrees",
                            geometry::degrees(stepTo(now).theta())),
                "turn [deg]",
                "S(k) over its largest",
                {},
                0.0,
                {}};
    constexpr std::size_t kBins = 360;
    for (const double step : dead_reckoning::HistogramConfig().steps) {
      const auto skip =
          static_cast<std::size_t>(std::lround(geometry::radians(step) / scan.beam_angle));
      panel.series.push_back(
          correlation(fmt::format("{} points", skip),
                      dead_reckoning::angleHistogram(reference.points, skip, kBins),
                      dead_reckoning::angleHistogram(scan.points, skip, kBins)));
    }
    write("saarinen_4_11.png", {1000, 600, 1, {panel}});
  }

  // Calls with the cost of eq. 4.8 in the corridor, the turn being the true one.
  void withCost(const std::function<void(const dead_reckoning::CellCost&)>& use) const {
    const std::size_t now = inCorridor();
    const dead_reckoning::HistogramConfig config;
    dead_reckoning::DistanceField field;
    field.draw(surfacesOf(now - 1).points,
               dead_reckoning::fieldDistance(config.max_distance, kHalf));
    const Eigen::Matrix2d rotation = stepTo(now).rotation();
    std::vector<Eigen::Vector2d> points;
    for (const auto& point : surfacesOf(now).points) points.push_back(rotation * point.position);
    use(dead_reckoning::translationCost(field, points, config.max_distance));
  }

  static Series truth(const Pose2& step) {
    return {"true step", plot::Style::kLineAndPoints, {{step.x(), step.y()}}};
  }

  void drawValues() const {
    constexpr double kStep = 0.04;  // m
    Series values{"", plot::Style::kColouredPoints, {}};
    withCost([&](const dead_reckoning::CellCost& cost) {
      for (double y = -kHalf; y < kHalf; y += kStep) {
        for (double x = -kHalf; x < kHalf; x += kStep)
          values.points.push_back({x, y, cost({x, y}, kStep)});
      }
    });
    write("saarinen_4_12.png", {900,
                                800,
                                1,
                                {{"correlation values in a corridor: small ones match",
                                  "x [m]",
                                  "y [m]",
                                  "mean distance over D",
                                  0.0,
                                  {values, truth(stepTo(inCorridor()))}}}});
  }

  // Outline of the square of so many cells [m] that begins with a position.
  static void outline(const Eigen::Vector2d& first, double cell, Series& series) {
    constexpr double kCells = 4.0;
    const Eigen::Vector2d low = first.array() - 0.5 * cell;
    const Eigen::Vector2d high = low.array() + kCells * cell;
    for (const auto& [x, y] : {std::pair(low.x(), low.y()),
                               {high.x(), low.y()},
                               {high.x(), high.y()},
                               {low.x(), high.y()},
                               {low.x(), low.y()}}) {
      series.points.push_back({x, y});
    }
    series.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0});
  }

  void drawSearch() const {
    constexpr double kResolution = 0.02;  // m
    constexpr std::size_t kCells = 16;    // of a square
    std::vector<std::pair<Eigen::Vector2d, double>> asked;
    withCost([&](const dead_reckoning::CellCost& cost) {
      const auto asking = [&](const Eigen::Vector2d& position, double cell) {
        asked.emplace_back(position, cell);
        return cost(position, cell);
      };
      dead_reckoning::searchIteratively(asking, Eigen::Vector2d::Zero(), kHalf, kResolution);
    });
    Panel panel{"squares of the iterative searcher", "x [m]", "y [m]", {}, 0.0, {}};
    for (std::size_t i = 0; i < asked.size(); i += kCells) {
      const auto& [first, cell] = asked[i];
      const std::string title = fmt::format("cells of {:.2f} m", cell);
      if (panel.series.empty() || panel.series.back().title != title) {
        panel.series.push_back({title, plot::Style::kLine, {}});
      }
      outline(first, cell, panel.series.back());
    }
    panel.series.push_back(truth(stepTo(inCorridor())));
    write("saarinen_4_13.png", {900, 800, 1, {panel}});
  }

  std::filesystem::path folder_;
  std::vector<BodyWornView> views_;
};

}  // namespace sightline::bench
