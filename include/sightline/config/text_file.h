#pragma once

#include <string>

namespace sightline::config {

/// Everything in a file. Throws Error naming the path where there is none, or a folder.
std::string readText(const std::string& path);

}  // namespace sightline::config
