#pragma once

#include <string>
#include <vector>

#include "sightline/mapping/room_fitter.h"

namespace sightline::mapping {

/// Why no rooms can come of a recording: it holds no scan or one, the scanner did not move, or it
/// falls into parts that nothing joins, as when it shows two buildings. Empty where they can.
std::string faultOf(const Survey& survey, const AdjustedPath& path);

/// First key scans of the parts of a path that no relation joins, in order; one where it is whole.
/// Parts of a few key scans belong to the part before them.
std::vector<std::size_t> partsOf(std::size_t keys, const std::vector<Relation>& relations);

}  // namespace sightline::mapping
