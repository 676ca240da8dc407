#include "sightline/simulation/body.h"

namespace sightline::simulation {

void Body::visit(config::FieldVisitor& visitor) {
  visitor.number("radius", radius, {"m", {0.0, 100.0}, "of an upright cylinder; 0: none"});
  visitor.number("width", width,
                 {"m", {0.0, 100.0}, "of an upright plane piece across the heading; 0: none"});
  visitor.number("bottom", bottom, {"m", {0.0, 100.0}, "above the floor"});
  visitor.number("top", top, {"m", {0.0, 100.0}, "above the floor"});
  visitor.number("reflectivity", reflectivity,
                 {"1", {1e-6, 1e3}, "share of the light that comes back diffusely"});
}

void Body::check(const std::string& source) const {
  config::validate(*this, source);
  if (bottom >= top) throw config::Error(source, 0, "bottom", "is not below top");
}

}  // namespace sightline::simulation
