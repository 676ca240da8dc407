#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sightline::bridge {

/// Number of scans by the reason why they were not used.
using ScansByReason = std::map<std::string, std::size_t>;

/// Result of an estimator over a recording.
struct EstimatorCount {
  std::string estimator;
  std::size_t with_pose = 0;   ///< scans; of lines, those that were looked at
  ScansByReason without_pose;  ///< of scans that reached it
};

/// Whether the estimator has no pose for more than half of the scans.
bool fallsShort(const EstimatorCount& count, std::size_t scans);

/// Text for people: why an estimator falls short, the most frequent reason first, each with what to
/// do about it.
///
/// @param dropped  scans that reached no estimator
std::vector<std::string> explainShortfall(const EstimatorCount& count, std::size_t scans,
                                          const ScansByReason& dropped);

}  // namespace sightline::bridge
