#pragma once

#include <Eigen/Core>

namespace sightline::lines {

/// What is known of a wall that is not quite straight: how far its surface strays from a line grows
/// with the root of the length, as that of a random walk does. Tolerances of buildings grow alike
/// (DIN 18202: 5 to 10 mm below a straight edge of 1 m, twice that over 4 m).
class WallShape {
 public:
  /// What walls as they are built stray after one metre: with it a line through a metre of wall
  /// leaves 2 mm, and the largest gap below a straight edge is some 8 mm [m/√m].
  static constexpr double kUsual = 0.008;

  /// @param unevenness  standard deviation of the surface's offset after one metre [m/√m]
  explicit WallShape(double unevenness = kUsual) : diffusion_(unevenness * unevenness) {}

  /// What a surface strays, as a variance, over a length [m²].
  double variance(double length) const { return diffusion_ * length; }

  /// Variances of the difference that the shape alone makes between lines fitted to two parts of
  /// one wall, evenly seen: of their offset at the place midway between the parts [m²], and of
  /// their directions [rad²]. The two are independent where the parts are equally long or adjoin;
  /// elsewhere they are nearly so, and taken for it.
  ///
  /// @param before, after  lengths of the parts [m], above 0
  /// @param gap            between them, of which nothing is seen [m]
  Eigen::Vector2d difference(double before, double after, double gap) const;

 private:
  double diffusion_;  // [m]
};

}  // namespace sightline::lines
