#pragma once

#include <string>

namespace sightline::world {

/// Light that comes back the way it came, the more the straighter the ray meets the surface: the
/// gloss of glass and bare metal, or the return of a reflective tape, which holds up to the
/// incidence at which it fails.
struct Lobe {
  double gain = 0.0;        ///< at right angles, of a white surface's light; 0: no lobe
  double half_width = 0.1;  ///< incidence at which half of it comes back [rad]
  double steepness = 2.0;   ///< of the fall: 2 as a Gaussian, more: flat first, then an edge
};

/// Response of a surface to light.
struct Material {
  std::string name = "plaster";
  /// Share of the light that comes back diffusely, above 0; retro-reflectors exceed 1.
  double reflectivity = 0.7;
  Lobe lobe = {};

  /// Light that comes back to where it came from, of that from a white surface at right angles: the
  /// diffuse part by Lambert's law, and the lobe. `cos_incidence` in [0, 1].
  double returned(double cos_incidence) const;
};

}  // namespace sightline::world
