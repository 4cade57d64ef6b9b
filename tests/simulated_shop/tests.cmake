# A shop whose physics is hidden from the tuner: the library, for docs/validation.md takes its figures too.
add_library(capstan_simulated_shop STATIC ${CMAKE_CURRENT_LIST_DIR}/shop.cpp ${CMAKE_CURRENT_LIST_DIR}/campaign.cpp)
target_link_libraries(capstan_simulated_shop
  PUBLIC $<BUILD_INTERFACE:capstan_options> capstan::casebase capstan::optimise capstan::mechanics)
capstan_test(simulated_shop LIBS capstan_simulated_shop)
