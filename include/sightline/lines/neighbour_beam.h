#pragma once

#include <cstddef>

#include "sightline/scan/scan.h"

namespace sightline::lines {

/// The first beam past `beam`, in the sense of the sweep (1) or against it (-1), that says
/// something of what is there; `beam` itself where none does. Goes round on a full circle.
std::size_t nextTellingBeam(const scan::Scan& scan, std::size_t beam, int sense);

}  // namespace sightline::lines
