# capstan_embed(<target> <namespace> FILES file... [BASE folder] [TREES])
#
# Compiles the text of the files into <target>, so that the program needs no data files beside it. Defines
#
#   namespace <namespace> {
#   std::string_view embedded_file(std::string_view name);  // text; data() is null when there is no such file
#   std::span<const std::string_view> embedded_names();     // in the order given
#   }
#
# which the room declares in a header of its own. A name is the path relative to BASE (default: the current
# folder). Changing a file rebuilds the one generated source. A text must not hold the sequence )capstan".
#
# With TREES the files are YAML, and read while building: a start copies what stands in them and parses nothing.
#
#   std::string_view embedded_tree(std::string_view name);  // for `unpack` of planner/ground/base/tables/data_tree.h;
#                                                           // data() is null when there is no such file
#
# Run as a script (cmake -DOUT= -DNAMESPACE= -DBASE= -DLIST= -P Embed.cmake) it writes that source; LIST is a
# file with one path per line.
if(CMAKE_SCRIPT_MODE_FILE)
  file(STRINGS "${LIST}" files)
  set(names "")
  set(cases "")
  set(count 0)
  foreach(file IN LISTS files)
    file(READ "${file}" text)
    file(RELATIVE_PATH name "${BASE}" "${file}")
    string(APPEND names "    \"${name}\",\n")
    string(APPEND cases "  if (name == \"${name}\") return R\"capstan(${text})capstan\";\n")
    math(EXPR count "${count} + 1")
  endforeach()
  set(source "// Generated from data files; edit those.\n#include <array>\n#include <span>\n#include <string_view>\n\n")
  string(APPEND source "namespace ${NAMESPACE} {\n"
    "std::string_view embedded_file(std::string_view name);\n"
    "std::span<const std::string_view> embedded_names();\n\n"
    "std::string_view embedded_file(std::string_view name) {\n${cases}  return {};\n}\n\n"
    "std::span<const std::string_view> embedded_names() {\n"
    "  static constexpr std::array<std::string_view, ${count}> kNames{\n${names}  };\n  return kNames;\n}\n"
    "}  // namespace ${NAMESPACE}\n")
  file(WRITE "${OUT}" "${source}")
  return()
endif()

set(CAPSTAN_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(capstan_embed target namespace)
  cmake_parse_arguments(ARG "TREES" "BASE" "FILES" ${ARGN})
  if(NOT ARG_BASE)
    set(ARG_BASE ${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  get_filename_component(base ${ARG_BASE} ABSOLUTE)
  set(files "")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(path ${file} ABSOLUTE)
    list(APPEND files ${path})
  endforeach()
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded.txt)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_embedded.cpp)
  string(REPLACE ";" "\n" lines "${files}")
  file(CONFIGURE OUTPUT ${list} CONTENT "${lines}\n" @ONLY)  # touched only when it changes
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DNAMESPACE=${namespace} -DBASE=${base} -DLIST=${list}
            -P ${CAPSTAN_EMBED_SCRIPT}
    DEPENDS ${files} ${list} ${CAPSTAN_EMBED_SCRIPT}
    COMMENT "Embedding the data of ${target}" VERBATIM)
  # A text may be longer than the 65536 bytes that every C++ compiler must take; clang warns, both compilers take it.
  set_source_files_properties(${out} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  target_sources(${target} PRIVATE ${out})
  if(ARG_TREES)
    if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
      message(FATAL_ERROR "The shipped data are read by a program of the build, capstan_pack_trees: set "
        "CMAKE_CROSSCOMPILING_EMULATOR (qemu-aarch64 for arm64), so that it can run here")
    endif()
    if(NOT TARGET capstan_pack_trees)
      find_package(yaml-cpp REQUIRED)
      add_executable(capstan_pack_trees
        ${CMAKE_SOURCE_DIR}/cmake/pack_trees.cpp ${CMAKE_SOURCE_DIR}/tooling/shop/data/tree.cpp)
      target_link_libraries(capstan_pack_trees PRIVATE capstan::base yaml-cpp)
    endif()
    set(trees ${CMAKE_CURRENT_BINARY_DIR}/${target}_trees.cpp)
    add_custom_command(OUTPUT ${trees}
      COMMAND capstan_pack_trees ${trees} ${namespace} ${base} ${files}
      DEPENDS ${files} ${list} capstan_pack_trees
      COMMENT "Reading the data of ${target}" VERBATIM)
    set_source_files_properties(${trees} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
    target_sources(${target} PRIVATE ${trees})
  endif()
endfunction()
