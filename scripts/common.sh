# Shared by the scripts, which source it.
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath -m "${SIGHTLINE_BUILD:-$repository/.build}")

# ROS belongs to the system's Python; another python3 earlier in the PATH breaks its tools.
use_system_python() {
  PATH=/usr/bin:$PATH
}

# Packages that the caller sourced stay outside: what is built and run does not depend on them.
leave_other_workspaces() {
  unset CMAKE_PREFIX_PATH ROS_PACKAGE_PATH PYTHONPATH LD_LIBRARY_PATH PKG_CONFIG_PATH
}

free_port() {
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])'
}
