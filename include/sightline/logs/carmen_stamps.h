#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sightline/logs/carmen_log.h"
#include "sightline/logs/trajectory.h"

/// Stamps of a log's scans. Some loggers stamp late, in bursts and out of order; the order of the
/// lines is that of the scans.
namespace sightline::logs {

/// Number of scans that are stamped no later than the one before.
std::size_t countNotRising(const CarmenLog& log);

/// Whether the stamps of the scans rise as they are, and are of a time after 1970.
bool hasUsableStamps(const CarmenLog& log);

/// Stamps that rise from scan to scan, one a scan [ns], all after 1970.
///
/// Stamps that rise are kept. Where they do not, those that are out of order share their mean
/// (isotonic regression: of all that never fall, these are the nearest to the logged ones) and are
/// spread evenly about it, at most a second apart. Where the clock was set, back by more than 10 s
/// or ahead by more than a day, time goes on.
std::vector<std::int64_t> risingStamps(const CarmenLog& log);

/// Stamps of one scan.
struct StampPair {
  std::int64_t bag = 0;     ///< in the bag made of a log [ns]
  std::int64_t logged = 0;  ///< [ns]
};

/// Writes and reads `bag-stamp logged-stamp` a line, in seconds. Both throw config::Error.
void writeStamps(const std::string& path, const std::vector<StampPair>& stamps);
std::vector<StampPair> readStamps(const std::string& path);

/// The trajectory at the logged stamps, in their order; poses at other stamps are left out.
Trajectory atLoggedStamps(const Trajectory& trajectory, std::vector<StampPair> stamps);

}  // namespace sightline::logs
