#include "sightline/world/room_map_file.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

namespace sightline::world {

namespace {

using config::Node;

Eigen::Vector2d pointOf(const Node& node) {
  const auto xy = node.numbers(2, kBuildingCoordinates);
  return {xy[0], xy[1]};
}

geometry::Pose2 poseOf(const Node& room) {
  if (room.has("turn_deg")) {
    const double turn = room.at("turn_deg").number({-360.0, 360.0});
    const Eigen::Vector2d at = room.has("pose") ? pointOf(room.at("pose")) : Eigen::Vector2d(0, 0);
    return {at, geometry::radians(turn)};
  }
  if (!room.has("pose")) return {};
  const auto p = room.at("pose").numbers(3, kBuildingCoordinates);
  return {p[0], p[1], p[2]};
}

std::vector<Eigen::Vector2d> cornersOf(const Node& polygon) {
  std::vector<Eigen::Vector2d> corners;
  for (const Node& item : polygon.items()) corners.push_back(pointOf(item));
  return corners;
}

// A rectangle's pose and size by two opposite corners in the map.
std::pair<geometry::Pose2, Eigen::Vector2d> betweenCorners(const Node& room) {
  const auto corners = cornersOf(room.at("corners"));
  if (corners.size() != 2) {
    room.at("corners").fail("a rectangle has two opposite corners here; more make a 'polygon'");
  }
  if (room.has("pose")) room.at("pose").fail("'corners' say where it is; its turn is 'turn_deg'");
  const geometry::Pose2 pose(0.5 * (corners[0] + corners[1]), poseOf(room).theta());
  const Eigen::Vector2d size = pose.rotation().transpose() * (corners[1] - corners[0]);
  if (!(size.minCoeff() >= kBuildingLengths.min)) {
    room.at("corners").fail(
        fmt::format("the second lies at [{:.3f}, {:.3f}] from the first along the room's sides: "
                    "both have to be "
                    "above 0",
                    size.x(), size.y()));
  }
  return {pose, size};
}

std::vector<Span> spansOf(const Node& node) {
  std::vector<Span> spans;
  for (const Node& item : node.items()) {
    const auto ends = item.numbers(2);
    spans.push_back({ends[0], ends[1]});
  }
  return spans;
}

std::string wallNames(const Room& room) {
  std::vector<std::string> names;
  for (const Wall& wall : room.walls) names.push_back(wall.name);
  return fmt::format("its walls are: {}", fmt::join(names, ", "));
}

// Reads a document into a map.
class Reader {
 public:
  explicit Reader(RoomMap& map) : map_(map) {}

  void read(const Node& document) {
    document.allowOnly({"rooms", "doors"});
    for (const auto& [name, node] : document.at("rooms").entries()) readRoom(name, node);
    if (map_.rooms().empty()) document.at("rooms").fail("no rooms");
    if (!document.has("doors")) return;
    for (const Node& door : document.at("doors").items()) readDoor(door);
  }

 private:
  void readRoom(const std::string& name, const Node& node) {
    node.allowOnly({"size", "polygon", "corners", "pose", "turn_deg", "walls"});
    const std::size_t room = readOutline(name, node);
    if (!node.has("walls")) return;
    for (const auto& [wall, wall_node] : node.at("walls").entries()) {
      readWall(room, wall, wall_node);
    }
  }

  std::size_t readOutline(const std::string& name, const Node& node) {
    if (node.has("size") + node.has("polygon") + node.has("corners") != 1) {
      node.fail("a room has either the key 'size' or the key 'polygon' or the key 'corners'");
    }
    if (node.has("corners")) {
      const auto [middle, size] = betweenCorners(node);
      return map_.addRectangle(name, size, middle);
    }
    const geometry::Pose2 pose = poseOf(node);
    if (node.has("size")) {
      const auto size = node.at("size").numbers(2, kBuildingLengths);
      return map_.addRectangle(name, {size[0], size[1]}, pose);
    }
    const auto corners = cornersOf(node.at("polygon"));
    try {
      return map_.addPolygon(name, corners, pose);
    } catch (const InvalidRoomMap& fault) {
      node.at("polygon").fail(fault.what());
    }
  }

  void readWall(std::size_t room, const std::string& name, const Node& node) {
    const auto& walls = map_.rooms()[room].walls;
    const auto wall = std::find_if(walls.begin(), walls.end(),
                                   [&](const Wall& candidate) { return candidate.name == name; });
    if (wall == walls.end()) {
      node.fail("no such wall in this room; " + wallNames(map_.rooms()[room]));
    }
    const WallIndex index{room, static_cast<std::size_t>(wall - walls.begin())};
    node.allowOnly({"spans", "open", "sigma"});
    if (node.has("spans") && node.has("open")) node.fail("either 'spans' or 'open', not both");
    if (node.has("spans")) readSpans(index, node.at("spans"));
    if (node.has("open") && node.at("open").flag()) map_.setSpans(index, {});
    if (node.has("sigma")) readSigma(index, node.at("sigma"));
  }

  void readSigma(const WallIndex& wall, const Node& node) {
    const auto sigma = node.numbers(2);
    try {
      map_.setSigma(wall, {sigma[0], sigma[1]});
    } catch (const InvalidRoomMap& fault) {
      node.items().at(std::stoul(fault.key())).fail(fault.what());
    }
  }

  void readSpans(const WallIndex& wall, const Node& node) {
    const auto spans = spansOf(node);
    try {
      map_.setSpans(wall, spans);
    } catch (const InvalidRoomMap& fault) {
      node.items().at(std::stoul(fault.key())).fail(fault.what());
    }
  }

  std::size_t roomNamed(const Node& name) const {
    const auto room = map_.find(name.text());
    if (!room) name.fail(fmt::format("no room is called '{}'", name.text()));
    return *room;
  }

  void readDoor(const Node& node) {
    node.allowOnly({"between", "at", "width", "threshold"});
    const auto names = node.at("between").items();
    if (names.size() != 2) node.at("between").fail("a door joins two rooms");
    const Eigen::Vector2d centre = pointOf(node.at("at"));
    const double width = node.at("width").number(kBuildingLengths);
    const bool threshold = !node.has("threshold") || node.at("threshold").flag();
    const std::size_t rooms[2] = {roomNamed(names[0]), roomNamed(names[1])};
    try {
      map_.addDoor(rooms[0], rooms[1], centre, width, threshold);
    } catch (const InvalidRoomMap& fault) {
      (fault.key().empty() ? node : node.at(fault.key())).fail(fault.what());
    }
  }

  RoomMap& map_;
};

// Writes a map, part by part, into a YAML text.
class Writer {
 public:
  explicit Writer(const RoomMap& map) : map_(map) {}

  std::string text() {
    out_ << YAML::BeginMap << YAML::Key << "rooms" << YAML::Value << YAML::BeginMap;
    for (const Room& room : map_.rooms()) write(room);
    out_ << YAML::EndMap;
    if (!map_.doors().empty()) {
      out_ << YAML::Key << "doors" << YAML::Value << YAML::BeginSeq;
      for (const Door& door : map_.doors()) write(door);
      out_ << YAML::EndSeq;
    }
    out_ << YAML::EndMap;
    return std::string(out_.c_str()) + "\n";
  }

 private:
  void name(const std::string& text) { out_ << YAML::DoubleQuoted << text; }

  // The fewest digits that read back as the same number.
  void number(double value) { out_ << fmt::format("{}", value); }

  void numbers(const std::vector<double>& values) {
    out_ << YAML::Flow << YAML::BeginSeq;
    for (const double value : values) number(value);
    out_ << YAML::EndSeq;
  }

  void write(const Room& room) {
    out_ << YAML::Key;
    name(room.name);
    out_ << YAML::Value << YAML::BeginMap;
    writeOutline(room);
    out_ << YAML::Key << "pose" << YAML::Value;
    numbers({room.T_map_room.x(), room.T_map_room.y(), room.T_map_room.theta()});
    writeWalls(room);
    out_ << YAML::EndMap;
  }

  void writeOutline(const Room& room) {
    if (room.is_rectangle) {
      const Eigen::Vector2d size = 2.0 * room.corners[2];
      out_ << YAML::Key << "size" << YAML::Value;
      numbers({size.x(), size.y()});
      return;
    }
    out_ << YAML::Key << "polygon" << YAML::Value << YAML::Flow << YAML::BeginSeq;
    for (const Eigen::Vector2d& corner : room.corners) numbers({corner.x(), corner.y()});
    out_ << YAML::EndSeq;
  }

  static bool isPlain(const Wall& wall) { return isWhole(wall) && !wall.sigma; }

  static bool isWhole(const Wall& wall) {
    return wall.spans.size() == 1 && wall.spans[0].from == 0.0 &&
           wall.spans[0].to == wall.segment.length();
  }

  void writeWalls(const Room& room) {
    bool begun = false;
    for (const Wall& wall : room.walls) {
      if (isPlain(wall)) continue;
      if (!begun) out_ << YAML::Key << "walls" << YAML::Value << YAML::BeginMap;
      begun = true;
      write(wall);
    }
    if (begun) out_ << YAML::EndMap;
  }

  void write(const Wall& wall) {
    out_ << YAML::Key << wall.name << YAML::Value << YAML::Flow << YAML::BeginMap;
    if (wall.spans.empty()) {
      out_ << YAML::Key << "open" << YAML::Value << true;
    } else if (!isWhole(wall)) {
      out_ << YAML::Key << "spans" << YAML::Value << YAML::Flow << YAML::BeginSeq;
      for (const Span& span : wall.spans) numbers({span.from, span.to});
      out_ << YAML::EndSeq;
    }
    if (wall.sigma) {
      out_ << YAML::Key << "sigma" << YAML::Value;
      numbers({wall.sigma->position, wall.sigma->direction});
    }
    out_ << YAML::EndMap;
  }

  void write(const Door& door) {
    out_ << YAML::Flow << YAML::BeginMap << YAML::Key << "between" << YAML::Value << YAML::Flow
         << YAML::BeginSeq;
    for (const std::size_t room : door.rooms) name(map_.rooms()[room].name);
    out_ << YAML::EndSeq << YAML::Key << "at" << YAML::Value;
    numbers({door.centre_map.x(), door.centre_map.y()});
    out_ << YAML::Key << "width" << YAML::Value;
    number(door.width);
    out_ << YAML::Key << "threshold" << YAML::Value << door.threshold << YAML::EndMap;
  }

  const RoomMap& map_;
  YAML::Emitter out_;
};

}  // namespace

RoomMap::RoomMap(const Node& document) {
  Reader(*this).read(document);
}

std::string toYaml(const RoomMap& map) {
  return Writer(map).text();
}

void writeFile(const RoomMap& map, const std::string& path) {
  std::ofstream file(path);
  file << toYaml(map);
  file.flush();
  if (!file) throw config::Error(path, 0, "", "cannot be written");
}

}  // namespace sightline::world
