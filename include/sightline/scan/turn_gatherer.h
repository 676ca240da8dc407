#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sightline/scan/scan.h"

namespace sightline::scan {

/// Gathers the partial sweeps of a scanner that sends its turn in several messages to one scan.
///
/// A scanner is known to be one by a sweep that begins where the one before it ended; the sweeps of
/// others pass as they are, and so does the very first one.
class TurnGatherer {
 public:
  /// Takes the next sweep of one scanner. Returns a sweep that passes, or the turn as soon as it is
  /// whole or the next part would begin another one; nothing while it is going on. A gathered scan
  /// has stamp and frame of its first part and the noise that scan::Scan starts from, its beams
  /// have their own times, and intensities are left out.
  std::optional<Scan> add(const Scan& sweep);

 private:
  bool follows(const Scan& sweep) const;
  std::optional<Scan> gather(const Scan& sweep);
  double angleOnFrom(double last, double angle) const;
  bool isFarther(double angle) const;
  void append(const Scan& sweep);
  std::optional<Scan> finish();

  std::shared_ptr<const ScanGeometry> before_;  // of the last sweep
  bool gathers_ = false;
  // The turn so far; its angles go on beyond ±π.
  std::optional<Scan> first_;
  std::vector<double> angles_;
  std::vector<double> offsets_;
  std::vector<double> ranges_;
};

}  // namespace sightline::scan
