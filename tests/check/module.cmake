# The checks of the source tree, one test a check; each also shows that it catches the defects planted for it.
foreach(check includes words layout format headers vocabulary promises readme packaging arithmetic ring_model handoff_model)
  add_test(NAME check.${check} COMMAND ${PROJECT_SOURCE_DIR}/tests/check/run ${check})
  set_tests_properties(check.${check} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
endforeach()
