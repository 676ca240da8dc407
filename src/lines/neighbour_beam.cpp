#include "sightline/lines/neighbour_beam.h"

namespace sightline::lines {

std::size_t nextTellingBeam(const scan::Scan& scan, std::size_t beam, int sense) {
  const std::size_t count = scan.beams();
  const bool circle = scan.geometry()->isFullCircle();
  const std::size_t last = sense > 0 ? count - 1 : 0;
  std::size_t i = beam;
  for (std::size_t step = 1; step < count; ++step) {
    if (!circle && i == last) return beam;
    i = (sense > 0 ? i + 1 : i + count - 1) % count;
    if (scan.kinds()[i] != scan::ReturnKind::kInvalid) return i;
  }
  return beam;
}

}  // namespace sightline::lines
