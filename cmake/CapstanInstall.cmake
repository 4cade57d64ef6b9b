# cmake --install, and find_package(capstan) for those who link the result.
#
#   bin/capstan                 the command
#   lib/libcapstan.so           capstan::capstan, with include/capstan/capstan.h
#   lib/libcapstan_late.so      capstan::late, the C interface of late binding, where it is built
#   share/capstan/{rules,tooling}/data   what the rules and the catalogue read
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

install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/capstan DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

if(TARGET capstan)
  set_target_properties(capstan PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS capstan RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# What `cmake --install` needs, and no test: `./dev demo` builds this.
add_custom_target(capstan_installed)
foreach(target IN LISTS capstan_exported ITEMS capstan)
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
foreach(file IN ITEMS LICENSE NOTICE)
  if(EXISTS ${CMAKE_SOURCE_DIR}/${file})
    install(FILES ${CMAKE_SOURCE_DIR}/${file} DESTINATION ${CMAKE_INSTALL_DOCDIR})
  endif()
endforeach()
