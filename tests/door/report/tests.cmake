capstan_test(report DEPENDS report late service transport json)
# In a browser; skipped where there is none.
if(TARGET capstan)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  add_test(NAME Report.LooksRightInABrowser
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/look_test.py $<TARGET_FILE:capstan>
      ${CMAKE_SOURCE_DIR}/examples ${CMAKE_BINARY_DIR}/reports)
  set_tests_properties(Report.LooksRightInABrowser PROPERTIES TIMEOUT 900 COST 500 SKIP_RETURN_CODE 77)
endif()
if(TARGET capstan)
  add_test(NAME Pictures.OfTheShippedPartsAreWellFormedAndWhole
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/picture/files_test.py $<TARGET_FILE:capstan>
      ${CMAKE_SOURCE_DIR}/examples)
  set_tests_properties(Pictures.OfTheShippedPartsAreWellFormedAndWhole PROPERTIES TIMEOUT 900 COST 100)
endif()
