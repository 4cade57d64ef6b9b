# The suites of a test program as tests of ctest, one test a suite; run by capstan_tests_by_suite after linking.
#
# cmake -D PROGRAM=<program> -D NAME=<target> -D OUTPUT=<file> -D REPORTS=<folder> -D PROPERTIES=<list> -P SuitesOfProgram.cmake
#
# A test program begins in some 30 ms: with one process a test that was a third of the whole run.
cmake_policy(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests TIMEOUT 60
  OUTPUT_VARIABLE listed ERROR_VARIABLE said RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests ended with ${status}: ${said}")
endif()
get_filename_component(folder ${OUTPUT} DIRECTORY)

set(text "")
function(enter name filter)
  string(REPLACE "/" "-" report ${NAME}.${name})
  string(REGEX REPLACE "_test$" "/${name}" name ${NAME})  # two programs may name a suite alike
  # One seed for tests that draw: what passes here passes again. `./dev soak` draws others.
  set(command "[==[${PROGRAM}]==] [==[--gtest_filter=${filter}]==] --gtest_random_seed=1 --gtest_brief=1")
  string(APPEND command " [==[--gtest_output=xml:${REPORTS}/${report}.xml]==]")
  set(more "add_test([==[${name}]==] ${command})\n")
  string(APPEND more "set_tests_properties([==[${name}]==] PROPERTIES WORKING_DIRECTORY [==[${folder}]==] ${PROPERTIES})\n")
  set(text "${text}${more}" PARENT_SCOPE)
endfunction()

# A line that begins a suite has its name and a point; a test's line begins with two blanks.
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." lines "\n${listed}")
foreach(line IN LISTS lines)
  string(REGEX MATCH "[A-Za-z0-9_/]+" suite "${line}")
  enter(${suite} "${suite}.*")
endforeach()
file(WRITE ${OUTPUT} "${text}")
