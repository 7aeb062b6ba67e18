# Retired terms do not come back: no name, comment, message or page says one of tests/check/vocabulary.txt, where also
# stands what to write instead. The field's terms open DESIGN.md. Read by tests/check/run.

together=1
check() {
  find README.md DESIGN.md SAFETY.md VERIFICATION.md CMakeLists.txt firmware hal host_sim tests tools -type f \
    \( -name '*.md' -o -name '*.hpp' -o -name '*.cpp' -o -name '*.h' -o -name '*.html' -o -name '*.js' -o -name '*.sh' -o -name '*.awk' \
    -o -name '*.cmake' -o -name CMakeLists.txt -o ! -name '*.*' \) ! -path 'tests/check/vocabulary.*' |
    LC_ALL=C sort | look
}
look() { LC_ALL=C awk -v list=tests/check/vocabulary.txt -f "$here/vocabulary.awk"; }
plants() {
  cat <<'END'
name @ firmware/firmtouch/core/crc32.cpp @ int told_distance_m(); @ core/crc32.cpp:[0-9]+: name: told
name_in_capitals @ tests/core/status_test.cpp @ constexpr int kMostPlanes = 3; @ status_test.cpp:[0-9]+: name: k most
comment @ firmware/firmtouch/core/crc32.cpp @ // The dearest query of all. @ core/crc32.cpp:[0-9]+: comment: dearest
message @ tools/log/plot.cpp @ const char* text = "the mesh tells another side"; @ plot.cpp:[0-9]+: message: tells
name_in_a_script_of_a_page @ host_sim/pages/view.js @ function askFor() {} @ pages/view.js:[0-9]+: name: ask
message_in_a_script_of_a_page @ host_sim/pages/view.js @ const planted = 'the mesh tells another side'; @ pages/view.js:[0-9]+: message: tells
page @ README.md @ It is asked for the undone collapses. @ README.md:[0-9]+: page: undone
script_comment @ tests/check/run @ # judges the answers @ tests/check/run:[0-9]+: comment: judges
END
}

plant_file_name() {
  echo '#pragma once' >firmware/firmtouch/core/told_again.hpp
  expect='told_again.hpp:0: name: told'
}
plant_comment_over_two_lines() {
  printf '// A list in place\n// of a tree.\n' >>firmware/firmtouch/core/crc32.cpp
  expect='core/crc32.cpp:[0-9]+: comment: in place of'
}
plant_everyday_english() {  # only the last line is a retired term
  english=tests/core/planted_english.cpp
  cat >$english <<'EOF'
// In front of the task: std::steady_clock, a place in a file, a machined part, v.front(), the masked half,
// `told` as quoted code, a memory fence.
int steady_clock_ns(), v_front = list.front();
// He forgives.
EOF
  [ "$(echo $english | look | grep -c $english)" = 1 ] || return 1
  expect='planted_english.cpp:[0-9]+: comment: forgives'
}
plant_raw_string_over_two_lines() {
  printf 'const char* text = R"(The mesh\nundone by "it")";\n' >>tools/log/edit.cpp
  expect='edit.cpp:[0-9]+: message: undone'
}
