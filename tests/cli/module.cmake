# What the command line does, one test a case of cases.sh and of every *_cases.sh beside it.
file(GLOB case_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/cli/*cases.sh)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${case_files})
foreach(case_file ${case_files})
  file(STRINGS ${case_file} lines REGEX "^[A-Z][A-Za-z0-9]+\\(\\)")
  foreach(line ${lines})
    string(REGEX REPLACE "^([A-Za-z0-9]+).*" "\\1" name "${line}")
    add_test(NAME cli.${name} COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/cli/run $<TARGET_FILE:firmtouch> ${CMAKE_CXX_COMPILER}
                                      ${name})
    set_tests_properties(cli.${name} PROPERTIES TIMEOUT 120)
  endforeach()
endforeach()
