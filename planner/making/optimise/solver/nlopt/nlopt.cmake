# In the room itself: the late-binding library optimises with it.
option(CAPSTAN_WITH_NLOPT "Optimise with NLopt" ${CAPSTAN_WANTED})
if(CAPSTAN_WITH_NLOPT)  # Debian: libnlopt-cxx-dev
  find_package(NLopt CONFIG REQUIRED)
  target_sources(capstan_optimise PRIVATE solver/nlopt/backend.cpp)
  target_link_libraries(capstan_optimise PRIVATE ${NLOPT_LIBRARIES})
else()
  target_sources(capstan_optimise PRIVATE solver/nlopt/absent.cpp)
endif()
