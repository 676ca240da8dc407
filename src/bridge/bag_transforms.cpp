#include "sightline/bridge/bag_transforms.h"

#include "sightline/bridge/time.h"

namespace sightline::bridge {

void BagTransforms::add(const tf2_msgs::TFMessage& message, bool is_static) {
  for (const auto& transform : message.transforms) {
    buffer_.setTransform(transform, "bag", is_static);
  }
}

std::optional<geometry_msgs::Transform> BagTransforms::at(const std::string& target,
                                                          const std::string& source,
                                                          std::int64_t stamp) const {
  const ros::Time time = timeOf(stamp);
  // Asking first: exceptions for every scan that has to wait would cost more than the rest.
  if (!buffer_.canTransform(target, source, time)) return std::nullopt;
  return buffer_.lookupTransform(target, source, time).transform;
}

}  // namespace sightline::bridge
