find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME Express.Generate
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/generate_test.py
    ${CMAKE_SOURCE_DIR}/planner/files/exchange/express/generate.py)
set_tests_properties(Express.Generate PROPERTIES TIMEOUT 60)
