# capstan_libexec_from(<variable> <folder>)
#
# The way from an installed folder (CMAKE_INSTALL_FULL_BINDIR, ..._LIBDIR) to libexec/capstan, where lies what is
# opened or run and not linked (ground/base/loading/beside.h): relative, so that an installation may be moved; where
# LIBEXECDIR is an absolute path, and is not moved, that. tests/install runs this alone.
function(capstan_libexec_from variable folder)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBEXECDIR}")
    set(way "${CMAKE_INSTALL_LIBEXECDIR}/capstan")
  else()
    file(RELATIVE_PATH way "${folder}" "${CMAKE_INSTALL_FULL_LIBEXECDIR}/capstan")
  endif()
  set(${variable} "${way}" PARENT_SCOPE)
endfunction()
