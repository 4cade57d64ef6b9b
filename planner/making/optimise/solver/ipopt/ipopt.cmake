# Beside the room: the late-binding library does not link it.
option(CAPSTAN_WITH_IPOPT "Optimise with Ipopt" ${CAPSTAN_WANTED})
if(CAPSTAN_WITH_IPOPT)  # Debian: coinor-libipopt-dev; its .pc sets the HAVE_CSTDDEF that it needs
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(IPOPT REQUIRED ipopt)
  target_sources(capstan_optimise_solvers PRIVATE solver/ipopt/backend.cpp)
  # Opened when it is needed (ground/base/loading/library.h), so that its header is all that is used here.
  find_library(IPOPT_LIBRARY ipopt REQUIRED HINTS ${IPOPT_LIBRARY_DIRS})
  mark_as_advanced(IPOPT_LIBRARY)
  capstan_loaded_name(name ${IPOPT_LIBRARY})
  target_compile_definitions(capstan_optimise_solvers PRIVATE CAPSTAN_IPOPT_LIBRARY="${name}")
  target_include_directories(capstan_optimise_solvers SYSTEM PRIVATE ${IPOPT_INCLUDE_DIRS})
  target_compile_options(capstan_optimise_solvers PRIVATE ${IPOPT_CFLAGS_OTHER})
else()
  target_sources(capstan_optimise_solvers PRIVATE solver/ipopt/absent.cpp)
endif()
