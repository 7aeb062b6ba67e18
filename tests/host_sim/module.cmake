if(TARGET firmtouch_host_sim AND TARGET firmtouch_tools_bake)
  add_library(firmtouch_test_part STATIC ${CMAKE_CURRENT_LIST_DIR}/part_asset.cpp)
  target_include_directories(firmtouch_test_part PUBLIC ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(firmtouch_test_part PUBLIC firmtouch_host_sim firmtouch_tools_bake firmtouch_tools_surface)
  firmtouch_hosted(firmtouch_test_part)
  firmtouch_test_module(host_sim LINKS firmtouch_test_part)
  find_path(FIRMTOUCH_EIGEN Eigen/Dense PATH_SUFFIXES eigen3)  # an oracle; without it its tests are left out
  if(FIRMTOUCH_EIGEN)
    target_include_directories(test_host_sim SYSTEM PRIVATE ${FIRMTOUCH_EIGEN})
  endif()
  add_test(NAME host_sim.outputs
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_outputs $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.splines
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_spline_loop $<TARGET_FILE_DIR:firmtouch-sim>
                   ${CMAKE_CURRENT_LIST_DIR}/../spline/cad)
  add_test(NAME host_sim.objects
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_objects $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.materials
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_materials $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.tool
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_tool $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.linkage
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_linkage $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.teach
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_teach $<TARGET_FILE_DIR:firmtouch-sim>)
  if(TARGET firmtouch-app-posix)
    add_test(NAME host_sim.load COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_load $<TARGET_FILE_DIR:firmtouch-sim>)
  endif()
  add_test(NAME host_sim.sweep
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_sweep $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.failures
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_failures $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.export
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_export $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.score
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_score $<TARGET_FILE_DIR:firmtouch-sim>)
  add_test(NAME host_sim.benches
           COMMAND ${CMAKE_CURRENT_LIST_DIR}/run_benches $<TARGET_FILE_DIR:firmtouch-sim>)
endif()
