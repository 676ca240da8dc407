#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sightline/pipeline/bearing_topics.h"
#include "sightline/targets/characterization.h"

namespace sightline::bridge {

/// Looks of recordings, each with its pose and turn rate and where the other robots were.
struct RecordedLooks {
  std::vector<targets::KnownLook> looks;
  std::size_t without_pose = 0;
  targets::FieldOfView field_of_view;  ///< of all sensors together
  double range_max = 0.0;              ///< the largest that a sensor states [m]
};

/// `progress` is called with the ratio that has been read. Throws config::Error.
RecordedLooks readKnownLooks(const std::vector<std::string>& paths,
                             const pipeline::BearingTopics& team,
                             const std::function<void(double)>& progress);

/// Pictures after figures 5b, 6, 7b and 8 of dames in a folder. Throws plot::Error.
void drawCharacterization(const targets::Characterization& found,
                          const targets::CharacterizationConfig& config, const std::string& folder);

}  // namespace sightline::bridge
