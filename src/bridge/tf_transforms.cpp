#include "sightline/bridge/tf_transforms.h"

#include "sightline/bridge/pose_conversion.h"
#include "sightline/bridge/time.h"

namespace sightline::bridge {

// Asking first: exceptions for every scan that has to wait would cost more than the rest.
std::optional<Eigen::Isometry3d> TfTransforms::at(const std::string& target,
                                                  const std::string& source,
                                                  std::int64_t stamp) const {
  const std::string to = withoutSlash(target);
  const std::string from = withoutSlash(source);
  const ros::Time time = timeOf(stamp);
  if (to.empty() || from.empty() || time.isZero() || !buffer_.canTransform(to, from, time)) {
    return std::nullopt;
  }
  return toIsometry(buffer_.lookupTransform(to, from, time).transform);
}

std::optional<TfTransforms::Newest> TfTransforms::newest(const std::string& target,
                                                         const std::string& source) const {
  const std::string to = withoutSlash(target);
  const std::string from = withoutSlash(source);
  if (to.empty() || from.empty() || !buffer_.canTransform(to, from, ros::Time(0))) {
    return std::nullopt;
  }
  const auto found = buffer_.lookupTransform(to, from, ros::Time(0));
  Newest newest;
  newest.T_target_source = toIsometry(found.transform);
  // A transform that never changes has no time.
  if (!found.header.stamp.isZero()) newest.stamp = nanoseconds(found.header.stamp);
  return newest;
}

}  // namespace sightline::bridge
