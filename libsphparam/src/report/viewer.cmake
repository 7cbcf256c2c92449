# The script that shows models in report pages, as a file beside the program. Without it the pages
# have pictures instead.
include(${PROJECT_SOURCE_DIR}/libsphparam/cmake/modules/NpmPackage.cmake)

set(SPHPARAM_VIEWER "" CACHE PATH
  "Folder of the npm package @google/model-viewer 4.4.0, for builds without network")
set(viewer "${SPHPARAM_VIEWER}")
if(NOT viewer)
  npm_package(viewer @google/model-viewer 4.4.0
    8b621bd58da86cfa9908aaedf5a263d49770d08fc9e04ca661e3019616565f02)
endif()
set(SPHPARAM_HAS_VIEWER 0 CACHE INTERNAL "read by tests/package")
if(viewer)
  set(SPHPARAM_HAS_VIEWER 1 CACHE INTERNAL "read by tests/package")
  foreach(file dist/model-viewer-umd.min.js LICENSE)
    file(COPY ${viewer}/${file} DESTINATION ${PROJECT_BINARY_DIR}/share/sphparam/model-viewer)
    install(FILES ${viewer}/${file} COMPONENT program
      DESTINATION ${CMAKE_INSTALL_DATADIR}/sphparam/model-viewer)
  endforeach()
else()
  message(WARNING "`sphparam report` will make pages without the 3D viewer: see SPHPARAM_VIEWER")
endif()
