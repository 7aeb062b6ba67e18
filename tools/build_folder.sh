# Read by tools/demo and whoever configures a preset:   . tools/build_folder.sh
# fresh_build_folder ROOT FOLDER: removes a build folder that was configured for another place (a moved clone) or by a
# toolchain file that has changed since. Else it is kept.
fresh_build_folder() {
  [ -f "$2/CMakeCache.txt" ] || return 0
  if ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$1" "$2/CMakeCache.txt" ||
    [ -n "$(find "$1"/hal/cmake "$1"/hal/*/board.cmake -newer "$2/CMakeCache.txt" 2>/dev/null)" ]; then
    rm -rf "$2"
  fi
}
