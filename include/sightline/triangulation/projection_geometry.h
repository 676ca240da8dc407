#pragma once

#include <Eigen/Core>

#include "sightline/triangulation/intrinsics.h"

namespace sightline::triangulation {

/// Path of the light from a scene point to its image and back (pears eqs 3-10).
///
/// Everything here is in the projection frame: origin in the laser's centre of scan, x straight
/// ahead, y to the left, so that the lens is at negative y. A projection angle θ is that of the
/// laser beam, from straight ahead, counter-clockwise; pears counts it the other way round. In
/// polar form, with t = −θ and the range r along the beam, eqs 3 to 10 are
///
///     p = f (d cos(t−γ) − r sin γ) / (r cos γ − d sin(t−γ) + s)
///     r = (f d cos(t−γ) + p (d sin(t−γ) − s)) / (f sin γ + p cos γ)
///
/// Near points have positive image positions, far points negative ones. The image is taken to be
/// sharp at the focal length, whatever the range.
class ProjectionGeometry {
 public:
  /// Throws config::Error where an intrinsic is outside its range.
  explicit ProjectionGeometry(const Intrinsics& intrinsics);

  /// p [m] of the point at `range` [m] > 0 along the beam.
  double imagePosition(double range, double angle) const;
  /// [m] along the beam; infinite or negative for an image that no point ahead can have.
  double range(double image_position, double angle) const;
  /// Eqs 6-9: range · (cos θ, sin θ).
  Eigen::Vector2d point(double image_position, double angle) const;
  /// Along straight ahead [m]: z of pears.
  double depth(double image_position, double angle) const;

  /// The lens while the beam points to `angle`.
  struct Lens {
    Eigen::Vector2d centre;  ///< [m], on an arc about q
    Eigen::Vector2d axis;    ///< unit vector of the optical axis, outwards
  };
  Lens lens(double angle) const;
  /// p [m] of any point in front of the lens, of a ray beside the beam's axis, say.
  double imagePosition(const Eigen::Vector2d& point, const Lens& lens) const;

  /// ∂r/∂p: triangulation gain along the beam, negative for the image of any point ahead.
  double rangeGain(double image_position, double angle) const;
  /// ∂z/∂p: triangulation gain of pears section 2.1.
  double depthGain(double image_position, double angle) const;
  /// ∂p/∂(r, θ).
  Eigen::RowVector2d imagePositionJacobian(double range, double angle) const;
  /// ∂p/∂(f, d, γ, s) with range and angle held.
  Eigen::RowVector4d intrinsicsJacobian(double range, double angle) const;
  /// ∂(x, y)/∂(p, θ) of point().
  Eigen::Matrix2d pointJacobian(double image_position, double angle) const;

  const Intrinsics& intrinsics() const { return intrinsics_; }

 private:
  // The point seen from q: across the optical axis and along it.
  struct FromLens {
    double across;  // [m], to the left
    double along;   // [m], from the lens
  };
  FromLens fromLens(double range, double angle) const;

  Intrinsics intrinsics_;
};

}  // namespace sightline::triangulation
