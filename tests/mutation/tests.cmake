# Edits of emitted programs: a library of classes and the study over them, for the test and for
# docs/validation.md.
set(mutation ${CMAKE_CURRENT_LIST_DIR})
file(GLOB mutation_sources CONFIGURE_DEPENDS ${mutation}/*.cpp ${mutation}/controls/*.cpp ${mutation}/plans/*.cpp)
list(FILTER mutation_sources EXCLUDE REGEX "_test\\.cpp$")
add_library(capstan_mutation STATIC ${mutation_sources})
target_link_libraries(capstan_mutation
  PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support
  PRIVATE capstan::verify capstan::exchange capstan::json capstan::controls capstan::service capstan::tooling)
capstan_test(mutation DEPENDS verify LIBS capstan_mutation)
