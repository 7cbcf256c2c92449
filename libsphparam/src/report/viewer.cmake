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
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/viewer_notices.txt)
set(SPHPARAM_HAS_VIEWER 0 CACHE INTERNAL "read by tests/package")
if(viewer)
  set(SPHPARAM_HAS_VIEWER 1 CACHE INTERNAL "read by tests/package")
  set(installed ${PROJECT_BINARY_DIR}/share/sphparam/model-viewer)
  file(COPY ${viewer}/dist/model-viewer-umd.min.js DESTINATION ${installed})
  # Its own has no word of what others wrote of it; pages show all of it.
  file(READ ${viewer}/LICENSE licence)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/viewer_notices.txt notices)
  file(CONFIGURE OUTPUT ${installed}/LICENSE CONTENT "${licence}${notices}" @ONLY)
  install(FILES ${installed}/model-viewer-umd.min.js ${installed}/LICENSE COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/sphparam/model-viewer)
else()
  message(WARNING "`sphparam report` will make pages without the 3D viewer: see SPHPARAM_VIEWER")
endif()
