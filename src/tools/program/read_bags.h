#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "sightline/bridge/bag_feed.h"

namespace sightline::tools {

/// Hands the located scans of bags to something that takes them, and says what damage ended the
/// reading.
///
/// @param progress  is called with the share that has been read
template <class Take, class Progress>
void readBags(const std::vector<std::string>& paths, const pipeline::EstimatorsConfig& config,
              const Take& take, const Progress& progress) {
  bridge::BagFeed feed(paths, config, {});
  bridge::BagFeed::Visitor visitor;
  visitor.scan = [&](pipeline::LocatedScan located, const ros::Time&) { take(std::move(located)); };
  visitor.message = [](const rosbag::MessageInstance&) {};
  visitor.progress = progress;
  feed.read(visitor);
  if (!feed.damage().empty()) std::fprintf(stderr, "%s\n", feed.damage().c_str());
}

}  // namespace sightline::tools
