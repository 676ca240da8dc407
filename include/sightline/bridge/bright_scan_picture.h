#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sightline/scan/scan.h"
#include "sightline/targets/bearing_detector.h"

namespace sightline::bridge {

/// The scan of a topic in which the detector finds the most targets; nothing where none has
/// intensities. Throws config::Error where a file is no bag.
std::optional<scan::Scan> brightestScan(const std::vector<std::string>& paths,
                                        const std::string& topic,
                                        const targets::BearingDetector& detector);

/// Picture after figure 4 of dames: the scan in the plane, coloured by intensity, and intensity
/// over bearing with the threshold and the measurement set. Throws plot::Error.
void drawBrightScan(const scan::Scan& scan, const targets::BearingDetectorConfig& config,
                    const std::string& path);

}  // namespace sightline::bridge
