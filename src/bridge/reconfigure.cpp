#include "sightline/bridge/reconfigure.h"

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

std::string settingName(const std::vector<std::string>& path, const char* name) {
  return path.empty() ? name : fmt::format("{}_{}", fmt::join(path, "_"), name);
}

template <class Parameters>
auto* find(Parameters& parameters, const std::string& name) {
  for (auto& parameter : parameters) {
    if (parameter.name == name) return &parameter;
  }
  return static_cast<decltype(parameters.data())>(nullptr);
}

// The parameters of a message that a field of some kind may be one of.
template <class Message>
auto& parametersOf(Message& message, double) {
  return message.doubles;
}
template <class Message>
auto& parametersOf(Message& message, int) {
  return message.ints;
}
template <class Message>
auto& parametersOf(Message& message, bool) {
  return message.bools;
}

struct ToMessage {
  dynamic_reconfigure::Config& message;
  const std::string name;

  template <class T>
  void operator()(const T& value) const {
    if constexpr (std::is_arithmetic_v<T>) {
      if (auto* parameter = find(parametersOf(message, value), name)) parameter->value = value;
    }
  }
};

struct FromMessage {
  const dynamic_reconfigure::Config& message;
  const std::string name;

  template <class T>
  void operator()(T* value) const {
    if constexpr (std::is_arithmetic_v<T>) {
      if (const auto* parameter = find(parametersOf(message, *value), name)) {
        *value = static_cast<T>(parameter->value);
      }
    }
  }
  template <class T>
  void operator()(const T&) const {}
};

}  // namespace

void ReconfigureWriter::value(const char* name, const config::Value& value, const config::Field&) {
  std::visit(ToMessage{message_, settingName(path_, name)}, value);
}

void ReconfigureReader::member(const char* name, const config::Member& member,
                               const config::Field&) {
  std::visit(FromMessage{message_, settingName(path_, name)}, member);
}

}  // namespace sightline::bridge
