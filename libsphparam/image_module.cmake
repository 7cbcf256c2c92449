# Images for programs that must start in milliseconds: the codecs are a module of their own, opened
# on first use. find_package(OpenImageIO) fails on Debian 12 (its target names a folder that is not
# there), pkg-config works.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
add_library(sphparam_image_oiio MODULE src/image/oiio/decoding.cpp src/image/oiio/jpeg.cpp
  src/image/oiio/oiio_module.cpp src/image/oiio/webp_codec.cpp)
target_include_directories(sphparam_image_oiio PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_compile_features(sphparam_image_oiio PRIVATE cxx_std_20)
target_compile_options(sphparam_image_oiio PRIVATE ${SPHPARAM_HARDENING})
target_link_libraries(sphparam_image_oiio PRIVATE PkgConfig::OIIO PkgConfig::WEBP)
get_target_property(oiio_headers PkgConfig::OIIO INTERFACE_INCLUDE_DIRECTORIES)
if(oiio_headers)
  target_include_directories(sphparam_image_oiio SYSTEM PRIVATE ${oiio_headers})
endif()
set_target_properties(sphparam_image_oiio PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/sphparam)  # as seen from bin/ and tests/
add_dependencies(sphparam_image sphparam_image_oiio)
if(NOT PROJECT_IS_TOP_LEVEL)  # programs of another project lie elsewhere: the loader finds it
  target_link_options(sphparam_image INTERFACE
    $<BUILD_INTERFACE:LINKER:-rpath,$<TARGET_FILE_DIR:sphparam_image_oiio>>)
endif()

install(TARGETS sphparam_image_oiio LIBRARY DESTINATION lib/sphparam COMPONENT image)
if(CMAKE_LIBRARY_ARCHITECTURE)
  install(TARGETS sphparam_image_oiio LIBRARY DESTINATION ${module_of_packages}
    COMPONENT debian_image EXCLUDE_FROM_ALL)
endif()
