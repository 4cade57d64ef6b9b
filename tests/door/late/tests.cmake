capstan_test(late DEPENDS late service transport json)

# The example for C, as a control's maker would build it: one header, one library.
add_executable(late_bind ${CMAKE_SOURCE_DIR}/examples/late_bind.c)
target_link_libraries(late_bind PRIVATE capstan::late_shared)
add_test(NAME LateInterface.TheExampleForCPrintsAProgram
  COMMAND late_bind ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 600000)
set_tests_properties(LateInterface.TheExampleForCPrintsAProgram PROPERTIES PASS_REGULAR_EXPRESSION "\nM2")
add_test(NAME LateInterface.TheExampleForCGivesNoProgramPastTheDeadline
  COMMAND late_bind ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 0)
set_tests_properties(LateInterface.TheExampleForCGivesNoProgramPastTheDeadline PROPERTIES
  PASS_REGULAR_EXPRESSION "bound too late: stay retracted and stopped \\(code 5\\)"
  FAIL_REGULAR_EXPRESSION "\nM2")
add_test(NAME LateInterface.TheExampleForCStopsWithoutTools
  COMMAND late_bind ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/one_tool.tbl 5000)
set_tests_properties(LateInterface.TheExampleForCStopsWithoutTools PROPERTIES
  PASS_REGULAR_EXPRESSION "not bound: retract and stop \\(code 4\\)")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/reamer_broken.state "T5 broken\n")
add_test(NAME LateInterface.TheExampleForCStopsWhereTheReamerIsBroken
  COMMAND late_bind ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 600000 ${CMAKE_CURRENT_BINARY_DIR}/reamer_broken.state)
set_tests_properties(LateInterface.TheExampleForCStopsWhereTheReamerIsBroken PROPERTIES
  PASS_REGULAR_EXPRESSION "T5 .is broken.(.|\n)*not bound: retract and stop \\(code 4\\)")
add_test(NAME LateInterface.TheExampleForCBindsEachWorkingstepInItsTurn
  COMMAND late_bind ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 600000 next)
set_tests_properties(LateInterface.TheExampleForCBindsEachWorkingstepInItsTurn PROPERTIES
  PASS_REGULAR_EXPRESSION "workingstep 5 of 5\n" FAIL_REGULAR_EXPRESSION "not bound")

# One session in two threads of a control; its own locks are watched by the thread sanitizer, where no other is.
find_package(Threads REQUIRED)
add_executable(late_threads ${CMAKE_SOURCE_DIR}/examples/late_threads.c)
target_link_libraries(late_threads PRIVATE capstan::late_shared Threads::Threads)
include(CheckCSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -fsanitize=thread)
check_c_source_compiles("int main(void) { return 0; }" CAPSTAN_HAS_THREAD_SANITIZER)
unset(CMAKE_REQUIRED_FLAGS)
if(CAPSTAN_HAS_THREAD_SANITIZER AND NOT CAPSTAN_SANITIZE)
  target_compile_options(late_threads PRIVATE -fsanitize=thread)
  target_link_options(late_threads PRIVATE -fsanitize=thread)
endif()
add_test(NAME LateInterface.AReaderAndABinderShareASession
  COMMAND late_threads ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 600000)
add_test(NAME LateInterface.AReaderStopsTheBindOfAnotherThread
  COMMAND late_threads ${CMAKE_SOURCE_DIR}/examples/plate_bound.p21 generic_vmc
          ${CMAKE_SOURCE_DIR}/tests/door/late/magazine.tbl 600000 stop)
set_tests_properties(LateInterface.AReaderAndABinderShareASession PROPERTIES
  PASS_REGULAR_EXPRESSION "\nM2" FAIL_REGULAR_EXPRESSION "WARNING: ThreadSanitizer;retract and stop"
  SKIP_REGULAR_EXPRESSION "unexpected memory mapping")
# Where all was checked before the screen's thread had its turn, the program is whole.
set_tests_properties(LateInterface.AReaderStopsTheBindOfAnotherThread PROPERTIES
  PASS_REGULAR_EXPRESSION "retract and stop \\(code 4\\);\nM2" FAIL_REGULAR_EXPRESSION "WARNING: ThreadSanitizer"
  SKIP_REGULAR_EXPRESSION "unexpected memory mapping")

# The page for a builder of controls says what the header and the command say.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME LateInterface.ThePageForBuildersSaysWhatTheHeaderSays
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_LIST_DIR}/page_test.py ${CMAKE_SOURCE_DIR} ${CMAKE_C_COMPILER}
          $<TARGET_FILE:capstan>)
set_tests_properties(LateInterface.ThePageForBuildersSaysWhatTheHeaderSays PROPERTIES TIMEOUT 60)
