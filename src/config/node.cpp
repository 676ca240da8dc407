#include "sightline/config/node.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

std::string withHome(const std::string& path) {
  const char* const home = std::getenv("HOME");
  const bool below_home = path == "~" || path.rfind("~/", 0) == 0;
  return home && below_home ? home + path.substr(1) : path;
}

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

Node& Node::operator=(const Node& other) {
  yaml_.reset(other.yaml_);
  source_ = other.source_;
  key_ = other.key_;
  folder_ = other.folder_;
  line_ = other.line_;
  return *this;
}

Node Node::readFile(const std::string& path) {
  return parse(readText(path), path);
}

Node Node::parse(const std::string& text, const std::string& source) {
  try {
    refuseSecondDocument(text, source);
    Node node(YAML::Load(text), source);
    node.folder_ = std::filesystem::path(source).parent_path().string();
    return node;
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

bool Node::isList() const {
  return yaml_.IsSequence() || (yaml_.IsScalar() && yaml_.Scalar().rfind('[', 0) == 0);
}

bool Node::isEmpty() const {
  if (isNull() || (yaml_.IsScalar() && yaml_.Scalar().empty())) return true;
  return isList() && items().empty();
}

Node Node::place(const std::string& key, const YAML::Node& value) const {
  Node node = *this;
  node.yaml_.reset(value);
  node.key_ = key;
  return node;
}

Node Node::child(const std::string& key, const YAML::Node& value) const {
  return place(key_.empty() ? key : key_ + "." + key, value);
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
    const auto key = place(key_, entry.first).text();
    entries.emplace_back(key, child(key, entry.second));
    if (!keys.insert(key).second) entries.back().second.fail("given twice");
  }
  return entries;
}

Node Node::sequence() const {
  if (yaml_.IsSequence()) return *this;
  if (!isList()) fail("expected a sequence");
  Node node = *this;
  node.line_ = line();
  try {
    node.yaml_.reset(YAML::Load(yaml_.Scalar()));
  } catch (const YAML::Exception&) {
    fail(fmt::format("expected a sequence, found '{}'", yaml_.Scalar()));
  }
  if (!node.yaml_.IsSequence()) fail("expected a sequence");
  return node;
}

std::vector<Node> Node::items() const {
  const Node list = sequence();
  std::vector<Node> items;
  for (std::size_t i = 0; i < list.yaml_.size(); ++i) {
    items.push_back(list.place(fmt::format("{}[{}]", key_, i), list.yaml_[i]));
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
  if (yaml_.IsScalar() && (yaml_.Scalar() == "1" || yaml_.Scalar() == "0")) {
    return yaml_.Scalar() == "1";
  }
  return as<bool>("true or false");
}

std::string Node::text() const {
  return as<std::string>("a text");
}

std::size_t Node::choice(const std::vector<const char*>& words) const {
  const std::string chosen = text();
  const auto found = std::find(words.begin(), words.end(), chosen);
  if (found == words.end()) {
    fail(fmt::format("'{}' is none of: {}", chosen, fmt::join(words, ", ")));
  }
  return static_cast<std::size_t>(found - words.begin());
}

std::vector<std::string> Node::texts() const {
  std::vector<std::string> texts;
  if (yaml_.IsScalar() && !isList()) {
    std::string words = text();
    std::replace(words.begin(), words.end(), ',', ' ');
    std::istringstream stream(words);
    for (std::string word; stream >> word;) texts.push_back(word);
    return texts;
  }
  for (const Node& item : items()) texts.push_back(item.text());
  return texts;
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

geometry::Pose2 Node::pose(Range range) const {
  if (!isList() || items().size() != 3) fail("expected a pose: [x, y, yaw] in m, m, rad");
  const auto values = numbers(range);
  constexpr double kTurn = 6.2832;  // [rad]
  if (std::abs(values[2]) > kTurn) {
    fail(fmt::format("a yaw of {} rad is more than a whole turn: is it in degrees?", values[2]));
  }
  return {values[0], values[1], values[2]};
}

double Node::numberOr(const std::string& key, double fallback, Range range) const {
  return has(key) ? at(key).number(range) : fallback;
}

std::string Node::textOr(const std::string& key, const std::string& fallback) const {
  return has(key) ? at(key).text() : fallback;
}

int Node::line() const {
  if (line_ > 0) return line_;
  // Nodes that do not come from a text carry a null mark.
  const YAML::Mark mark = yaml_.IsDefined() ? yaml_.Mark() : YAML::Mark::null_mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

void Node::fail(const std::string& reason) const {
  throw Error(source_, line(), key_, reason);
}

std::string Node::path() const {
  const std::string written = text();
  if (written.empty()) return written;
  const std::filesystem::path path = withHome(written);
  if (path.is_absolute()) return path.string();
  return (std::filesystem::path(folder_) / path).lexically_normal().string();
}

}  // namespace sightline::config
