#include "sightline/bridge/known_looks.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sightline/bridge/bearing_bags.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

namespace {

// The newest look of each robot, for where the others are.
class LastLooks {
 public:
  targets::KnownLook know(std::size_t robot, const targets::BearingSet& set) {
    targets::KnownLook look;
    look.robot = robot;
    look.stamp = set.stamp;
    look.T_map_sensor = set.T_map_sensor.mean;
    look.bearings = set.bearings;
    for (const auto& [other, last] : last_) {
      const bool is_near = std::abs(set.stamp - last.stamp) <= kSameTime;
      if (other != robot && is_near) look.mates_map.push_back(last.T_map_sensor.translation());
    }
    look.turn_rate = set.turn_rate;
    last_[robot] = look;
    return look;
  }

 private:
  static constexpr std::int64_t kSameTime = 1'000'000'000;
  std::map<std::size_t, targets::KnownLook> last_;
};

}  // namespace

RecordedLooks readKnownLooks(const std::vector<std::string>& paths,
                             const pipeline::BearingTopics& team,
                             const std::function<void(double)>& progress) {
  BearingBags bags(paths, team);
  pipeline::BearingFeed feed(team, bags.transforms());
  RecordedLooks result;
  result.field_of_view = {geometry::kPi, -geometry::kPi};
  LastLooks last;
  bags.read(feed, [&](const ros::Time& now, double ratio) {
    for (const auto& look : feed.ready(nanoseconds(now))) {
      if (!look.fault.empty()) {
        ++result.without_pose;
        continue;
      }
      const auto robot = std::find(team.robots.begin(), team.robots.end(), look.robot);
      result.looks.push_back(
          last.know(static_cast<std::size_t>(robot - team.robots.begin()), look.set));
      result.field_of_view.min = std::min(result.field_of_view.min, look.set.field_of_view.min);
      result.field_of_view.max = std::max(result.field_of_view.max, look.set.field_of_view.max);
      result.range_max = std::max(result.range_max, look.set.range_max);
    }
    progress(ratio);
  });
  return result;
}

}  // namespace sightline::bridge
