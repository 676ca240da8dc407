#include "sightline/bridge/mountings.h"

#include "sightline/bridge/pose_conversion.h"

namespace sightline::bridge {

tf2_msgs::TFMessage mountingTransforms(const pipeline::OfflineConfig& config) {
  tf2_msgs::TFMessage message;
  for (const auto& [frame, T_base_sensor] : config.mountings) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = config.frames.base;
    transform.child_frame_id = frame;
    transform.transform = toTransform(T_base_sensor);
    message.transforms.push_back(transform);
  }
  return message;
}

}  // namespace sightline::bridge
