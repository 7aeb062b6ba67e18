# The decoders under the address and undefined-behaviour sanitizers, where the compiler has them: the modules that read an
# asset are compiled once more, into this program alone. FIRMTOUCH_LONG=1 in the environment tries
# more odd words.
include(CheckCXXSourceCompiles)
set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=all)
set(CMAKE_REQUIRED_FLAGS "-fsanitize=address,undefined")
set(CMAKE_REQUIRED_LINK_OPTIONS ${sanitize})
check_cxx_source_compiles("int main() { return 0; }" FIRMTOUCH_HAS_SANITIZERS)
unset(CMAKE_REQUIRED_FLAGS)
unset(CMAKE_REQUIRED_LINK_OPTIONS)

firmtouch_test_module(fuzz LINKS firmtouch_tools_bake)
target_sources(test_fuzz PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/victim.cpp ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/feel.cpp)
if(FIRMTOUCH_HAS_SANITIZERS)
  foreach(part core math query mesh field curve asset)
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/firmware/firmtouch/${part}/*.cpp)
    target_sources(test_fuzz PRIVATE ${sources})
  endforeach()
  target_compile_options(test_fuzz PRIVATE ${sanitize} -g1)
  target_link_options(test_fuzz PRIVATE ${sanitize})
else()
  message(STATUS "test_fuzz runs without sanitizers: this compiler has none")
endif()
