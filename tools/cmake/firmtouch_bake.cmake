# Assets in a CMake build, for users of the library as well as for its own boards and tests:
#
#   firmtouch_bake(TARGET scene INPUTS bone.obj drill.csv OUTPUT scene.fta [OPTIONS --unit mm])
#   firmtouch_embed(TARGET scene_bytes ASSET scene SYMBOL scene_fta)
#   target_link_libraries(my_firmware PRIVATE scene_bytes)
#
# The program `firmtouch` that bakes runs on the building machine: this build's own, or the one in FIRMTOUCH_HOST_TOOLS,
# or, where that is empty (cross builds, subprojects), one that is built once in <build>/host-tools with the machine's
# own compiler (FIRMTOUCH_HOST_CXX names another).

set(FIRMTOUCH_HOST_CXX "" CACHE FILEPATH "Compiler of the machine that builds, for its own firmtouch (empty: CMake's choice)")

# Sets `program` to the path of a firmtouch that runs here, and `depends` to what must be built before.
function(firmtouch_host_program program depends)
  if(TARGET firmtouch AND NOT CMAKE_CROSSCOMPILING)
    set(${program} $<TARGET_FILE:firmtouch> PARENT_SCOPE)
    set(${depends} firmtouch PARENT_SCOPE)
    return()
  endif()
  if(FIRMTOUCH_HOST_TOOLS)
    find_program(FIRMTOUCH_PROGRAM_${FIRMTOUCH_HOST_TOOLS} firmtouch PATHS ${FIRMTOUCH_HOST_TOOLS}
                 PATH_SUFFIXES bin NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    set(found "${FIRMTOUCH_PROGRAM_${FIRMTOUCH_HOST_TOOLS}}")
    if(NOT found)
      message(FATAL_ERROR "FIRMTOUCH_HOST_TOOLS=${FIRMTOUCH_HOST_TOOLS}: no program `firmtouch` there. "
                          "Build the preset `host` and name its bin folder, or leave the variable empty.")
    endif()
    set(${program} ${found} PARENT_SCOPE)
    set(${depends} ${found} PARENT_SCOPE)
    return()
  endif()
  firmtouch_add_host_tools()
  set(${program} ${CMAKE_BINARY_DIR}/host-tools/bin/firmtouch PARENT_SCOPE)
  set(${depends} firmtouch_host_tools ${CMAKE_BINARY_DIR}/host-tools/bin/firmtouch PARENT_SCOPE)
endfunction()

# A target that configures and builds this source tree for the building machine, with this build's generator: there may be
# no other. The environment's compilers and flags are the cross build's, so they are kept out.
function(firmtouch_add_host_tools)
  if(TARGET firmtouch_host_tools)
    return()
  endif()
  set(source ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../..)
  set(build ${CMAKE_BINARY_DIR}/host-tools)
  set(clean ${CMAKE_COMMAND} -E env --unset=CC --unset=CXX --unset=CFLAGS --unset=CXXFLAGS --unset=CPPFLAGS
            --unset=LDFLAGS --unset=CMAKE_TOOLCHAIN_FILE --unset=MAKEFLAGS --unset=MFLAGS)
  set(compiler)
  if(FIRMTOUCH_HOST_CXX)
    set(compiler -DCMAKE_CXX_COMPILER=${FIRMTOUCH_HOST_CXX})
  endif()
  string(REPLACE " Multi-Config" "" generator ${CMAKE_GENERATOR})  # which puts programs into folders of its own
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  add_custom_target(
    firmtouch_host_tools
    COMMAND ${clean} ${CMAKE_COMMAND} -S ${source} -B ${build} -G ${generator} -DCMAKE_MAKE_PROGRAM=${CMAKE_MAKE_PROGRAM}
            -DCMAKE_BUILD_TYPE=Release -DFIRMTOUCH_TESTS=OFF -DFIRMTOUCH_TOOLS=ON ${compiler}
    COMMAND ${clean} ${CMAKE_COMMAND} --build ${build} --target firmtouch --parallel ${cores}
    BYPRODUCTS ${build}/bin/firmtouch
    COMMENT "Firmtouch's baker, for this machine"
    VERBATIM)
endfunction()

# Target `target`: the host's program writes `output` (relative: in the current binary folder) by `words` -o output `options`.
function(firmtouch_add_output target output verb words options depends)
  get_filename_component(path ${output} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
  get_filename_component(folder ${path} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})  # make does not, ninja does
  firmtouch_host_program(program program_depends)
  add_custom_command(
    OUTPUT ${path}
    COMMAND ${program} ${words} -o ${path} ${options}
    DEPENDS ${depends} ${program_depends}
    COMMENT "${verb} ${output}"
    VERBATIM)
  add_custom_target(${target} DEPENDS ${path})
  set_target_properties(${target} PROPERTIES FIRMTOUCH_ASSET ${path})
endfunction()

# firmtouch_bake(TARGET NAME INPUTS FILE... OUTPUT FILE.fta [OPTIONS ...]): target NAME, which bakes OUTPUT (relative: in
# the current binary folder). INPUTS may be files that other targets make; name those targets in DEPENDS. Relative INPUTS,
# and the files of --device, --materials and --material-numbers, are in the current source folder; if one changes, the
# asset is baked again. --device may also name a machine, and each of the three a file that is made in the binary folder.
function(firmtouch_bake)
  cmake_parse_arguments(bake "" "TARGET;OUTPUT" "INPUTS;OPTIONS;DEPENDS" ${ARGN})
  if(NOT bake_TARGET OR NOT bake_INPUTS OR NOT bake_OUTPUT OR bake_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "firmtouch_bake(TARGET name INPUTS file... OUTPUT scene.fta [OPTIONS ...] [DEPENDS target...])")
  endif()
  set(inputs)
  foreach(input ${bake_INPUTS})
    get_filename_component(input ${input} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND inputs ${input})
  endforeach()
  set(options)
  set(files ${inputs})
  set(before "")
  foreach(word IN LISTS bake_OPTIONS)
    set(option "")  # with its `=`, if `word` has it and its file
    set(name "")    # of the file
    if(before MATCHES "^--(device|materials|material-numbers)$")
      set(name "${word}")
    elseif(word MATCHES "^(--(device|materials|material-numbers)=)(.+)$")
      set(option "${CMAKE_MATCH_1}")
      set(name "${CMAKE_MATCH_3}")
    endif()
    set(before "${word}")
    get_filename_component(path "${name}" ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    if(name AND (IS_ABSOLUTE "${name}" OR (EXISTS "${path}" AND NOT IS_DIRECTORY "${path}")))
      set(word "${option}${path}")
      list(APPEND files "${path}")
    endif()
    list(APPEND options "${word}")
  endforeach()
  firmtouch_add_output(${bake_TARGET} ${bake_OUTPUT} "Baking" "bake;${inputs}" "${options}" "${files};${bake_DEPENDS}")
endfunction()

# firmtouch_make(TARGET NAME KIND part|path|walk [MODEL FILE] OUTPUT FILE [OPTIONS ...]): target NAME, which generates a
# demo file.
function(firmtouch_make)
  cmake_parse_arguments(make "" "TARGET;KIND;MODEL;OUTPUT" "OPTIONS" ${ARGN})
  if(NOT make_TARGET OR NOT make_KIND OR NOT make_OUTPUT OR make_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "firmtouch_make(TARGET name KIND part|path|walk [MODEL file] OUTPUT file [OPTIONS ...])")
  endif()
  firmtouch_add_output(${make_TARGET} ${make_OUTPUT} "Making" "make;${make_KIND};${make_MODEL}" "${make_OPTIONS}" "${make_MODEL}")
endfunction()

# firmtouch_embed(TARGET NAME ASSET scene.fta|BAKE_TARGET SYMBOL SYM): static library NAME with
#     extern "C" const unsigned char SYM[];       the asset, 16-byte aligned, in section .firmtouch_asset
#     extern "C" const unsigned SYM_size;         its length in bytes
# so that a linker script can place the asset in memory-mapped flash. A relative ASSET is in the current source folder, or made
# in the binary folder.
function(firmtouch_embed)
  cmake_parse_arguments(embed "" "TARGET;ASSET;SYMBOL" "" ${ARGN})
  if(NOT embed_TARGET OR NOT embed_ASSET OR NOT embed_SYMBOL OR embed_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "firmtouch_embed(TARGET name ASSET scene.fta SYMBOL symbol)")
  endif()
  if(NOT embed_SYMBOL MATCHES "^[A-Za-z_][A-Za-z0-9_]*$")
    message(FATAL_ERROR "firmtouch_embed: SYMBOL ${embed_SYMBOL} is no name in C")
  endif()
  if(TARGET ${embed_ASSET})
    get_target_property(asset ${embed_ASSET} FIRMTOUCH_ASSET)
  else()
    get_filename_component(asset ${embed_ASSET} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    if(NOT EXISTS ${asset})
      get_filename_component(asset ${embed_ASSET} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
    endif()
    if(NOT EXISTS ${asset} AND NOT embed_ASSET MATCHES "[.]")
      message(FATAL_ERROR "firmtouch_embed: there is no target and no file ${embed_ASSET}. firmtouch_bake(TARGET ${embed_ASSET} "
                          "...) comes before it.")
    endif()
  endif()
  set(symbol ${embed_SYMBOL})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${embed_TARGET}.embed.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[// Made by firmtouch_embed: the bytes of an asset file as a symbol.
__asm__(
    ".section .firmtouch_asset,\"a\",%progbits\n"
    ".balign 16\n"
    ".global @symbol@\n"
    ".type @symbol@,%object\n"
    "@symbol@:\n"
    ".incbin \"@asset@\"\n"
    "@symbol@_end:\n"
    ".size @symbol@, @symbol@_end - @symbol@\n"
    ".balign 4\n"
    ".global @symbol@_size\n"
    ".type @symbol@_size,%object\n"
    "@symbol@_size:\n"
    ".long @symbol@_end - @symbol@\n"
    ".size @symbol@_size, 4\n"
    ".text\n");
]])
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${asset})
  add_library(${embed_TARGET} STATIC ${source})
  # With -flto a symbol that only assembly defines is not found; in a unity build OBJECT_DEPENDS has no effect.
  set_target_properties(${embed_TARGET} PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF UNITY_BUILD OFF)
  target_compile_options(${embed_TARGET} PRIVATE -fno-lto)
  if(TARGET ${embed_ASSET})
    add_dependencies(${embed_TARGET} ${embed_ASSET})
  endif()
endfunction()
