# A simulation of its own of what emitted programs remove, held against parts written by hand.
file(GLOB removal_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp ${CMAKE_CURRENT_LIST_DIR}/*/*.cpp)
list(FILTER removal_sources EXCLUDE REGEX "_test\\.cpp$|/drawing\\.cpp$")
# Parts written as files, for other tests too.
add_library(capstan_drawing STATIC ${CMAKE_CURRENT_LIST_DIR}/drawing.cpp)
target_link_libraries(capstan_drawing PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support)
add_library(capstan_removal STATIC ${removal_sources})
target_link_libraries(capstan_removal PRIVATE $<BUILD_INTERFACE:capstan_options> PUBLIC capstan_test_support
  capstan_drawing capstan::facade)
capstan_test(removal DEPENDS facade LIBS capstan_removal COST 100)
