#include "sightline/bridge/parameter_writer.h"

namespace sightline::bridge {

void ParameterWriter::value(const char* name, const config::Value& value, const config::Field&) {
  std::visit([&](const auto& held) { node_.setParam(path_ + name, held); }, value);
}

}  // namespace sightline::bridge
