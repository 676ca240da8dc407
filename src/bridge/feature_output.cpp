#include "sightline/bridge/feature_output.h"

#include <algorithm>

#include <fmt/format.h>

namespace sightline::bridge {

FeatureOutput::FeatureOutput(Output& output, const pipeline::Frames& frames)
    : frame_(frames.odom),
      features_(output.open<FeatureArray>("features")),
      draws_(!output.isBag()) {
  if (draws_) markers_ = output.open<visualization_msgs::MarkerArray>("feature_markers");
}

void FeatureOutput::write(const pipeline::Estimates& estimates) {
  if (!estimates.features) return;
  ++scans_;
  for (const geometry::Feature& feature : *estimates.features) {
    if (feature.unseen > 0.0) continue;
    ++in_view_;
    fixed_ += feature.behaviour == geometry::FeatureBehaviour::kFixed ? 1 : 0;
  }
  const auto message = toMessage(*estimates.features, frame_, estimates.located.scan.stamp);
  features_.write(message);
  if (draws_ && markers_.is_wanted()) {
    markers_.write(drawing_.draw(*estimates.features, message.header));
  }
}

std::vector<std::string> FeatureOutput::summary() const {
  const auto scans = static_cast<double>(std::max<std::size_t>(scans_, 1));
  return {fmt::format("features: {:.1f} in view, {:.1f} of them fixed, in {} scans",
                      static_cast<double>(in_view_) / scans, static_cast<double>(fixed_) / scans,
                      scans_)};
}

}  // namespace sightline::bridge
