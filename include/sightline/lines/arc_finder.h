#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sightline/fitting/arc_fit.h"
#include "sightline/geometry/arc.h"
#include "sightline/lines/arc_runs.h"
#include "sightline/lines/beam_array.h"
#include "sightline/lines/line_extractor_config.h"
#include "sightline/lines/piece.h"
#include "sightline/motion/motion_sum.h"
#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Pillars, legs and curved walls.
///
/// Every run of returns that may be round is fitted with a circle. The circle stands where it is
/// the likelier explanation: where it costs less than a line does, each parameter counted as by
/// Schwarz (1978), and less than several lines at the prices of Segmentation. Where the run ends
/// because the beams pass by, the rays that graze the circle are observations of it, too.
class ArcFinder {
 public:
  explicit ArcFinder(const LineExtractorConfig& config);

  /// Appends the arcs in the order of the sweep; the pieces that are chords of one are taken out.
  void find(const scan::Scan& scan, const BeamArray& beams, std::vector<Piece>& pieces,
            std::vector<geometry::Arc>& arcs);

 private:
  enum class Side { kStart, kEnd };
  bool consider(const scan::Scan& scan, const BeamArray& beams, const Run& run,
                std::vector<Piece>& pieces, std::vector<geometry::Arc>& arcs);
  bool mayBeRound(const scan::Scan& scan, const BeamArray& beams, const Run& run);
  void observe(const scan::Scan& scan, const BeamArray& beams, const Run& run, std::size_t stride);
  void observeTangent(const scan::Scan& scan, std::size_t beam, Side side);
  Eigen::Matrix3d motionCovariance(const scan::Scan& scan, const BeamArray& beams, const Run& run,
                                   const fitting::ArcFit& fit);
  bool isExplained(const fitting::ArcFit& fit) const;
  bool isPlausible(const fitting::ArcFit& fit) const;
  bool isBetterDivided(const fitting::ArcFit& fit, const BeamArray& beams, const Run& run,
                       const std::vector<Piece>& pieces) const;
  bool isLikelier(const fitting::ArcFit& fit, const BeamArray& beams, const Run& run,
                  const std::vector<Piece>& pieces) const;

  LineExtractorConfig config_;
  double gate_squared_;
  ArcRuns runs_;
  fitting::ArcObservations observations_;
  std::vector<std::size_t> tangent_beams_;  // of the scan
  motion::MotionSum<3> motion_sum_;
};

}  // namespace sightline::lines
