#include "sightline/bridge/output.h"

namespace sightline::bridge {

boost::shared_ptr<ros::M_string> latchedHeader(const std::string& type, const std::string& md5sum,
                                               const std::string& definition) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = type;
  (*header)["md5sum"] = md5sum;
  (*header)["message_definition"] = definition;
  (*header)["latching"] = "1";
  return header;
}

}  // namespace sightline::bridge
