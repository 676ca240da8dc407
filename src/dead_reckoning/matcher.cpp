#include "sightline/dead_reckoning/matcher.h"

#include "sightline/dead_reckoning/histogram_matcher.h"
#include "sightline/dead_reckoning/pose_space.h"
#include "sightline/dead_reckoning/submap_matcher.h"

namespace sightline::dead_reckoning {

std::unique_ptr<Matcher> makeMatcher(const DeadReckonerConfig& config) {
  config::validate(config);
  switch (config.method) {
    case Method::kPoseSpace:
      return std::make_unique<PoseSpaceMatcher>(config.pose_space);
    case Method::kHistogram:
      return std::make_unique<HistogramMatcher>(config.histogram);
    case Method::kSubmap:
      break;
  }
  return std::make_unique<SubmapMatcher>(config.submap);
}

}  // namespace sightline::dead_reckoning
