#include "sightline/config/node.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include "sightline/config/text_file.h"

namespace sightline::config {

Node::Node(YAML::Node yaml, std::string source, std::string key)
    : yaml_(std::move(yaml)), source_(std::move(source)), key_(std::move(key)) {}

namespace {

// Notes where the second document of a text begins. YAML::Load looks at the first one alone.
class DocumentStarts : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { line_ = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  int line() const { return line_; }

 private:
  int line_ = 0;
};

void refuseSecondDocument(const std::string& text, const std::string& source) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStarts starts;
  // No further than to the second: yaml-cpp finds documents without end in some broken texts.
  if (parser.HandleNextDocument(starts) && parser.HandleNextDocument(starts)) {
    throw Error(source, starts.line(), "", "a second document; expected one");
  }
}

}  // namespace

std::string Range::text() const {
  const Range everything;
  if (min == everything.min && max == everything.max) return "any";
  if (max < kPositive.max) return fmt::format("[{}, {}]", min, max);
  return min == kPositive.min ? "> 0" : fmt::format(">= {}", min);
}

Node& Node::operator=(const Node& other) {
  yaml_.reset(other.yaml_);
  source_ = other.source_;
  key_ = other.key_;
  return *this;
}

Node Node::readFile(const std::string& path) {
  return parse(readText(path), path);
}

Node Node::parse(const std::string& text, const std::string& source) {
  try {
    refuseSecondDocument(text, source);
    return Node(YAML::Load(text), source);
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 0 : error.mark.line + 1;
    throw Error(source, line, "", "not YAML: " + error.msg);
  }
}

bool Node::isMap() const {
  return yaml_.IsMap();
}

bool Node::isNull() const {
  return yaml_.IsNull();
}

Node Node::child(const std::string& key, const YAML::Node& value) const {
  return {value, source_, key_.empty() ? key : key_ + "." + key};
}

bool Node::has(const std::string& key) const {
  return yaml_.IsMap() && yaml_[key].IsDefined();
}

Node Node::at(const std::string& key) const {
  if (!yaml_.IsMap()) fail(fmt::format("expected a map with the key '{}'", key));
  std::optional<Node> found;
  for (const auto& entry : yaml_) {
    if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
    if (found) child(key, entry.second).fail("given twice");
    found = child(key, entry.second);
  }
  if (!found) fail(fmt::format("missing key '{}'", key));
  return *found;
}

std::vector<std::pair<std::string, Node>> Node::entries() const {
  if (!yaml_.IsMap()) fail("expected a map");
  std::vector<std::pair<std::string, Node>> entries;
  std::set<std::string> keys;
  for (const auto& entry : yaml_) {
    const auto key = Node(entry.first, source_, key_).text();
    entries.emplace_back(key, child(key, entry.second));
    if (!keys.insert(key).second) entries.back().second.fail("given twice");
  }
  return entries;
}

std::vector<Node> Node::items() const {
  if (!yaml_.IsSequence()) fail("expected a sequence");
  std::vector<Node> items;
  for (std::size_t i = 0; i < yaml_.size(); ++i) {
    items.emplace_back(yaml_[i], source_, fmt::format("{}[{}]", key_, i));
  }
  return items;
}

void Node::allowOnly(std::initializer_list<const char*> keys) const {
  for (const auto& [key, value] : entries()) {
    const bool known = std::any_of(keys.begin(), keys.end(),
                                   [&name = key](const char* allowed) { return name == allowed; });
    if (!known) value.fail(fmt::format("unknown key; known are: {}", fmt::join(keys, ", ")));
  }
}

template <class T>
T Node::as(const char* expected) const {
  if (!yaml_.IsScalar()) fail(fmt::format("expected {}", expected));
  try {
    return yaml_.as<T>();
  } catch (const YAML::BadConversion&) {
    fail(fmt::format("expected {}, found '{}'", expected, yaml_.Scalar()));
  }
}

double Node::number(Range range) const {
  const auto value = as<double>("a number");
  if (std::isnan(value)) fail("expected a number, found NaN");
  if (!range.contains(value)) fail(fmt::format("{} is outside {}", value, range.text()));
  return value;
}

int Node::integer(Range range) const {
  const auto value = as<int>("a whole number");
  if (!range.contains(value)) fail(fmt::format("{} is outside {}", value, range.text()));
  return value;
}

bool Node::flag() const {
  return as<bool>("true or false");
}

std::string Node::text() const {
  return as<std::string>("a text");
}

std::vector<double> Node::numbers(Range range) const {
  std::vector<double> values;
  for (const Node& item : items()) {
    values.push_back(item.number(range));
    if (!std::isfinite(values.back())) item.fail("has to be finite");
  }
  return values;
}

std::vector<double> Node::numbers(std::size_t count, Range range) const {
  auto values = numbers(range);
  if (values.size() != count) {
    fail(fmt::format("expected {} numbers, found {}", count, values.size()));
  }
  return values;
}

double Node::numberOr(const std::string& key, double fallback, Range range) const {
  return has(key) ? at(key).number(range) : fallback;
}

std::string Node::textOr(const std::string& key, const std::string& fallback) const {
  return has(key) ? at(key).text() : fallback;
}

void Node::fail(const std::string& reason) const {
  // Nodes that do not come from a text carry a null mark.
  const YAML::Mark mark = yaml_.IsDefined() ? yaml_.Mark() : YAML::Mark::null_mark();
  throw Error(source_, mark.is_null() ? 0 : mark.line + 1, key_, reason);
}

std::string Node::path() const {
  const std::filesystem::path written = text();
  if (written.is_absolute()) return written.string();
  return (std::filesystem::path(source_).parent_path() / written).lexically_normal().string();
}

}  // namespace sightline::config
