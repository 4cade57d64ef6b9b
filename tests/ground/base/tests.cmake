capstan_test(base DEPENDS base)
if(TARGET base_test)
  # A library that is not in the folder of the program that opens it.
  add_library(capstan_asks_beside MODULE ${CMAKE_CURRENT_LIST_DIR}/asks_beside.cpp)
  target_link_libraries(capstan_asks_beside PRIVATE $<BUILD_INTERFACE:capstan_options> capstan_base)
  target_link_options(capstan_asks_beside PRIVATE -Wl,--exclude-libs,ALL)
  set_target_properties(capstan_asks_beside PROPERTIES PREFIX "" OUTPUT_NAME asks_beside
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/apart)
  add_dependencies(base_test capstan_asks_beside)
endif()
