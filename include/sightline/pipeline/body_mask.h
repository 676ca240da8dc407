#pragma once

#include <map>
#include <string>
#include <vector>

#include "sightline/geometry/pose2.h"
#include "sightline/scan/scan.h"

namespace sightline::pipeline {

/// Directions in which a scanner sees its own robot, in the frame of the base: pairs of angles,
/// from one counter-clockwise to the other [rad], by the scanner's frame. A pair may cross ±π.
using BodySectors = std::map<std::string, std::vector<double>>;

/// Throws config::Error where angles are no pairs.
void checkSectors(const BodySectors& sectors);

/// Makes the beams kInvalid that leave in these directions, of a scan of a level sensor the right
/// way up.
void maskBody(const std::vector<double>& sectors, const geometry::Pose2& T_base_sensor,
              scan::Scan& scan);

}  // namespace sightline::pipeline
