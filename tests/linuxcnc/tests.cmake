# Programs on a machine that LinuxCNC simulates: cycle times, and the reference part.
set(simulated ${CMAKE_CURRENT_LIST_DIR})
add_library(capstan_fast_clock MODULE ${simulated}/fast_clock.c)
target_compile_options(capstan_fast_clock PRIVATE -Wall -Wextra -Werror)

file(GLOB simulated_sources CONFIGURE_DEPENDS ${simulated}/*.cpp)
list(FILTER simulated_sources EXCLUDE REGEX "_test\\.cpp$")
add_library(capstan_simulated STATIC ${simulated_sources})
target_link_libraries(capstan_simulated PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support
  capstan::motion capstan::controls capstan::json)
# LinuxCNC takes what is built, as it is used: the command and the clock.
add_dependencies(capstan_simulated capstan capstan_fast_clock)
target_compile_definitions(capstan_simulated PRIVATE
  CAPSTAN_COMMAND="$<TARGET_FILE:capstan>" CAPSTAN_FAST_CLOCK="$<TARGET_FILE:capstan_fast_clock>")

file(GLOB simulated_tests CONFIGURE_DEPENDS ${simulated}/*_test.cpp)
add_executable(linuxcnc_test ${simulated_tests})
target_link_libraries(linuxcnc_test PRIVATE capstan_simulated capstan::tooling capstan::casebase GTest::gmock GTest::gtest_main)
capstan_compile_as_test(linuxcnc_test)
# LinuxCNC's shared memory has fixed keys: one at a time. They mostly wait for its clock, so they begin first and
# other tests run beside them; what is measured counts servo periods, and does not depend on the load.
capstan_tests_by_suite(linuxcnc_test PROPERTIES TIMEOUT 900 RESOURCE_LOCK linuxcnc COST 1000)
