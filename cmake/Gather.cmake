# capstan_gather(<target> NAMESPACE ns INCLUDE header OF type FUNCTION name SUFFIX suffix FILES file...)
#
# Finds what a kind of file offers by the files' names, so that a new one needs no row: each NAME.cpp of FILES defines
#
#   type NAME_suffix();
#
# and <target> gets a source with the function that calls all of them, in the order of their names. INCLUDE declares it
# and the type.
#
#   std::vector<type> name();
function(capstan_gather target)
  cmake_parse_arguments(ARG "" "NAMESPACE;INCLUDE;OF;FUNCTION;SUFFIX" "FILES" ${ARGN})
  set(declared "")
  set(listed "")
  foreach(file IN LISTS ARG_FILES)
    get_filename_component(name ${file} NAME_WE)
    string(APPEND declared "${ARG_OF} ${name}_${ARG_SUFFIX}();\n")
    string(APPEND listed "    ${name}_${ARG_SUFFIX}(),\n")
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/gathered/${ARG_FUNCTION}.cpp)
  file(CONFIGURE OUTPUT ${out} @ONLY CONTENT
"#include \"@ARG_INCLUDE@\"

namespace @ARG_NAMESPACE@ {

@declared@
std::vector<@ARG_OF@> @ARG_FUNCTION@() {
  return {
@listed@  };
}

}  // namespace @ARG_NAMESPACE@
")
  target_sources(${target} PRIVATE ${out})
endfunction()
