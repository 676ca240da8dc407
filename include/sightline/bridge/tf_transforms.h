#pragma once

#include <string>

#include <tf2/buffer_core.h>

#include "sightline/pipeline/transforms.h"

namespace sightline::bridge {

/// The transforms of a tf buffer, be it filled by a listener or from a bag. Frames may be written
/// with a leading slash, as tf of old had them.
class TfTransforms : public pipeline::Transforms {
 public:
  /// The buffer has to live as long.
  explicit TfTransforms(const tf2::BufferCore& buffer) : buffer_(buffer) {}

  std::optional<Eigen::Isometry3d> at(const std::string& target, const std::string& source,
                                      std::int64_t stamp) const override;
  std::optional<Newest> newest(const std::string& target, const std::string& source) const override;

 private:
  const tf2::BufferCore& buffer_;
};

}  // namespace sightline::bridge
