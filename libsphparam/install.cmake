# What is installed for those who compile against the library: headers, libraries, and the files by
# which CMake and pkg-config find them.
include(CMakePackageConfigHelpers)
# Before 1.0 a minor version may change interfaces.
write_basic_package_version_file(sphparamConfigVersion.cmake COMPATIBILITY SameMinorVersion)

set(installed_targets sphparam_library)
foreach(component IN LISTS SPHPARAM_BUILT)
  list(APPEND installed_targets sphparam_${component})
endforeach()

# A pkg-config file a component, and one of the map alone.
function(install_pkgconfig libdir component)
  set(pkgconfig_dir ${libdir}/pkgconfig)
  file(RELATIVE_PATH prefix_from_pkgconfig /${pkgconfig_dir} /)
  string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${component})
  configure_file(cmake/sphparam.pc.in ${made}/sphparam.pc @ONLY)
  set(files ${made}/sphparam.pc)
  foreach(built IN LISTS SPHPARAM_BUILT)
    set(requires "sphparam = ${PROJECT_VERSION}")
    foreach(other IN LISTS needs_${built})
      string(APPEND requires ", sphparam-${other} = ${PROJECT_VERSION}")
    endforeach()
    get_property(linked GLOBAL PROPERTY sphparam_linked_by_${built})
    list(TRANSFORM linked PREPEND -l)
    if(built STREQUAL image)  # where its module lies
      list(APPEND linked "-Wl,-rpath,\${prefix}/lib/sphparam" "-Wl,-rpath,\${libdir}/sphparam")
    endif()
    list(PREPEND linked -lsphparam_${built})
    list(JOIN linked " " libraries)
    configure_file(cmake/component.pc.in ${made}/sphparam-${built}.pc @ONLY)
    list(APPEND files ${made}/sphparam-${built}.pc)
  endforeach()
  install(FILES ${files} DESTINATION ${pkgconfig_dir} COMPONENT ${component} ${ARGN})
endfunction()

# The libraries that a component is linked with, and those of the components that it is built on.
function(linked_in_all result component)
  get_property(linked GLOBAL PROPERTY sphparam_linked_by_${component})
  foreach(other IN LISTS needs_${component})
    linked_in_all(more ${other})
    list(APPEND linked ${more})
  endforeach()
  list(REMOVE_DUPLICATES linked)
  set(${result} "${linked}" PARENT_SCOPE)
endfunction()

# What a component installs whose libraries are in that folder: every path in it is relative, so that
# the tree can be moved. Further arguments go to all of its install().
function(install_development libdir component runtime)
  set(package_dir ${libdir}/cmake/sphparam)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${component})
  install(TARGETS ${installed_targets} EXPORT sphparam_${component}
    ARCHIVE DESTINATION ${libdir} COMPONENT ${component} ${ARGN}
    LIBRARY DESTINATION ${libdir} COMPONENT ${runtime} NAMELINK_COMPONENT ${component} ${ARGN})
  install(DIRECTORY include/sphparam ${CMAKE_CURRENT_BINARY_DIR}/include/sphparam
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${component} ${ARGN}
    FILES_MATCHING PATTERN *.h)
  install(EXPORT sphparam_${component} NAMESPACE sphparam:: DESTINATION ${package_dir}
    FILE sphparamTargets.cmake COMPONENT ${component} ${ARGN})

  set(components "")
  foreach(built IN LISTS SPHPARAM_BUILT)
    linked_in_all(linked ${built})
    string(APPEND components "set(sphparam_linked_by_${built} \"${linked}\")\n")
  endforeach()
  configure_package_config_file(cmake/sphparamConfig.cmake.in ${made}/sphparamConfig.cmake
    INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
  install(FILES ${made}/sphparamConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/sphparamConfigVersion.cmake
    DESTINATION ${package_dir} COMPONENT ${component} ${ARGN})
  install_pkgconfig(${libdir} ${component} ${ARGN})
endfunction()
install_development(${CMAKE_INSTALL_LIBDIR} development runtime)
# Debian's packages keep libraries by architecture, whatever prefix this build folder is for.
if(CMAKE_LIBRARY_ARCHITECTURE)
  install_development(lib/${CMAKE_LIBRARY_ARCHITECTURE} debian_development debian_runtime
    EXCLUDE_FROM_ALL)
endif()
