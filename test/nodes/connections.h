#pragma once

#include <string>

#include <XmlRpcClient.h>
#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/ros.h>

#include "nodes/comes_true.h"

namespace sightline::test {

/// Whether what a node publishes on a topic reaches another. All names begin with a slash.
inline bool isConnected(const std::string& publisher, const std::string& topic,
                        const std::string& subscriber) {
  using XmlRpc::XmlRpcValue;
  XmlRpcValue request;
  request[0] = ros::this_node::getName();
  request[1] = publisher;
  XmlRpcValue response;
  XmlRpcValue uri;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(uri, host, port);
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  XmlRpcValue answer;
  if (!client.execute("getBusInfo", caller, answer) || answer.size() < 3) return false;
  XmlRpcValue& connections = answer[2];
  for (int i = 0; i < connections.size(); ++i) {
    // Number, other node, direction, transport, topic.
    XmlRpcValue& connection = connections[i];
    if (std::string(connection[1]) == subscriber && std::string(connection[2]) == "o" &&
        std::string(connection[4]) == topic) {
      return true;
    }
  }
  return false;
}

inline void waitForConnection(const std::string& publisher, const std::string& topic,
                              const std::string& subscriber) {
  EXPECT_TRUE(comesTrue([&] { return isConnected(publisher, topic, subscriber); }))
      << subscriber << " does not hear " << publisher << " on " << topic;
}

}  // namespace sightline::test
