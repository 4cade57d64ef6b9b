# cmake --install [--strip], and find_package(capstan) or pkg-config for those who link the result. The folders are
# those of GNUInstallDirs; tests/install/files.txt lists every file.
#
#   libexec/capstan/capstan-brep  what reads the shapes of STEP files for it, where OpenCASCADE is there
#   libexec/capstan/capstan-postgres.so  how servers of PostgreSQL are reached, where libpqxx is there
#   bin/capstan                 the command; share/man/man1 its manual pages, and bash's completion of it
#   lib/libcapstan.so           capstan::capstan, capstan.pc, with include/capstan/capstan.h
#   lib/libcapstan_late.so      capstan::late, capstan_late.pc, the C interface of late binding
#   lib/python3.*/dist-packages/capstan  the module of Python, where pybind11 is there
#   share/capstan/{rules,tooling}/data   what the rules and the catalogue read
#   share/capstan/plan.schema.json       the JSON schema of plans
#   share/doc/capstan           what there is to read, and the examples
include(CMakePackageConfigHelpers)

set(capstan_config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/capstan)
set(capstan_exported "")

if(TARGET capstan_facade)
  list(APPEND capstan_exported capstan_facade)
endif()
# The room `late` is a static library; the shared one around it may have either name.
foreach(target IN ITEMS capstan_late_shared capstan_late)
  if(TARGET ${target})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "SHARED_LIBRARY")
      set_target_properties(${target} PROPERTIES EXPORT_NAME late)
      list(APPEND capstan_exported ${target})
    endif()
  endif()
endforeach()

if(capstan_exported)
  install(TARGETS ${capstan_exported} EXPORT capstan
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT capstan NAMESPACE capstan:: DESTINATION ${capstan_config_folder} FILE capstan-targets.cmake)
  configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/capstan-config.cmake.in
    ${CMAKE_BINARY_DIR}/capstan-config.cmake INSTALL_DESTINATION ${capstan_config_folder}
    PATH_VARS CMAKE_INSTALL_DATADIR)
  # Before 1.0 a minor version may change what callers see.
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/capstan-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/capstan-config.cmake ${CMAKE_BINARY_DIR}/capstan-config-version.cmake
    DESTINATION ${capstan_config_folder})
endif()

# capstan_pkg_config(<library> <description>): a .pc file that finds the rest from where it lies itself, so that an
# installation may be moved.
function(capstan_pkg_config pc_name pc_description)
  file(RELATIVE_PATH pc_up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  string(REGEX REPLACE "/$" "" pc_up "${pc_up}")
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/library.pc.in ${CMAKE_BINARY_DIR}/${pc_name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/${pc_name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
if(TARGET capstan_facade)
  capstan_pkg_config(capstan "${PROJECT_DESCRIPTION}")
endif()
if(TARGET capstan_late_shared)
  capstan_pkg_config(capstan_late "Late binding of process plans inside a control, a C interface")
endif()

install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/capstan DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

if(TARGET capstan)
  install(TARGETS capstan RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# Started by the command, not by people.
if(TARGET capstan-brep)
  install(TARGETS capstan-brep RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/capstan)
endif()
if(TARGET capstan_postgres)  # opened, not linked
  install(TARGETS capstan_postgres LIBRARY DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/capstan)
endif()

if(TARGET capstan_python)
  install(TARGETS capstan_python LIBRARY DESTINATION ${CAPSTAN_PYTHON_DIR}/capstan)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/planner/door/python/capstan DESTINATION ${CAPSTAN_PYTHON_DIR}
    FILES_MATCHING PATTERN *.py)
endif()

if(TARGET capstan_manual_pages)
  install(DIRECTORY ${CAPSTAN_MANUAL_FOLDER}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(DIRECTORY ${CAPSTAN_MANUAL_FOLDER}/completions DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion)
endif()

# What `cmake --install` needs, and no test: `./dev demo` builds this.
add_custom_target(capstan_installed)
foreach(target IN LISTS capstan_exported ITEMS capstan capstan-brep capstan_postgres capstan_python capstan_manual_pages)
  if(TARGET ${target})
    add_dependencies(capstan_installed ${target})
  endif()
endforeach()

# The folders keep their places relative to each other, so one root serves a checkout and an installation.
foreach(folder IN ITEMS rules tooling)
  if(IS_DIRECTORY ${CMAKE_SOURCE_DIR}/${folder}/data)
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder}/data DESTINATION ${CMAKE_INSTALL_DATADIR}/capstan/${folder})
  endif()
endforeach()
install(FILES ${CMAKE_SOURCE_DIR}/docs/plan.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/capstan)
# The texts keep their places relative to README, so that its links hold.
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/LICENSE
  ${CMAKE_SOURCE_DIR}/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs ${CMAKE_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
  PATTERN plan.schema.json EXCLUDE)
