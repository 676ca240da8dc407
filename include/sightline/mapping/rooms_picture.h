#pragma once

#include <string>
#include <vector>

#include "sightline/mapping/room_fitter.h"

namespace sightline::mapping {

/// Draws rooms over what the scans met, as a PNG: walls where they are wall in blue, elsewhere
/// thin; sides that are uncertain or were not seen in orange, doors in green, crossings without a
/// door in red, the path in grey. Throws config::Error where the file cannot be written.
void drawPicture(const Survey& survey, const FittedRooms& fitted, const std::string& path);

}  // namespace sightline::mapping
