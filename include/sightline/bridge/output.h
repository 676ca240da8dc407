#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>
#include <boost/make_shared.hpp>

namespace sightline::bridge {

/// Destination of messages of one type: a topic of a running graph, or a connection of a bag.
template <class Message>
struct Port {
  std::function<void(const Message&)> write;
  std::function<bool()> is_wanted;  ///< whether anybody takes what is written
};

/// Opens ports: on a node handle for a running graph, on a bag for a recording. What makes messages
/// is written once, for both.
class Output {
 public:
  /// Topics are the node's.
  explicit Output(const ros::NodeHandle& node) : node_(node) {}
  /// Topics are from the root; messages are written at the time that `now` holds. Both have to live
  /// as long.
  Output(rosbag::Bag& bag, const ros::Time& now) : bag_(&bag), now_(&now) {}

  /// Opens a port. The last message of a latched port is repeated to late subscribers.
  template <class Message>
  Port<Message> open(const std::string& topic, bool latched = false);
  /// Opens a port for transforms of moving frames.
  Port<tf2_msgs::TFMessage> openTransforms() { return open<tf2_msgs::TFMessage>("/tf"); }
  /// Opens a port for transforms of frames that never move.
  Port<tf2_msgs::TFMessage> openStaticTransforms() {
    return open<tf2_msgs::TFMessage>("/tf_static", /*latched=*/true);
  }
  bool isBag() const { return bag_ != nullptr; }

 private:
  template <class Message>
  Port<Message> openTopic(const std::string& topic, bool latched);
  template <class Message>
  Port<Message> openConnection(const std::string& topic, bool latched);

  std::optional<ros::NodeHandle> node_;  // none for a bag
  rosbag::Bag* bag_ = nullptr;
  const ros::Time* now_ = nullptr;
};

/// A connection whose last message a player repeats to late subscribers.
boost::shared_ptr<ros::M_string> latchedHeader(const std::string& type, const std::string& md5sum,
                                               const std::string& definition);

template <class Message>
Port<Message> Output::open(const std::string& topic, bool latched) {
  return bag_ ? openConnection<Message>(topic, latched) : openTopic<Message>(topic, latched);
}

template <class Message>
Port<Message> Output::openTopic(const std::string& topic, bool latched) {
  constexpr std::uint32_t kQueue = 100;  // scans that waited for something come in a burst
  const ros::Publisher publisher = node_->advertise<Message>(topic, kQueue, latched);
  // Published by pointer, so that nodelets of one process are not served copies.
  return {[publisher](const Message& message) {
            publisher.publish(boost::make_shared<const Message>(message));
          },
          [publisher] { return publisher.getNumSubscribers() > 0; }};
}

template <class Message>
Port<Message> Output::openConnection(const std::string& topic, bool latched) {
  namespace traits = ros::message_traits;
  const std::string from_root = topic.rfind('/', 0) == 0 ? topic : "/" + topic;
  const auto header = latched
                          ? latchedHeader(traits::datatype<Message>(), traits::md5sum<Message>(),
                                          traits::definition<Message>())
                          : nullptr;
  return {[bag = bag_, now = now_, from_root, header](const Message& message) {
            bag->write(from_root, *now, message, header);
          },
          [] { return true; }};
}

}  // namespace sightline::bridge
