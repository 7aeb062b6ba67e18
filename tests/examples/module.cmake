# Programs for whoever begins with the library (README.md). Each is a test: it returns 0 if what one feels is right. They
# call no board, so they run on this machine, and on a board's build in QEMU (tests/target).

# firmtouch_example(NAME LINKS TARGET...): the program and test of NAME.cpp.
function(firmtouch_example name)
  cmake_parse_arguments(example "" "" "LINKS" ${ARGN})
  set(source ${PROJECT_SOURCE_DIR}/tests/examples/${name}.cpp)
  set(pictures ${PROJECT_SOURCE_DIR}/tests/examples/pictures)
  if(CMAKE_CROSSCOMPILING)
    firmtouch_target_program(example_${name} SOURCES ${source} ${pictures}/nothing.cpp LINKS ${example_LINKS})
    if(FIRMTOUCH_BOARD AND is_emulated)  # tests/target
      add_test(NAME examples.${name}.${FIRMTOUCH_BOARD}
               COMMAND ${PROJECT_SOURCE_DIR}/hal/emulate ${FIRMTOUCH_BOARD} $<TARGET_FILE:example_${name}>)
    endif()
    if(NOT is_emulated)  # up to 102 KB of RAM, which not every chip has
      set_target_properties(example_${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  else()
    add_executable(example_${name} ${source})
    target_link_libraries(example_${name} PRIVATE ${example_LINKS} firmtouch_example_pictures)
    target_compile_options(example_${name} PRIVATE ${FIRMTOUCH_WARNING_FLAGS})
    add_test(NAME examples.${name} COMMAND ${pictures}/run ${name} $<TARGET_FILE:example_${name}>)
  endif()
endfunction()

if(TARGET firmtouch_tools_chart)
  add_library(firmtouch_example_pictures STATIC examples/pictures/draw.cpp)
  target_link_libraries(firmtouch_example_pictures PRIVATE firmtouch_tools_chart PUBLIC firmtouch_record)
  target_include_directories(firmtouch_example_pictures PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  firmtouch_hosted(firmtouch_example_pictures)
elseif(NOT CMAKE_CROSSCOMPILING)
  return()  # a build without tools draws nothing
endif()

firmtouch_example(wall LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(detent_ring LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(friction LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(own_shape LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(two_objects LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(bar_tool LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(own_linkage LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(own_effect LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(many_effects LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(forbidden_region LINKS firmtouch::scene firmtouch::servo)
firmtouch_example(teach_and_repeat LINKS firmtouch::scene firmtouch::servo)

# Those with an asset need the baker: this build's, or the one in FIRMTOUCH_HOST_TOOLS.
if(TARGET firmtouch OR FIRMTOUCH_HOST_TOOLS)
  set(block ${CMAKE_CURRENT_LIST_DIR}/block.obj)
  firmtouch_bake(TARGET example_block INPUTS ${block} OUTPUT block.fta OPTIONS --unit mm)
  firmtouch_embed(TARGET example_block_bytes ASSET example_block SYMBOL block_fta)
  firmtouch_bake(TARGET example_path INPUTS ${block} ${CMAKE_CURRENT_LIST_DIR}/path.csv OUTPUT block_and_path.fta
                 OPTIONS --unit mm)
  firmtouch_embed(TARGET example_path_bytes ASSET example_path SYMBOL block_and_path_fta)

  firmtouch_bake(TARGET example_low_block INPUTS ${CMAKE_CURRENT_LIST_DIR}/low_block.obj OUTPUT low_block.fta
                 OPTIONS --unit mm)
  firmtouch_embed(TARGET example_low_block_bytes ASSET example_low_block SYMBOL low_block_fta)
  firmtouch_bake(TARGET example_two_materials INPUTS ${CMAKE_CURRENT_LIST_DIR}/two_materials.obj OUTPUT two_materials.fta
                 OPTIONS --unit mm --materials ${CMAKE_CURRENT_LIST_DIR}/two_materials.txt)
  firmtouch_embed(TARGET example_two_materials_bytes ASSET example_two_materials SYMBOL two_materials_fta)
  firmtouch_bake(TARGET example_torus INPUTS ${PROJECT_SOURCE_DIR}/tests/spline/cad/torus.igs OUTPUT torus.fta)
  firmtouch_embed(TARGET example_torus_bytes ASSET example_torus SYMBOL torus_fta)

  firmtouch_example(touch_mesh LINKS firmtouch::controller example_block_bytes)
  firmtouch_example(materials LINKS firmtouch::controller example_two_materials_bytes)
  firmtouch_example(two_rates LINKS firmtouch::controller example_block_bytes)
  firmtouch_example(replay_log LINKS firmtouch::controller example_block_bytes)
  firmtouch_example(hot_swap LINKS firmtouch::controller example_block_bytes example_low_block_bytes)
  firmtouch_example(spline_surface LINKS firmtouch::controller example_torus_bytes)
  firmtouch_example(follow_path LINKS firmtouch::controller example_path_bytes)
endif()
