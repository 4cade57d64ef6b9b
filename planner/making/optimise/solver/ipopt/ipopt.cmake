# Beside the room: the late-binding library does not link it.
option(CAPSTAN_WITH_IPOPT "Optimise with Ipopt" ON)
if(CAPSTAN_WITH_IPOPT)  # Debian: coinor-libipopt-dev; its .pc sets the HAVE_CSTDDEF that it needs
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt)
  target_sources(capstan_optimise_solvers PRIVATE solver/ipopt/backend.cpp)
  target_link_libraries(capstan_optimise_solvers PRIVATE PkgConfig::IPOPT)
else()
  target_sources(capstan_optimise_solvers PRIVATE solver/ipopt/absent.cpp)
endif()
