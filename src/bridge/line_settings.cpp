#include "sightline/bridge/line_settings.h"

#include "sightline/bridge/reconfigure.h"

namespace sightline::bridge {

sightline::LineExtractorConfig toReconfigure(const lines::LineExtractorConfig& config) {
  return settingsOf<sightline::LineExtractorConfig>(config);
}

void applyReconfigure(const sightline::LineExtractorConfig& settings,
                      lines::LineExtractorConfig& config) {
  applySettings(settings, config);
}

}  // namespace sightline::bridge
