# What every translation unit of this project is compiled with. Nothing global: the flags belong to targets, so a
# project that takes Firmtouch in keeps its own.

set(FIRMTOUCH_WARNING_FLAGS
    -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wfloat-equal -Wshadow
    # Of -fno-rounding-math below, which is the default there.
    $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-unsupported-floating-point-opt>)
# Firmware and hal also: clean of these. Not -Wuseless-cast: a cast to uint32_t is of use where that is no unsigned long.
set(FIRMTOUCH_STRICT_FLAGS -Wold-style-cast -Wundef -Wswitch-enum $<$<CXX_COMPILER_ID:GNU>:-Wcast-align=strict>)
if(FIRMTOUCH_WERROR)
  list(APPEND FIRMTOUCH_WARNING_FLAGS -Werror)
endif()

# Tools, host_sim and host tests: clang warns of every double made of a float, and of what a test takes in but does not call.
set(FIRMTOUCH_HOSTED_FLAGS
    $<$<CXX_COMPILER_ID:Clang,AppleClang>:-Wno-double-promotion;-Wno-unneeded-internal-declaration>)

# The same bits everywhere: no contraction to fused multiply-add, no fast-math nor any part of it. A target's options
# follow CMAKE_CXX_FLAGS and add_compile_options, so these win over what the project around Firmtouch sets. What comes later
# still is refused by math/isa.hpp and math/arithmetic_check.cpp (check.arithmetic). Not -fno-fast-math: it brings
# contraction back and errno with it, and it would cancel only the flags set here.
set(FIRMTOUCH_ARITHMETIC_FLAGS
    -fno-unsafe-math-optimizations -fno-finite-math-only -fno-associative-math -fno-reciprocal-math
    -fsigned-zeros -fno-rounding-math -ffp-contract=off -fno-math-errno)
# With all that the processor has: AVX-512's second sixteen registers spare queries of meshes 3 to 8 % of their time
# (November 2026). But not tuned for it: for a Zen GCC 12 keeps pointers in vector registers, whence they come back late
# (3 to 5 % slower).
set(FIRMTOUCH_NATIVE_FLAGS "$<$<BOOL:${FIRMTOUCH_NATIVE}>:-march=native;-mtune=generic>")

# GCC 12 at -O2 and above leaves out the rounding of doubles to float and back where it packs neighbours into vectors
# (tests/math/rounding_host_test.cpp sees it). Freestanding code has no doubles and keeps its vectors.
set(FIRMTOUCH_ROUNDING_FLAGS $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

# Which folder of firmware/firmtouch/arch holds the primitives of this target (math/isa.hpp). Chosen by what the compiler
# defines under these flags; -DFIRMTOUCH_ARCH=portable overrides.
function(firmtouch_find_arch result)
  separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${ARGN}")
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${flags} -dM -E -x c++ /dev/null OUTPUT_VARIABLE macros ERROR_QUIET)
  set(arch portable)
  if(macros MATCHES "__AVX2__ ")
    set(arch avx2)
  elseif(macros MATCHES "__ARM_FEATURE_DSP " AND macros MATCHES "__thumb2__ " AND macros MATCHES "__ARM_FP ")
    set(arch armv7em_fpv4)
    if(CMAKE_CXX_FLAGS MATCHES "-mfpu=(fpv5|fp-armv8)")  # no macro separates it from FPv4
      set(arch armv7em_fpv5)
    endif()
  elseif(macros MATCHES "__SSE2__ |__riscv_flen |__ARM_FP ")
    set(arch hard_float)
  endif()
  set(${result} ${arch} PARENT_SCOPE)
endfunction()
if(NOT FIRMTOUCH_ARCH)
  set(native_flag "")
  if(FIRMTOUCH_NATIVE)
    set(native_flag -march=native)
  endif()
  firmtouch_find_arch(FIRMTOUCH_ARCH ${native_flag})
endif()
set(FIRMTOUCH_ARCH_DEFINITION "FIRMTOUCH_ARCH_HEADER=\"firmtouch/arch/${FIRMTOUCH_ARCH}/primitives.hpp\"" CACHE INTERNAL "")

# Freestanding code: firmware and hal.
set(FIRMTOUCH_FREESTANDING_FLAGS
    -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-unwind-tables
    -fno-asynchronous-unwind-tables -ffunction-sections -fdata-sections)

# Seen from everywhere: the functions below may be called by the project that takes Firmtouch in.
foreach(flags WARNING STRICT HOSTED ARITHMETIC ROUNDING NATIVE FREESTANDING)
  set(FIRMTOUCH_${flags}_FLAGS "${FIRMTOUCH_${flags}_FLAGS}" CACHE INTERNAL "")
endforeach()

set(FIRMTOUCH_OPTIMIZE "" CACHE STRING "Level of all but the hot files, such as -O3 (empty: -Os on a controller, -O2 here)")
if(FIRMTOUCH_OPTIMIZE)
  set(FIRMTOUCH_COLD_FLAGS $<$<NOT:$<CONFIG:Debug>>:${FIRMTOUCH_OPTIMIZE}>)
elseif(CMAKE_CROSSCOMPILING)
  set(FIRMTOUCH_COLD_FLAGS $<$<NOT:$<CONFIG:Debug>>:-Os>)
else()
  set(FIRMTOUCH_COLD_FLAGS "")
endif()

# firmtouch_module(NAME [FOLDER FOLDER] [LINKS MODULE...] [HOT FILE...]): one library a module of the firmware,
# libfirmtouch_NAME.a, from the *.cpp of its folder (default: NAME). It may include only the modules that it links (check.includes). A module of headers alone has no
# archive. On a controller only HOT files are compiled for speed (-O2): those that a tick runs, and of these only the ones
# that are measurably faster by it. All others are compiled for size (-Os). On this machine all are compiled for speed.
function(firmtouch_module name)
  cmake_parse_arguments(module "" "FOLDER" "LINKS;HOT" ${ARGN})
  if(NOT module_FOLDER)
    set(module_FOLDER ${name})
  endif()
  list(TRANSFORM module_LINKS PREPEND firmtouch_)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/firmtouch/${module_FOLDER}/*.cpp)
  set(target firmtouch_${name})
  set(include $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/firmware> $<INSTALL_INTERFACE:include>)
  if(sources)
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${include})
    target_compile_features(${target} PUBLIC cxx_std_17)
    target_link_libraries(${target} PUBLIC ${module_LINKS})
    firmtouch_firmware(${target})
    if(FIRMTOUCH_COLD_FLAGS)
      target_compile_options(${target} PRIVATE ${FIRMTOUCH_COLD_FLAGS})
      foreach(file ${module_HOT})
        if(NOT ${CMAKE_CURRENT_SOURCE_DIR}/firmtouch/${module_FOLDER}/${file} IN_LIST sources)
          message(FATAL_ERROR "firmtouch_module(${name}): there is no ${file}")
        endif()
        set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/firmtouch/${module_FOLDER}/${file}
                                    PROPERTIES COMPILE_OPTIONS "$<$<NOT:$<CONFIG:Debug>>:-O2>")
      endforeach()
    endif()
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${include})
    target_compile_features(${target} INTERFACE cxx_std_17)
    target_link_libraries(${target} INTERFACE ${module_LINKS})
  endif()
  add_library(firmtouch::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY FIRMTOUCH_MODULES ${target})
endfunction()

# firmtouch_freestanding(TARGET): the flags of all that runs on a controller.
function(firmtouch_freestanding target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O2> ${FIRMTOUCH_FREESTANDING_FLAGS}
                                           ${FIRMTOUCH_ARITHMETIC_FLAGS} ${FIRMTOUCH_NATIVE_FLAGS}
                                           ${FIRMTOUCH_WARNING_FLAGS})
  target_compile_definitions(${target} PRIVATE ${FIRMTOUCH_ARCH_DEFINITION})
  # Each file is a unit of its own, also in a project with CMAKE_UNITY_BUILD.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF UNITY_BUILD OFF)
endfunction()

# firmtouch_firmware(TARGET): those, with the warnings of our own sources.
function(firmtouch_firmware target)
  firmtouch_freestanding(${target})
  target_compile_options(${target} PRIVATE ${FIRMTOUCH_STRICT_FLAGS})
endfunction()

# firmtouch_hosted(TARGET [LEVEL]): the flags of tools, host_sim and host tests. LEVEL: -O2, or -O1 for what waits for its
# compiler longer than it runs.
function(firmtouch_hosted target)
  set(level -O2)
  if(ARGC GREATER 1)
    set(level ${ARGV1})
  endif()
  target_compile_features(${target} PRIVATE cxx_std_17)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:${level}> ${FIRMTOUCH_ARITHMETIC_FLAGS} ${FIRMTOUCH_ROUNDING_FLAGS}
                                           ${FIRMTOUCH_NATIVE_FLAGS} ${FIRMTOUCH_WARNING_FLAGS} ${FIRMTOUCH_HOSTED_FLAGS})
  target_compile_definitions(${target} PRIVATE ${FIRMTOUCH_ARCH_DEFINITION})
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  if(FIRMTOUCH_TOGETHER)
    firmtouch_together(${target})
  endif()
endfunction()
