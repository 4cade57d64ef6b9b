# What every room's target has in common.

add_library(capstan_options INTERFACE)
target_include_directories(capstan_options INTERFACE ${CMAKE_SOURCE_DIR})
# -ffp-contract=off: same input, same bytes, whatever the compiler may fuse.
target_compile_options(capstan_options INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
# `char` is signed on amd64, where everything is tested, and not everywhere.
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(capstan_options INTERFACE -fsigned-char)
endif()
if(CAPSTAN_SANITIZE)
  target_compile_options(capstan_options INTERFACE
    -fsanitize=${CAPSTAN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # A third of GCC's time goes into these. The address sanitizer stops at most of what they find, but not at a wrong
  # alignment or a live object of another type: the preset fuzz, by clang, looks at all of it.
  target_compile_options(capstan_options INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-fno-sanitize=null,alignment,vptr,object-size>)
  target_link_options(capstan_options INTERFACE -fsanitize=${CAPSTAN_SANITIZE})
  # Under the sanitizers GCC 12 takes the standard library's own code (std::regex) for uninitialised; the
  # sanitizer itself, and the build without it, watch what is ours.
  target_compile_options(capstan_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# Where <string> comes precompiled, and under the sanitizers, GCC 12 takes its copies for out of bounds (GCC bugs
# 105329 and 105651). Rooms of the presets that do without either keep these warnings errors.
foreach(warning array-bounds restrict stringop-overflow stringop-overread)
  list(APPEND capstan_falsely_warned $<$<CXX_COMPILER_ID:GNU>:-Wno-${warning}>)
endforeach()

# capstan_precompile(<target> <header>...)
#
# Precompiles headers, and says beside the result what it was made from: that is what ccache then tells one from
# another by (CCACHE_PCH_EXTSUM), for its bytes differ from folder to folder.
function(capstan_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} --version OUTPUT_VARIABLE compiler)
  set(made_from "${compiler}${CMAKE_CXX_FLAGS} ${CMAKE_BUILD_TYPE} ${CAPSTAN_SANITIZE} ${ARGN}\n")
  find_file(CAPSTAN_EXPECTED_HEADER tl/expected.hpp)
  if(CAPSTAN_EXPECTED_HEADER)
    file(SHA256 ${CAPSTAN_EXPECTED_HEADER} sum)
    string(APPEND made_from "${sum}\n")
  endif()
  set(pch ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/cmake_pch.hxx.gch)
  file(WRITE ${pch}.sum "${made_from}")
endfunction()

# What most sources of the rooms include of the standard library, parsed once: it was 40 % of their compile time.
# No header of ours is in it, so that a change rebuilds what includes the change. A source that leans on it
# without including what it names is found by the presets release and fuzz, which do without it.
option(CAPSTAN_PRECOMPILE "Precompile what the rooms include of the standard library" ON)
if(CAPSTAN_PRECOMPILE)
  add_library(capstan_room_pch STATIC ${CMAKE_SOURCE_DIR}/cmake/room_pch.cpp)
  target_link_libraries(capstan_room_pch PRIVATE capstan_options)
  capstan_precompile(capstan_room_pch
    <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <functional> <map> <memory> <optional> <set> <span>
    <string> <string_view> <vector> <tl/expected.hpp>)
endif()

# The preset asan compiles sources of a room together where their names allow it (sources_together.py): what they
# include is parsed once for them all. The preset dev compiles each source alone, so that a change rebuilds what it
# touches, and a source that lacks an include is found. Tests have names of their own in too many namespaces.
option(CAPSTAN_TOGETHER "Compile sources of a room together" OFF)
set(CAPSTAN_MOST_TOGETHER 10)
if(CAPSTAN_TOGETHER)  # these then speak without a cause; dev keeps them errors
  target_compile_options(capstan_options INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
# The sources of a target are noted, and grouped when all rooms are known, so that each header is looked at once.
function(capstan_compile_together target)
  if(NOT CAPSTAN_TOGETHER)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "^/.*\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "/build/")
  foreach(source IN LISTS sources)
    set_property(GLOBAL APPEND_STRING PROPERTY CAPSTAN_SOURCES_TOGETHER "${target} ${source}\n")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
function(capstan_group_sources)
  get_property(noted GLOBAL PROPERTY CAPSTAN_SOURCES_TOGETHER)
  if(NOT noted)
    return()
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(list ${CMAKE_BINARY_DIR}/sources_together.txt)
  file(WRITE ${list} "${noted}")
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_SOURCE_DIR}/cmake/sources_together.py
    ${CAPSTAN_MOST_TOGETHER} ${list} OUTPUT_VARIABLE grouped COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${grouped}")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([^ ]+) ([0-9]+) (.*)$" line "${line}")
    set_source_files_properties(${CMAKE_MATCH_3} TARGET_DIRECTORY ${CMAKE_MATCH_1}
      PROPERTIES UNITY_GROUP ${CMAKE_MATCH_1}_${CMAKE_MATCH_2})
  endforeach()
endfunction()

# capstan_room(<name> [DEPENDS room...] [PRIVATE_LIBS lib...])
#
# One static library of the .cpp files of the current folder and below it. DEPENDS names rooms
# (their headers appear in ours), PRIVATE_LIBS what only a .cpp names.
function(capstan_room name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;PRIVATE_LIBS;EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  foreach(pattern IN LISTS ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${pattern}")
  endforeach()
  if(NOT sources)  # a room of headers only
    set(sources ${CMAKE_CURRENT_BINARY_DIR}/headers_only.cpp)
    file(WRITE ${sources} "")
  endif()
  add_library(capstan_${name} STATIC ${sources})
  add_library(capstan::${name} ALIAS capstan_${name})
  target_link_libraries(capstan_${name} PUBLIC $<BUILD_INTERFACE:capstan_options>)
  foreach(dep IN LISTS ARG_DEPENDS)
    target_link_libraries(capstan_${name} PUBLIC capstan::${dep})
  endforeach()
  if(ARG_PRIVATE_LIBS)
    target_link_libraries(capstan_${name} PRIVATE ${ARG_PRIVATE_LIBS})
  endif()
  capstan_compile_together(capstan_${name})
  if(CAPSTAN_PRECOMPILE)
    target_precompile_headers(capstan_${name} REUSE_FROM capstan_room_pch)
    target_compile_options(capstan_${name} PRIVATE ${capstan_falsely_warned})
  endif()
endfunction()

# capstan_loaded_name(<variable> <library>)
#
# The name by which the system's loader finds a shared library ("libzip.so.4"), for one that is opened when it is
# needed and not linked (ground/base/loading/library.h).
function(capstan_loaded_name variable library)
  execute_process(COMMAND ${CMAKE_READELF} --wide --dynamic ${library} OUTPUT_VARIABLE entries ERROR_QUIET)
  if(NOT entries MATCHES "\\(SONAME\\)[^\n]*\\[([^]\n]+)\\]")
    message(FATAL_ERROR "${library} is no shared library: it states no name by which it is loaded")
  endif()
  set(${variable} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()

# capstan_compile_as_test(<target>)
#
# With the precompiled header of the tests, and with its options. What tests do themselves runs once: less
# optimised, it is compiled in four fifths of the time; under the sanitizers, not at all optimised, in two thirds.
function(capstan_compile_as_test target)
  if(CAPSTAN_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE -O1)
  endif()
  if(NOT target STREQUAL capstan_test_pch)
    target_precompile_headers(${target} REUSE_FROM capstan_test_pch)
  endif()
endfunction()

# capstan_tests_by_suite(<program> [PROPERTIES name value...])
#
# The suites of a test program as tests of ctest (SuitesOfProgram.cmake), found each time it is linked. What each test
# did is in ${CAPSTAN_TEST_REPORTS}.
set(CAPSTAN_TEST_REPORTS ${CMAKE_BINARY_DIR}/reports_of_tests)
function(capstan_tests_by_suite program)
  cmake_parse_arguments(ARG "" "" "PROPERTIES" ${ARGN})
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  string(REPLACE ";" " " properties "${ARG_PROPERTIES}")
  add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${suites} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D NAME=${program} -D OUTPUT=${suites}
      -D REPORTS=${CAPSTAN_TEST_REPORTS} -D "PROPERTIES=${properties}"
      -P ${CMAKE_SOURCE_DIR}/cmake/SuitesOfProgram.cmake)
  # A program that is not built has no tests here, and ctest says so of the program.
  set(listed ${CMAKE_CURRENT_BINARY_DIR}/${program}_tests.cmake)
  file(WRITE ${listed} "if(EXISTS [==[${suites}]==])\n  include([==[${suites}]==])\nelse()\n  add_test(${program}_is_not_built ${program}_is_not_built)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${listed})
endfunction()

# capstan_test(<room> [DEPENDS room...] [LIBS lib...] [COST seconds])
#
# One test program of the *_test.cpp of the caller's folder and below it. COST: what its suites take at most, where
# that is much; the dearest begin first, so that none is waited for at the end.
function(capstan_test room)
  cmake_parse_arguments(ARG "" "COST" "DEPENDS;LIBS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" target ${room})
  add_executable(${target}_test ${sources})
  target_link_libraries(${target}_test PRIVATE
    $<BUILD_INTERFACE:capstan_options> capstan_test_support GTest::gmock GTest::gtest_main ${ARG_LIBS})
  capstan_compile_as_test(${target}_test)
  foreach(dep IN LISTS ARG_DEPENDS)
    target_link_libraries(${target}_test PRIVATE capstan::${dep})
  endforeach()
  set(cost "")
  if(ARG_COST)
    set(cost COST ${ARG_COST})
  endif()
  capstan_tests_by_suite(${target}_test PROPERTIES TIMEOUT 900 ${cost})
endfunction()
