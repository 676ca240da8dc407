#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "sightline/scan/scan.h"

namespace sightline::lines {

/// Number of beams past the end of an array that may be read.
constexpr std::size_t kPadding = 8;

/// The valid returns of a scan in the order of the sweep, one array a quantity, in the frame of the
/// scan at its stamp: what the motion of the sensor did to them has been taken out.
struct BeamArray {
  std::vector<float> x, y;                      ///< where the beam ended [m]
  std::vector<float> direction_x, direction_y;  ///< unit vector along the beam
  std::vector<float> range_variance;            ///< along the beam [m²]
  std::vector<float> across_variance;           ///< across the beam [m²]
  /// Index in the scan; past the seam of a full circle it counts on from the number of beams.
  std::vector<std::uint32_t> beam;
  /// Covariance of the errors along the beam and across it, to the left [m²]; read only where
  /// `has_jitter`.
  std::vector<float> cross_covariance;
  bool has_jitter = false;
  bool has_across = false;     ///< whether anything errs across the beams
  std::size_t revolution = 0;  ///< returns of one revolution
  std::size_t size = 0;        ///< `revolution`, or twice that on a full circle

  /// Variances along the beams of where they meet the surface about them, with the error across the
  /// beams in them, which a slanting surface turns into one along them [m²].
  const float* slantVariances() const {
    return has_across ? slant_variance_.data() : range_variance.data();
  }

  Eigen::Vector2d direction(std::size_t i) const {
    return {static_cast<double>(direction_x[i]), static_cast<double>(direction_y[i])};
  }

  /// Takes a scan in. On a full circle the revolution starts at `first_beam` and every return
  /// stands here twice, one revolution apart, so that nothing is cut at the seam. The arrays are
  /// longer than `size` by kPadding beams that lie on no line.
  ///
  /// The jitter of the motion's noise turns each beam about the axis by an error δ of its own,
  /// which moves its end point p by δ perp(p − axis): the variances hold it. Drift and walk are not
  /// in them, as they are common to the beams (SweepNoise).
  void assign(const scan::Scan& scan, std::size_t first_beam = 0);

 private:
  void reserve(std::size_t returns);
  void takeDirections(const std::shared_ptr<const scan::ScanGeometry>& geometry);
  void appendValid(const scan::Scan& scan, std::size_t first, std::size_t end, std::size_t shift);
  void appendRun(const scan::Scan& scan, std::size_t first, std::size_t end, std::size_t shift);
  void addJitter(const scan::Scan& scan, std::size_t first, std::size_t end);
  void place(const scan::Scan& scan, std::size_t first, std::size_t end);
  void placeMoved(const scan::Scan& scan, std::size_t first, std::size_t end);
  void repeatRevolution(std::size_t beams);
  void addSlant();
  float slantAt(std::size_t i, std::size_t k) const;
  void pad();

  std::shared_ptr<const scan::ScanGeometry> geometry_;
  std::vector<float> slant_variance_;
  std::vector<float> cosines_, sines_;  // of its beams
};

}  // namespace sightline::lines
