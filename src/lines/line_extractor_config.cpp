#include "sightline/lines/line_extractor_config.h"

namespace sightline::lines {

void LineExtractorConfig::visit(config::FieldVisitor& visitor) {
  visitor.number("gate", gate,
                 {"sigma",
                  {1.0, 10.0},
                  "validation gate g (pears eq. 33); the tests of lines use the same odds"});
  visitor.number("misfit", misfit,
                 {"1",
                  {1.0, 10.0},
                  "a line whose residuals are this many times what the noise allows is no wall"});
  visitor.number("max_gap", max_gap,
                 {"m", {0.0, 100.0}, "a wall may be interrupted this far and stays one segment"});
  visitor.integer("max_gap_beams", max_gap_beams,
                  {"beams",
                   {0.0, 1000.0},
                   "this many beams in a row without a return do not interrupt a wall, however far "
                   "they are apart"});
  visitor.number("min_length", min_length, {"m", {0.0, 100.0}, "shorter segments are left out"});
  visitor.integer("min_beams", min_beams,
                  {"beams", {3.0, 1e6}, "segments of fewer beams are left out"});
  visitor.number(
      "max_radius", max_radius,
      {"m", {0.0, 100.0}, "of an arc; a wall that bends less counts as straight; 0: no arcs"});
  visitor.integer("min_arc_beams", min_arc_beams,
                  {"beams", {4.0, 1e6}, "arcs of fewer beams are left out"});
  visitor.integer("start_beams", start_beams,
                  {"beams", {2.0, 1000.0}, "of a batch start of method plain (pears section 4.6)"});
}

}  // namespace sightline::lines
