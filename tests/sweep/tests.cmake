# Features x materials x machines: what every plan promises, and how its time compares with a catalogue's.
set(sweep ${CMAKE_CURRENT_LIST_DIR})
add_library(capstan_sweep STATIC ${sweep}/catalogue.cpp ${sweep}/features.cpp ${sweep}/sweep.cpp)
target_link_libraries(capstan_sweep
  PUBLIC $<BUILD_INTERFACE:capstan_options> capstan_test_support
  PRIVATE capstan_drawing capstan::motion capstan::mechanics capstan::verify capstan::service capstan::tooling)
capstan_test(sweep LIBS capstan_sweep capstan::service)
