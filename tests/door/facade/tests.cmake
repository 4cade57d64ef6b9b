capstan_test(facade DEPENDS facade service optimise_solvers)
if(TARGET facade_test)
  # The library exports its API alone: what stands behind that is tested as a source of the test's own.
  target_sources(facade_test PRIVATE ${CMAKE_SOURCE_DIR}/planner/door/facade/options.cpp)
endif()
