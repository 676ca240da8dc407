#include "sightline/world/material.h"

#include <cmath>

#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/geometry/angle.h"
#include "sightline/world/world.h"

namespace sightline::world {
namespace {

const char* const kMaterials = SIGHTLINE_SOURCE_DIR "/config/worlds/materials.yaml";

Material shipped(const std::string& name) {
  const World world = World::readFile(kMaterials);
  return world.materials()[*world.findMaterial(name)];
}

// Incidence [degrees] up to which a material returns more than the threshold of dames section 2, by
// a scanner that reports 5000 for white.
double edgeOf(const Material& material) {
  constexpr double kThreshold = 11000.0 / 5000.0;
  double incidence = 0.0;
  while (incidence < 90.0 && material.returned(std::cos(geometry::radians(incidence))) > kThreshold)
    incidence += 0.001;
  return incidence;
}

TEST(Material, IsLambertsWithoutALobe) {
  const Material paint{"paint", 0.6};
  EXPECT_EQ(paint.returned(1.0), 0.6);
  EXPECT_NEAR(paint.returned(0.5), 0.3, 1e-12);
}

TEST(Material, LosesHalfOfItsLobeAtTheHalfWidth) {
  const Material steel{"steel", 0.5, {4.0, 0.1, 3.0}};
  EXPECT_NEAR(steel.returned(1.0), 4.5, 1e-12);
  EXPECT_NEAR(steel.returned(std::cos(0.1)), 0.5 * std::cos(0.1) + 2.0, 1e-9);
}

// Dames section 2: only tape, bare metal and glass reach the threshold, up to about these angles.
TEST(Material, ShippedOnesAreThoseOfThePaper) {
  for (const char* dull : {"linoleum", "wood", "drywall", "door", "painted_metal", "plastic"}) {
    EXPECT_EQ(edgeOf(shipped(dull)), 0.0) << dull;
  }
  EXPECT_NEAR(edgeOf(shipped("tape")), 52.0, 1.5);
  EXPECT_NEAR(edgeOf(shipped("bare_metal")), 2.5, 0.1);
  EXPECT_NEAR(edgeOf(shipped("glass")), 0.02, 0.005);
}

TEST(Material, RefusesALobeThatIsNone) {
  const auto read = [](const std::string& lobe) {
    return test::errorOf([&] {
      World(config::Node::parse("materials: {m: {reflectivity: 0.4, lobe: " + lobe + "}}", "w"));
    });
  };
  EXPECT_EQ(read("{gain: -1, half_width: 0.1}").key(), "materials.m.lobe.gain");
  EXPECT_EQ(read("{gain: 1, half_width: 0}").key(), "materials.m.lobe.half_width");
  EXPECT_EQ(read("{gain: 1}").key(), "materials.m.lobe");
  EXPECT_EQ(read("{gain: 1, half_width: 0.1, colour: 3}").key(), "materials.m.lobe.colour");
}

}  // namespace
}  // namespace sightline::world
