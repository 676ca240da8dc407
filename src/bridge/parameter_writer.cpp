#include "sightline/bridge/parameter_writer.h"

namespace sightline::bridge {

void ParameterWriter::number(const char* name, double& value, const config::Field&) {
  node_.setParam(path_ + name, value);
}

void ParameterWriter::integer(const char* name, int& value, const config::Field&) {
  node_.setParam(path_ + name, value);
}

void ParameterWriter::flag(const char* name, bool& value, const char*) {
  node_.setParam(path_ + name, value);
}

void ParameterWriter::text(const char* name, std::string& value, const char*) {
  node_.setParam(path_ + name, value);
}

void ParameterWriter::numbers(const char* name, std::vector<double>& values, const config::Field&) {
  node_.setParam(path_ + name, values);
}

void ParameterWriter::option(const char* name, std::size_t& index,
                             const std::vector<const char*>& options, const char*) {
  node_.setParam(path_ + name, std::string(options[index]));
}

}  // namespace sightline::bridge
