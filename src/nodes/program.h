#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

namespace sightline::nodes {

using MakeNode = std::shared_ptr<void> (*)(ros::NodeHandle node, ros::NodeHandle private_node);

// The main of a node's program: 0 once ROS is shut down, 1 with a fatal log entry if the node
// cannot be made, 2 for words that it does not know; --help says how it is called.
int runNode(int argc, char** argv, const char* name, MakeNode make);

}  // namespace sightline::nodes
