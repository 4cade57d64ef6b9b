# Late binding on a machine that LinuxCNC simulates (examples/linuxcnc): one start of LinuxCNC for all scenarios, so one test.
set(at_control ${CMAKE_CURRENT_LIST_DIR})
add_executable(control_test ${at_control}/late_binding_test.cpp ${at_control}/bracket_test.cpp ${at_control}/scenarios.cpp ${at_control}/cut_block.cpp)
target_link_libraries(control_test PRIVATE capstan_simulated GTest::gmock GTest::gtest_main)
capstan_compile_as_test(control_test)
# The example takes what is built, as it is used: the command, the library for C, the clock.
add_dependencies(control_test capstan capstan_late_shared capstan_fast_clock)
target_compile_definitions(control_test PRIVATE CAPSTAN_COMMAND="$<TARGET_FILE:capstan>"
  CAPSTAN_LATE_LIBRARY="$<TARGET_FILE:capstan_late_shared>" CAPSTAN_FAST_CLOCK="$<TARGET_FILE:capstan_fast_clock>")
add_test(NAME LateBindingAtTheControl COMMAND control_test)
set_tests_properties(LateBindingAtTheControl PROPERTIES TIMEOUT 900 RESOURCE_LOCK linuxcnc COST 1000
  SKIP_REGULAR_EXPRESSION "SKIPPED")

# What is checked of a program needs no control.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME LateBindingProgram COMMAND ${Python3_EXECUTABLE} -B ${at_control}/program_test.py)
set_tests_properties(LateBindingProgram PROPERTIES TIMEOUT 60)
