#pragma once

#include <string>

#include "sightline/triangulation/parameter_estimation.h"

namespace sightline::triangulation {

/// The z table as the plain targets of a recording fill it. Throws config::Error naming `source`
/// where that is no table: fewer than two depths, a beam that saw fewer than two of them, a gap, an
/// image position that does not fall.
CalibrationTable tableOf(const CalibrationRecording& recording, const ScanPattern& scan,
                         const std::string& source = "");

/// Writes the file that Calibration::read() takes, to the last digit.
///
/// @param sigmas  standard deviations of the parameters, in the order of toVector(); for people
std::string toYaml(const Calibration& calibration, const ParameterVector& sigmas);

}  // namespace sightline::triangulation
