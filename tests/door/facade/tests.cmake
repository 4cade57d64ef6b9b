capstan_test(facade DEPENDS facade service optimise_solvers)
if(TARGET facade_test)
  # The library exports its API alone: what stands behind that is tested as a source of the test's own.
  target_sources(facade_test PRIVATE ${CMAKE_SOURCE_DIR}/planner/door/facade/options.cpp)
endif()

# The example of importing logs, as another program would build it: one header, one library. Of cases that are
# there already nothing is added, so that a second run says so.
add_executable(import_cases ${CMAKE_SOURCE_DIR}/examples/import_cases.cpp)
target_link_libraries(import_cases PRIVATE capstan::capstan)
set(imported ${CMAKE_CURRENT_BINARY_DIR}/import_cases_example.db)
add_test(NAME Facade.TheExampleOfImportBeginsWithoutABase
  COMMAND ${CMAKE_COMMAND} -E rm -f ${imported} ${imported}-journal)
add_test(NAME Facade.TheExampleOfImportKeepsCases
  COMMAND import_cases ${imported} wear ${CMAKE_SOURCE_DIR}/examples/wear_sheet.csv ${CMAKE_SOURCE_DIR}/examples/wear.csv)
add_test(NAME Facade.TheExampleOfImportAddsNothingTwice
  COMMAND import_cases ${imported} wear ${CMAKE_SOURCE_DIR}/examples/wear_sheet.csv ${CMAKE_SOURCE_DIR}/examples/wear.csv)
set_tests_properties(Facade.TheExampleOfImportBeginsWithoutABase PROPERTIES FIXTURES_SETUP no_imported_cases)
set_tests_properties(Facade.TheExampleOfImportKeepsCases PROPERTIES
  FIXTURES_REQUIRED no_imported_cases FIXTURES_SETUP imported_cases
  PASS_REGULAR_EXPRESSION "3 cases, 3 of them new; the base holds 3\n")
set_tests_properties(Facade.TheExampleOfImportAddsNothingTwice PROPERTIES FIXTURES_REQUIRED imported_cases
  PASS_REGULAR_EXPRESSION "3 cases, 0 of them new; the base holds 3\n")
