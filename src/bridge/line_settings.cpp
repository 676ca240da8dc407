#include "sightline/bridge/line_settings.h"

namespace sightline::bridge {

sightline::LineExtractorConfig toReconfigure(const lines::LineExtractorConfig& config) {
  auto result = sightline::LineExtractorConfig::__getDefault__();
  result.gate = config.gate;
  result.misfit = config.misfit;
  result.start_phi_sigma = config.start_phi_sigma;
  result.max_gap = config.max_gap;
  result.max_gap_beams = config.max_gap_beams;
  result.min_length = config.min_length;
  result.min_beams = config.min_beams;
  result.max_radius = config.max_radius;
  result.min_arc_beams = config.min_arc_beams;
  return result;
}

lines::LineExtractorConfig fromReconfigure(const sightline::LineExtractorConfig& config) {
  lines::LineExtractorConfig result;
  result.gate = config.gate;
  result.misfit = config.misfit;
  result.start_phi_sigma = config.start_phi_sigma;
  result.max_gap = config.max_gap;
  result.max_gap_beams = config.max_gap_beams;
  result.min_length = config.min_length;
  result.min_beams = config.min_beams;
  result.max_radius = config.max_radius;
  result.min_arc_beams = config.min_arc_beams;
  return result;
}

}  // namespace sightline::bridge
