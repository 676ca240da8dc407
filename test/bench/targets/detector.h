#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/targets/characterization.h"
#include "targets/hallway.h"

namespace sightline::bench {

/// Counts of the detector on scans of the simulated hallway.
class DetectorFigures {
 public:
  void add(const HallwayRun& run, const std::vector<HallwayLook>& looks) {
    for (const HallwayLook& look : looks) {
      for (const Eigen::Vector2d& target : run.targets()) {
        const auto place = targets::polarOf(look.T_map_sensor.inverse() * target);
        if (place.range >= 5.0 || std::abs(place.bearing) >= 0.74 * geometry::kPi) continue;
        if (!run.isInSight(look, target) || isBehindMate(look, target)) continue;
        addTarget(look, place);
      }
      clutter_ += static_cast<double>(clutterOf(run, look));
      brightest_ = std::max(brightest_, look.brightest_clutter);
      brightness_.insert(brightness_.end(), look.brightness.begin(), look.brightness.end());
    }
    looks_ += static_cast<double>(looks.size());
  }

  /// Largest difference from eq. 1, over bins with enough tries: those of one bump are not
  /// independent, so that the standard error of a bin is 0.015 at most.
  double recallDifference(bool is_coarse, const targets::DetectionConfig& eq1) const {
    constexpr double kEnough = 2000.0;
    targets::SensorModelConfig config;
    config.detection = eq1;
    const targets::SensorModel model(config);
    double worst = 0.0;
    for (std::size_t bin = 0; bin < tried_.size(); ++bin) {
      if (tried_[bin] < kEnough) continue;
      const double share = (is_coarse ? coarse_ : fine_)[bin] / tried_[bin];
      const double range = 0.2 * (static_cast<double>(bin) + 0.5);
      const double expected = model.detection(targets::Polar{range, 0.0});
      fmt::print("# range {:.1f} m: recall {:.3f} of {:.0f}, eq. 1 {:.3f}\n", range, share,
                 tried_[bin], expected);
      worst = std::max(worst, std::abs(share - expected));
    }
    return worst;
  }

  double sigmaExact() const { return std::sqrt(squares_ / std::max(hits_, 1.0)); }
  double clutterMean() const { return clutter_ / looks_; }
  /// Range at which targets are still brighter than all clutter.
  double rangeWithoutClutter() const {
    double farthest = 0.0;
    for (const auto& [range, intensity] : brightness_) {
      if (intensity > brightest_) farthest = std::max(farthest, range);
    }
    return farthest;
  }

 private:
  static constexpr double kSame = 0.026;  // rad, 1.5 degrees

  static bool isBehindMate(const HallwayLook& look, const Eigen::Vector2d& target) {
    const Eigen::Vector2d from = look.T_map_sensor.translation();
    const Eigen::Vector2d way = target - from;
    return std::any_of(look.mates_map.begin(), look.mates_map.end(), [&](const auto& mate) {
      const double along = std::clamp((mate - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
      return (from + along * way - mate).norm() < 0.3;
    });
  }

  static const double* nearest(const std::vector<double>& bearings, double bearing) {
    for (const double& one : bearings) {
      if (std::abs(geometry::wrapAngle(one - bearing)) < kSame) return &one;
    }
    return nullptr;
  }

  void addTarget(const HallwayLook& look, const targets::Polar& place) {
    const auto bin = static_cast<std::size_t>(place.range / 0.2);
    tried_[bin] += 1.0;
    if (nearest(look.coarse, place.bearing) != nullptr) coarse_[bin] += 1.0;
    const double* found = nearest(look.fine, place.bearing);
    if (found == nullptr) return;
    fine_[bin] += 1.0;
    hits_ += 1.0;
    squares_ += std::pow(geometry::wrapAngle(*found - place.bearing), 2);
  }

  static std::size_t clutterOf(const HallwayRun& run, const HallwayLook& look) {
    return static_cast<std::size_t>(
        std::count_if(look.fine.begin(), look.fine.end(), [&](double bearing) {
          return std::none_of(
              run.targets().begin(), run.targets().end(), [&](const Eigen::Vector2d& target) {
                const auto place = targets::polarOf(look.T_map_sensor.inverse() * target);
                return place.range < 5.1 &&
                       std::abs(geometry::wrapAngle(bearing - place.bearing)) < kSame;
              });
        }));
  }

  std::vector<double> tried_ = std::vector<double>(25);
  std::vector<double> fine_ = std::vector<double>(25);
  std::vector<double> coarse_ = std::vector<double>(25);
  double hits_ = 0.0;
  double squares_ = 0.0;
  double looks_ = 0.0;
  double clutter_ = 0.0;
  double brightest_ = 0.0;
  std::vector<std::pair<double, double>> brightness_;
};

/// 1959 looks of a run with the errors of the robots' own poses, as the characterisation takes
/// them.
inline std::vector<targets::KnownLook> disturbed(const std::vector<HallwayLook>& looks,
                                                 double position_sigma, double heading_sigma) {
  constexpr std::size_t kLooks = 1959;
  constexpr double kKept = 0.7;  // of a robot's error from look to look
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::Vector3d errors[3] = {};
  std::vector<targets::KnownLook> known;
  const std::size_t count = std::min(kLooks, looks.size());
  for (std::size_t i = 0; i < count; ++i) {
    const HallwayLook& look = looks[i * looks.size() / count];
    Eigen::Vector3d& error = errors[look.robot];
    for (int j = 0; j < 3; ++j) {
      const double sigma = j < 2 ? position_sigma : heading_sigma;
      error[j] = kKept * error[j] + std::sqrt(1.0 - kKept * kKept) * sigma * normal(random);
    }
    targets::KnownLook one;
    one.robot = look.robot;
    one.stamp = look.stamp;
    one.T_map_sensor = geometry::Pose2(Eigen::Vector3d(look.T_map_sensor.coordinates() + error));
    one.turn_rate = look.turn_rate;
    one.bearings = look.fine;
    one.mates_map = look.mates_map;
    known.push_back(one);
  }
  return known;
}

/// Mean over the robots whose detections determine it; none: nothing [rad].
inline std::optional<double> meanSigma(const targets::Characterization& found) {
  double sum = 0.0;
  double robots = 0.0;
  for (const auto& [name, robot] : found.robots) {
    if (!(robot.errors.sigma > 0.0)) continue;
    sum += robot.errors.sigma * robot.errors.tail;
    robots += 1.0;
  }
  return robots > 0.0 ? std::optional<double>(sum / robots) : std::nullopt;
}

inline targets::Characterization characterizeRun(const HallwayRun& run,
                                                 const std::vector<HallwayLook>& looks) {
  return targets::characterize(disturbed(looks, 0.03, geometry::radians(2.1)),
                               {"robot1", "robot2", "robot3"}, run.targets(), {});
}

/// The detector in the shipped hallway.
inline void measureDetector(int seeds) {
  DetectorFigures figures;
  std::vector<double> sigmas;
  for (int seed = 1; seed <= seeds; ++seed) {
    HallwayConfig config;
    config.seed = static_cast<std::uint64_t>(seed);
    HallwayRun run(config);
    const auto looks = run.run();
    figures.add(run, looks);
    const auto found = characterizeRun(run, looks);
    if (const auto sigma = meanSigma(found)) sigmas.push_back(geometry::degrees(*sigma));
    if (seed > 1) continue;
    for (const std::string& line : found.report()) fmt::print("# {}\n", line);
  }
  targets::DetectionConfig eq1;
  print("targets.detector.recall_difference", figures.recallDifference(true, eq1), "1");
  eq1.beam_spacing = geometry::radians(0.25);
  print("targets.detector.recall_difference_fine", figures.recallDifference(false, eq1), "1");
  print("targets.detector.sigma_exact_deg", geometry::degrees(figures.sigmaExact()), "deg");
  print("targets.detector.sigma_run_deg", mean(sigmas), "deg");
  print("targets.detector.clutter_a_scan", figures.clutterMean(), "1");
  print("targets.detector.range_without_clutter_m", figures.rangeWithoutClutter(), "m");
}

/// Section 3.4 of dames: what the place does to the clutter. In the open it has no peaks, glass
/// makes more of it and higher ones.
inline void measurePlaces(int seeds) {
  const std::pair<const char*, const char*> places[] = {{"open", "open_targets.yaml"},
                                                        {"hallway", "hallway_targets.yaml"},
                                                        {"glass", "hallway_glass_targets.yaml"}};
  for (const auto& [name, world] : places) {
    double mu = 0.0, in_peaks = 0.0, share = 0.0, width = 0.0;
    for (int seed = 1; seed <= seeds; ++seed) {
      HallwayConfig config;
      config.seed = static_cast<std::uint64_t>(seed);
      config.world = world;
      HallwayRun run(config);
      const auto found = characterizeRun(run, run.run());
      const auto& clutter = found.clutter;
      mu += clutter.mean.value / seeds;
      in_peaks += clutter.mean.value * (1.0 - clutter.uniform_share.value) / seeds;
      share += clutter.uniform_share.value / seeds;
      width += clutter.peak_width.value / geometry::kPi / seeds;
    }
    const std::string figure = std::string("targets.place.") + name;
    print(figure + ".mu", mu, "1");
    print(figure + ".mu_in_peaks", in_peaks, "1");
    print(figure + ".p_u", share, "1");
    print(figure + ".theta_c_pi", width, "pi rad");
  }
}

}  // namespace sightline::bench
