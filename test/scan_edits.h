#pragma once

#include "sightline/scan/scan.h"

namespace sightline::test {

/// Makes every beam of a scan one of this kind.
inline void setKinds(scan::Scan& scan, scan::ReturnKind kind) {
  for (std::size_t i = 0; i < scan.beams(); ++i) scan.setKind(i, kind);
}

}  // namespace sightline::test
