#include "sightline/bridge/bag_from_mrclam.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>

#include "sightline/bridge/message_header.h"
#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/target_messages.h"
#include "sightline/bridge/time.h"
#include "sightline/config/error.h"
#include "sightline/logs/fields.h"

namespace sightline::bridge {

namespace {

// The cameras' field of view, some 60° wide, with a margin; and how far a marker can be read.
constexpr targets::FieldOfView kCameraView{-0.65, 0.65};
constexpr double kCameraRange = 9.0;
// Poses are written this far apart [ns]; they came faster.
constexpr std::int64_t kPoseStep = 50'000'000;

struct BagItem {
  std::int64_t stamp;
  std::size_t robot;
  std::size_t index;
  enum Kind { kPose, kLook, kOdometry } kind;
};

std::string robotName(const logs::MrclamRobot& robot) {
  return fmt::format("robot{}", robot.subject);
}

// Errors of a robot's poses: an Ornstein-Uhlenbeck process.
class PoseErrors {
 public:
  PoseErrors(const MrclamBagOptions& options, std::size_t robot)
      : options_(options), random_(static_cast<std::uint64_t>(options.seed) * 1000003 + robot) {}

  geometry::Pose2 disturb(const geometry::StampedPose2& sample) {
    const double passed = 1e-9 * static_cast<double>(sample.stamp - stamp_);
    const double kept = options_.pose_correlation > 0.0 && stamp_ > 0
                            ? std::exp(-passed / options_.pose_correlation)
                            : 0.0;
    stamp_ = sample.stamp;
    const double fresh = std::sqrt(1.0 - kept * kept);
    const double sigmas[] = {options_.position_sigma, options_.position_sigma,
                             options_.heading_sigma};
    for (int i = 0; i < 3; ++i) error_[i] = kept * error_[i] + fresh * sigmas[i] * normal_(random_);
    return geometry::Pose2(Eigen::Vector3d(sample.pose.coordinates() + error_));
  }

 private:
  MrclamBagOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::Vector3d error_ = Eigen::Vector3d::Zero();
  std::int64_t stamp_ = 0;
};

std::ofstream openBeside(const std::string& path, const std::string& ending) {
  std::ofstream file(path + ending);
  if (!file) throw config::Error(path + ending, 0, "", "cannot be written");
  return file;
}

class MrclamBag {
 public:
  MrclamBag(const logs::MrclamSet& set, const MrclamBagOptions& options, const std::string& path)
      : options_(options), path_(path), robots_(set.robots) {
    for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
      contents_.robots.push_back(robotName(robots_[robot]));
      errors_.emplace_back(options, robot);
      prepare(robots_[robot], robot);
    }
    std::stable_sort(items_.begin(), items_.end(),
                     [](const BagItem& a, const BagItem& b) { return a.stamp < b.stamp; });
    keepAsked();
  }

  MrclamBagContents write() {
    open();
    for (const BagItem& item : items_) {
      if (item.kind == BagItem::kPose) writePose(item);
      if (item.kind == BagItem::kLook) writeLook(item);
      if (item.kind == BagItem::kOdometry) writeOdometry(item);
    }
    bag_.close();
    return contents_;
  }

 private:
  // Not before it is known that there is something to write.
  void open() {
    bag_.open(path_, rosbag::bagmode::Write);
    // The covariances of the odometry are zeros, most of the bag.
    bag_.setCompression(rosbag::compression::LZ4);
    labels_ = openBeside(path_, ".labels.csv");
    labels_ << "stamp,robot,index,subject\n";
  }

  void prepare(logs::MrclamRobot& robot, std::size_t index) {
    const std::size_t logged = robot.looks.size();
    if (options_.period >= 0.0) {
      const std::int64_t period = options_.period > 0.0 ? std::llround(1e9 * options_.period)
                                                        : logs::cameraPeriod(robot.looks);
      robot.looks = logs::withEmptyLooks(robot.looks, period);
    }
    contents_.empty += robot.looks.size() - logged;
    const std::int64_t lag = std::llround(1e9 * options_.lag);
    for (std::size_t i = 0; i < robot.looks.size(); ++i) {
      robot.looks[i].stamp -= lag;
      items_.push_back({robot.looks[i].stamp, index, i, BagItem::kLook});
    }
    std::int64_t next = 0;
    for (std::size_t i = 0; i < robot.truth.size(); ++i) {
      if (robot.truth[i].stamp < next) continue;
      next = robot.truth[i].stamp + kPoseStep;
      items_.push_back({robot.truth[i].stamp, index, i, BagItem::kPose});
    }
    for (std::size_t i = 0; i < robot.velocities.size(); ++i) {
      items_.push_back({robot.velocities[i].stamp, index, i, BagItem::kOdometry});
    }
  }

  // Leaves out what the options do not ask for.
  void keepAsked() {
    if (items_.empty()) return;
    const auto at = [begin = items_.front().stamp](double seconds) {
      return begin + std::llround(1e9 * seconds);
    };
    const auto is_beyond = [from = at(options_.from), to = at(options_.to)](const BagItem& item) {
      return item.stamp < from || item.stamp > to;
    };
    items_.erase(std::remove_if(items_.begin(), items_.end(), is_beyond), items_.end());
    if (items_.empty()) throw config::Error(path_, 0, "from", "the set has nothing in that time");
  }

  std::string topic(const BagItem& item, const char* name) const {
    return fmt::format("/{}/{}", contents_.robots[item.robot], name);
  }

  void writePose(const BagItem& item) {
    geometry_msgs::PoseWithCovarianceStamped message;
    message.header = headerOf(item.stamp, "map");
    message.pose.pose = toPose(errors_[item.robot].disturb(robots_[item.robot].truth[item.index]));
    const double position = options_.position_sigma * options_.position_sigma;
    const double heading = options_.heading_sigma * options_.heading_sigma;
    message.pose.covariance =
        toCovariance6(Eigen::Vector3d(position, position, heading).asDiagonal());
    bag_.write(topic(item, "pose"), message.header.stamp, message);
    ++contents_.poses;
  }

  void writeLook(const BagItem& item) {
    const logs::MrclamLook& look = robots_[item.robot].looks[item.index];
    targets::BearingSet set;
    set.stamp = look.stamp;
    set.field_of_view = kCameraView;
    set.range_max = kCameraRange;
    for (const logs::MrclamSighting& sighting : look.sightings) {
      fmt::print(labels_, "{},{},{},{}\n", logs::formatStamp(look.stamp),
                 contents_.robots[item.robot], set.bearings.size(), sighting.subject);
      set.bearings.push_back(sighting.bearing - options_.bias);
    }
    const std::string frame = contents_.robots[item.robot] + "/camera";
    bag_.write(topic(item, "bearings"), timeOf(look.stamp), toMessage(set, frame));
    ++contents_.looks;
    contents_.bearings += set.bearings.size();
  }

  void writeOdometry(const BagItem& item) {
    const logs::MrclamVelocity& velocity = robots_[item.robot].velocities[item.index];
    nav_msgs::Odometry message;
    message.header = headerOf(item.stamp, contents_.robots[item.robot] + "/odom");
    message.child_frame_id = contents_.robots[item.robot] + "/base_link";
    message.pose.pose.orientation.w = 1.0;
    message.pose.covariance[0] = -1.0;  // the log has velocities alone
    message.twist.twist.linear.x = velocity.linear;
    message.twist.twist.angular.z = velocity.angular;
    bag_.write(topic(item, "odom"), message.header.stamp, message);
  }

  MrclamBagOptions options_;
  std::string path_;
  rosbag::Bag bag_;
  std::ofstream labels_;
  std::vector<logs::MrclamRobot> robots_;
  std::vector<PoseErrors> errors_;
  std::vector<BagItem> items_;
  MrclamBagContents contents_;
};

void writeMrclamTruth(const logs::MrclamSet& set, const std::string& path) {
  std::ofstream file = openBeside(path, ".truth.csv");
  file << "kind,id,x,y\n";
  for (const logs::MrclamLandmark& landmark : set.landmarks) {
    fmt::print(file, "target,{},{:.6f},{:.6f}\n", landmark.subject, landmark.place.x(),
               landmark.place.y());
  }
  for (const logs::MrclamRobot& robot : set.robots) {
    logs::TrajectoryWriter writer(fmt::format("{}.{}.tum", path, robotName(robot)));
    for (const auto& sample : robot.truth) writer.add(sample.stamp, sample.pose);
    writer.close();
  }
}

}  // namespace

void MrclamBagOptions::visit(config::FieldVisitor& visitor) {
  visitor.number("lag", lag, {"s", {-10.0, 10.0}, "by how much looks are stamped late"});
  visitor.number("bias", bias, {"rad", {-3.2, 3.2}, "measured less true bearing"});
  visitor.number("period", period,
                 {"s", {-1.0, 100.0}, "between two images; 0: found; negative: none put back"});
  visitor.number("from", from, {"s", {0.0, 1e6}, "time in the set at which the bag begins"});
  visitor.number("to", to, {"s", {0.0, 1e6}, "time in the set at which it ends"});
  visitor.number("position_sigma", position_sigma, {"m", {0.0, 1e6}, "error of poses"});
  visitor.number("heading_sigma", heading_sigma, {"rad", {0.0, 1e6}, "of headings"});
  visitor.number("pose_correlation", pose_correlation,
                 {"s", {0.0, 1e6}, "time constant of these errors"});
  visitor.integer("seed", seed, {"-", {0, 1000000}, "of these errors"});
}

MrclamBagContents writeMrclamBag(const logs::MrclamSet& set, const MrclamBagOptions& options,
                                 const std::string& path) {
  config::validate(options);
  MrclamBag bag(set, options, path);
  writeMrclamTruth(set, path);
  return bag.write();
}

}  // namespace sightline::bridge
