#pragma once

#include "sightline/driver/messages.h"
#include "sightline/triangulation/ranger.h"

namespace sightline::driver {

/// Currents and head angles of a scan as it came over the line, into vectors that are used again. A
/// count at its end is no current (NaN). The stamp is left alone.
void toRawScan(const ScanReport& report, triangulation::RawScan& raw);

/// Samples whose counts were at an end.
std::size_t saturatedSamples(const triangulation::RawScan& raw);

/// The other way: what does not fit is cut off at the ends of what can be counted, and the status
/// says so. Number, boot and times are left alone.
void fillReport(const triangulation::RawScan& raw, ScanReport& report);

}  // namespace sightline::driver
