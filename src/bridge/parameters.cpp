#include "sightline/bridge/parameters.h"

#include <xmlrpcpp/XmlRpcValue.h>

namespace sightline::bridge {

namespace {

YAML::Node toYaml(XmlRpc::XmlRpcValue value) {
  YAML::Node node;
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      node = static_cast<bool>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      node = static_cast<int>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      node = static_cast<double>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      node = static_cast<std::string>(value);
      break;
    case XmlRpc::XmlRpcValue::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) node.push_back(toYaml(value[i]));
      break;
    case XmlRpc::XmlRpcValue::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& entry : value) node[entry.first] = toYaml(entry.second);
      break;
    default:
      break;
  }
  return node;
}

}  // namespace

config::Node parametersBelow(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue tree;
  YAML::Node yaml(YAML::NodeType::Map);
  if (node.getParam(node.getNamespace(), tree)) yaml = toYaml(tree);
  return {yaml, node.getNamespace()};
}

}  // namespace sightline::bridge
