#pragma once

#include "sightline/LineExtractorConfig.h"
#include "sightline/lines/line_extractor_config.h"

/// The settings of the line extractor as dynamic_reconfigure knows them (cfg/LineExtractor.cfg).
namespace sightline::bridge {

sightline::LineExtractorConfig toReconfigure(const lines::LineExtractorConfig& config);
/// The settings put into a configuration; what cfg/ does not hold stays.
void applyReconfigure(const sightline::LineExtractorConfig& settings,
                      lines::LineExtractorConfig& config);

}  // namespace sightline::bridge
