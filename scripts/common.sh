# What the scripts share; sourced by them.
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$(realpath -m "${SIGHTLINE_BUILD:-$repository/.build}")

# ROS belongs to the system's Python; another python3 earlier in the PATH breaks its tools.
use_system_python() {
  PATH=/usr/bin:$PATH
}

# configure FOLDER OPTION...: as every build of the scripts is configured.
configure() {
  local folder=$1
  shift
  mkdir -p "$folder"
  cmake -S "$repository" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSIGHTLINE_WERROR=ON \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 "$@" >"$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log"; return 1; }
}
