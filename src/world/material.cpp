#include "sightline/world/material.h"

#include <algorithm>
#include <cmath>

namespace sightline::world {

double Material::returned(double cos_incidence) const {
  const double diffuse = reflectivity * cos_incidence;
  if (lobe.gain == 0.0) return diffuse;
  const double incidence = std::acos(std::min(1.0, cos_incidence));
  return diffuse + lobe.gain * std::exp2(-std::pow(incidence / lobe.half_width, lobe.steepness));
}

}  // namespace sightline::world
