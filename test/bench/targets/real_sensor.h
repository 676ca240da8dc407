#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "figures.h"
#include "sightline/geometry/stamped_pose2.h"
#include "sightline/logs/mrclam.h"
#include "sightline/targets/characterization.h"

namespace sightline::bench {

/// Looks of a set of the UTIAS multi-robot data at known poses, with the identities that the log
/// has and the characterisation is not told.
class IdentifiedLooks {
 public:
  explicit IdentifiedLooks(const std::string& folder) : set_(logs::readMrclam(folder)) {
    for (const auto& landmark : set_.landmarks) landmarks_.push_back(landmark.place);
    for (std::size_t robot = 0; robot < set_.robots.size(); ++robot) add(robot);
    std::stable_sort(looks_.begin(), looks_.end(),
                     [](const Look& a, const Look& b) { return a.known.stamp < b.known.stamp; });
  }

  struct Look {
    targets::KnownLook known;
    std::vector<int> subjects;  // of its bearings
  };
  const std::vector<Look>& looks() const { return looks_; }
  const std::vector<Eigen::Vector2d>& landmarks() const { return landmarks_; }
  /// Number of the landmark that a subject is, or none.
  std::optional<std::size_t> landmarkOf(int subject) const {
    for (std::size_t i = 0; i < set_.landmarks.size(); ++i) {
      if (set_.landmarks[i].subject == subject) return i;
    }
    return std::nullopt;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& robot : set_.robots) names.push_back(fmt::format("robot{}", robot.subject));
    return names;
  }
  std::vector<targets::KnownLook> known(std::size_t from, std::size_t to) const {
    std::vector<targets::KnownLook> result;
    for (std::size_t i = from; i < to; ++i) result.push_back(looks_[i].known);
    return result;
  }

 private:
  static constexpr std::int64_t kGap = 1'000'000'000;

  std::optional<geometry::Pose2> poseOf(std::size_t robot, std::int64_t stamp) const {
    const auto& truth = set_.robots[robot].truth;
    return geometry::poseAt(truth.begin(), truth.end(), stamp, kGap);
  }

  void add(std::size_t robot) {
    constexpr std::int64_t kBefore = 50'000'000;
    const auto& logged = set_.robots[robot].looks;
    for (const auto& image : logs::withEmptyLooks(logged, logs::cameraPeriod(logged))) {
      const auto pose = poseOf(robot, image.stamp);
      const auto before = poseOf(robot, image.stamp - kBefore);
      if (!pose || !before) continue;
      Look look;
      look.known.robot = robot;
      look.known.stamp = image.stamp;
      look.known.T_map_sensor = *pose;
      look.known.turn_rate = geometry::wrapAngle(pose->theta() - before->theta()) * 1e9 / kBefore;
      for (const auto& sighting : image.sightings) {
        look.known.bearings.push_back(sighting.bearing);
        look.subjects.push_back(sighting.subject);
      }
      for (std::size_t other = 0; other < set_.robots.size(); ++other) {
        if (other == robot) continue;
        if (const auto mate = poseOf(other, image.stamp)) {
          look.known.mates_map.push_back(mate->translation());
        }
      }
      looks_.push_back(std::move(look));
    }
  }

  logs::MrclamSet set_;
  std::vector<Eigen::Vector2d> landmarks_;
  std::vector<Look> looks_;
};

/// Bearings of one robot against the truth, by the identities of the log.
struct TrueErrors {
  double sigma = 0.0;   // of the core, by the same mixture [rad]
  double spread = 0.0;  // by the median of what is left [rad]
  double bias = 0.0;    // median [rad]
  double lag = 0.0;     // [s]
};

inline TrueErrors trueErrors(const IdentifiedLooks& all, std::size_t robot) {
  std::vector<std::pair<double, double>> errors;  // error, turn rate
  std::vector<targets::KnownLook> looks;
  std::vector<targets::Opportunity> labelled;
  for (const auto& look : all.looks()) {
    if (look.known.robot != robot) continue;
    for (std::size_t i = 0; i < look.subjects.size(); ++i) {
      const auto landmark = all.landmarkOf(look.subjects[i]);
      if (!landmark) continue;
      const auto place =
          targets::polarOf(look.known.T_map_sensor.inverse() * all.landmarks()[*landmark]);
      errors.emplace_back(geometry::wrapAngle(look.known.bearings[i] - place.bearing),
                          look.known.turn_rate);
      labelled.push_back({looks.size(), *landmark, place, true, errors.back().first});
    }
    looks.push_back(look.known);
  }
  constexpr double kGate = 0.12;  // rad
  TrueErrors result;
  result.sigma = targets::fitErrors(looks, labelled, kGate).sigma;
  for (int round = 0; round < 20; ++round) {
    std::vector<double> left;
    for (const auto& [error, rate] : errors) left.push_back(error - result.lag * rate);
    result.bias = median(left);
    for (double& one : left) one = std::abs(one - result.bias);
    result.spread = 1.4826 * median(left);
    double products = 0.0;
    double squares = 0.0;
    for (const auto& [error, rate] : errors) {
      if (std::abs(error - result.lag * rate - result.bias) > 3.0 * result.spread) continue;
      products += rate * (error - result.bias);
      squares += rate * rate;
    }
    result.lag = squares > 0.0 ? products / squares : 0.0;
  }
  return result;
}

/// Differences of tables that were fitted on one half of the looks from what the other half shows,
/// weighed by the tries of each bin.
class HeldOutDetections {
 public:
  void add(const IdentifiedLooks& all, const IdentifiedLooks::Look& look,
           const targets::RobotCharacter& character, const targets::FieldOfView& view,
           double range_max) {
    for (std::size_t landmark = 0; landmark < all.landmarks().size(); ++landmark) {
      const auto place =
          targets::polarOf(look.known.T_map_sensor.inverse() * all.landmarks()[landmark]);
      if (place.range >= range_max || !view.contains(place.bearing)) continue;
      const bool is_seen =
          std::any_of(look.subjects.begin(), look.subjects.end(),
                      [&](int subject) { return all.landmarkOf(subject) == landmark; });
      Bin& bin =
          bins_[{static_cast<int>(place.range), static_cast<int>(std::floor(place.bearing / 0.2))}];
      bin.tried += 1.0;
      bin.seen += is_seen ? 1.0 : 0.0;
      bin.predicted += character.table.at(place.range, place.bearing);
    }
  }
  double rms() const {
    double squares = 0.0;
    double tried = 0.0;
    for (const auto& [key, bin] : bins_) {
      squares += bin.tried * std::pow((bin.seen - bin.predicted) / bin.tried, 2);
      tried += bin.tried;
    }
    return std::sqrt(squares / std::max(tried, 1.0));
  }

 private:
  struct Bin {
    double tried = 0.0;
    double seen = 0.0;
    double predicted = 0.0;
  };
  std::map<std::pair<int, int>, Bin> bins_;
};

/// The characterisation of real cameras against the identities of the log.
inline void measureRealSensors(const std::string& folder) {
  const IdentifiedLooks all(folder);
  targets::CharacterizationConfig config;
  config.field_of_view = {-0.65, 0.65};
  config.range_max = 9.0;
  const std::size_t count = all.looks().size();
  const auto found =
      targets::characterize(all.known(0, count), all.names(), all.landmarks(), config);
  double sigma = 0.0, bias = 0.0, lag = 0.0;
  const auto names = all.names();
  for (std::size_t robot = 0; robot < names.size(); ++robot) {
    const TrueErrors truth = trueErrors(all, robot);
    const auto& errors = found.robots.at(names[robot]).errors;
    fmt::print(
        "# {}: sigma {:.3f} ({:.3f} true) deg, bias {:.3f} ({:.3f}) deg, lag {:.1f} ({:.1f}) "
        "ms\n",
        names[robot], geometry::degrees(errors.sigma), geometry::degrees(truth.sigma),
        geometry::degrees(errors.bias), geometry::degrees(truth.bias), 1e3 * errors.lag,
        1e3 * truth.lag);
    sigma = std::max(sigma, std::abs(errors.sigma - truth.sigma));
    bias = std::max(bias, std::abs(errors.bias - truth.bias));
    lag = std::max(lag, std::abs(errors.lag - truth.lag));
  }
  std::printf("# largest of any robot\n");
  print("targets.real.sigma_error_deg", geometry::degrees(sigma), "deg");
  print("targets.real.bias_error_deg", geometry::degrees(bias), "deg");
  print("targets.real.lag_error_ms", 1e3 * lag, "ms");
  const auto half = targets::characterize(all.known(0, count / 2), names, all.landmarks(), config);
  HeldOutDetections held_out;
  for (std::size_t i = count / 2; i < count; ++i) {
    const auto& look = all.looks()[i];
    const auto character = half.robots.find(names[look.known.robot]);
    if (character == half.robots.end()) continue;
    held_out.add(all, look, character->second, config.field_of_view, config.range_max);
  }
  print("targets.real.pd_rms", held_out.rms(), "1");
}

}  // namespace sightline::bench
