if(TARGET capstan_python)
  add_test(NAME Python.TheModulePlansAndGivesPathsAsArrays
    COMMAND ${CAPSTAN_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/module_test.py ${CMAKE_SOURCE_DIR})
  set_tests_properties(Python.TheModulePlansAndGivesPathsAsArrays PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77
    ENVIRONMENT "PYTHONPATH=${CMAKE_BINARY_DIR}/python")
endif()
