# The components beside the map: what each is made of, and the libraries that only it needs.
#
# SPHPARAM_COMPONENTS chooses them; what they stand on comes along. Who adds this folder to a project
# of their own gets the map alone unless they ask for more.
set(all_components io image measure render bake remesh wrap correspondence group gltf report asset batch)
set(default_components)
if(PROJECT_IS_TOP_LEVEL)
  set(default_components ${all_components})
endif()
set(SPHPARAM_COMPONENTS "${default_components}" CACHE STRING
  "Components beside the map: ${all_components}")

# What stands on what.
set(needs_io)
set(needs_image io)
set(needs_measure)
set(needs_render io image)
set(needs_bake io image measure render)
set(needs_remesh io image measure)
set(needs_wrap measure)
set(needs_correspondence io measure)
set(needs_group io image measure remesh correspondence)
set(needs_gltf io image measure render bake correspondence)
set(needs_report io image measure render bake remesh wrap correspondence group gltf)
set(needs_asset io image measure render bake remesh wrap correspondence group gltf report)
set(needs_batch io image measure render bake remesh wrap correspondence group gltf report)
set(SPHPARAM_BUILT)
set(asked_for ${SPHPARAM_COMPONENTS})
if(SPHPARAM_BUILD_TOOLS)  # the program is made of all
  set(asked_for ${all_components})
endif()
foreach(component IN LISTS all_components)  # in the order of building
  set(wanted FALSE)
  foreach(other IN LISTS asked_for)
    if(NOT other IN_LIST all_components)
      message(FATAL_ERROR "SPHPARAM_COMPONENTS: no ${other} among ${all_components}")
    endif()
    if(other STREQUAL component OR component IN_LIST needs_${other})
      set(wanted TRUE)
    endif()
  endforeach()
  if(wanted)
    list(APPEND SPHPARAM_BUILT ${component})
  endif()
endforeach()

# A component of rooms. Its libraries are private to it: what is linked here, and after "=" what a
# program that uses the installed, static component links, if anything.
function(add_component component)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ROOMS;LIBRARIES")
  set(sources)
  foreach(room IN LISTS arg_ROOMS)
    file(GLOB_RECURSE room_sources CONFIGURE_DEPENDS src/${room}/*.cpp)
    list(APPEND sources ${room_sources})
  endforeach()
  list(FILTER sources EXCLUDE REGEX "/(oiio|draco|assimp)/")
  set(target sphparam_${component})
  add_library(${target} ${sources})
  add_library(sphparam::${component} ALIAS ${target})
  as_sphparam_library(${target} ${component})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/src>)
  target_link_libraries(${target} PUBLIC sphparam_library)
  foreach(other IN LISTS needs_${component})
    target_link_libraries(${target} PUBLIC sphparam_${other})
  endforeach()
  set(linked)
  foreach(library IN LISTS arg_LIBRARIES)
    string(REGEX MATCH "^([^=]*)=?(.*)$" unused "${library}")
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${CMAKE_MATCH_1}>)
    if(CMAKE_MATCH_2)
      target_link_libraries(${target} PRIVATE $<INSTALL_INTERFACE:${CMAKE_MATCH_2}>)
      list(APPEND linked ${CMAKE_MATCH_2})
    endif()
  endforeach()
  set_property(GLOBAL PROPERTY sphparam_linked_by_${component} "${linked}")
  # They read files from strangers.
  target_compile_options(${target} PRIVATE ${SPHPARAM_HARDENING})
  list(GET SPHPARAM_BUILT 0 first)
  if(component STREQUAL first OR BUILD_SHARED_LIBS)
    target_precompile_headers(${target} PRIVATE ${often_read})
  else()
    target_precompile_headers(${target} REUSE_FROM sphparam_${first})
  endif()
endfunction()

# Debian's packages keep what is compiled by architecture.
set(module_of_packages lib/${CMAKE_LIBRARY_ARCHITECTURE}/sphparam)
set_source_files_properties(src/io/files/modules.cpp PROPERTIES
  COMPILE_DEFINITIONS SPHPARAM_MODULE_OF_PACKAGES="${module_of_packages}")

# What writes texts of records and of scenes is not what takes time.
file(GLOB texts CONFIGURE_DEPENDS src/records/*.cpp src/gltf/usd/*.cpp src/io/files/stored_zip.cpp)
set_source_files_properties(${texts} PROPERTIES
  COMPILE_OPTIONS $<$<CONFIG:Release>:-Os> SKIP_PRECOMPILE_HEADERS ON)

set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # tests and benchmarks use them too
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_SOURCE_DIR}/cmake/modules)
if(io IN_LIST SPHPARAM_BUILT)
  # glTF by tinygltf, its compressed parts by Draco and meshoptimizer; GIFTI read by expat and zlib, written by libgiftiio, which is built on them.
  find_package(TinyGLTF REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(meshoptimizer REQUIRED)
  find_package(EXPAT REQUIRED)
  find_package(ZLIB REQUIRED)
  find_path(GIFTIIO_INCLUDE_DIR gifti/gifti_io.h REQUIRED)
  find_path(NIFTIIO_INCLUDE_DIR nifti1_io.h PATH_SUFFIXES nifti REQUIRED)
  find_library(GIFTIIO_LIBRARY giftiio REQUIRED)
  add_component(io ROOMS io
    LIBRARIES TinyGLTF::TinyGLTF=tinygltf nlohmann_json::nlohmann_json ${GIFTIIO_LIBRARY}=giftiio
      $<LINK_ONLY:meshoptimizer::meshoptimizer>=meshoptimizer EXPAT::EXPAT=expat
      ZLIB::ZLIB=z ${CMAKE_DL_LIBS}=${CMAKE_DL_LIBS})
  # Of meshoptimizer its headers alone: with the macro that it asks users to define, no other component
  # could share the headers that are precompiled here.
  target_include_directories(sphparam_io SYSTEM PRIVATE ${GIFTIIO_INCLUDE_DIR} ${NIFTIIO_INCLUDE_DIR}
    $<TARGET_PROPERTY:meshoptimizer::meshoptimizer,INTERFACE_INCLUDE_DIRECTORIES>)
  include(draco_inside.cmake)
  include(scene_module.cmake)
endif()
if(image IN_LIST SPHPARAM_BUILT)
  add_component(image ROOMS image texture LIBRARIES ${CMAKE_DL_LIBS}=${CMAKE_DL_LIBS})
  include(image_module.cmake)
endif()
if(measure IN_LIST SPHPARAM_BUILT)
  find_package(embree 3.13 REQUIRED)
  add_component(measure ROOMS rays measure LIBRARIES embree=embree3)
endif()
if(render IN_LIST SPHPARAM_BUILT)
  add_component(render ROOMS render)
endif()
if(bake IN_LIST SPHPARAM_BUILT)
  add_component(bake ROOMS bake paint)
endif()
if(remesh IN_LIST SPHPARAM_BUILT)
  find_package(OpenSubdiv REQUIRED MODULE)
  add_component(remesh ROOMS remesh displace LIBRARIES OpenSubdiv::osdCPU=osdCPU)
  # Their eight-lane vectors, as the library's.
  target_compile_options(sphparam_remesh PRIVATE -fno-math-errno -Wno-psabi)
endif()
if(wrap IN_LIST SPHPARAM_BUILT)
  add_component(wrap ROOMS wrap)
endif()
if(correspondence IN_LIST SPHPARAM_BUILT)
  add_component(correspondence ROOMS correspondence)
endif()
if(group IN_LIST SPHPARAM_BUILT)
  add_component(group ROOMS group)
endif()
if(gltf IN_LIST SPHPARAM_BUILT)
  add_component(gltf ROOMS gltf
    LIBRARIES meshoptimizer::meshoptimizer=meshoptimizer nlohmann_json::nlohmann_json)
endif()
if(report IN_LIST SPHPARAM_BUILT)
  add_component(report ROOMS report compare showcase records
    LIBRARIES nlohmann_json::nlohmann_json)
  include(cmake/embed_texts.cmake)
  embed_texts(sphparam_report src/report/page.css src/report/plot.css src/report/viewer.css
    src/report/viewer.js src/showcase/report_page.css)
  include(src/report/viewer.cmake)
endif()
if(asset IN_LIST SPHPARAM_BUILT)
  add_component(asset ROOMS asset LIBRARIES nlohmann_json::nlohmann_json)
endif()
if(batch IN_LIST SPHPARAM_BUILT)
  find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)  # a header: nothing is linked
  add_component(batch ROOMS batch survey LIBRARIES nlohmann_json::nlohmann_json ZLIB::ZLIB=z)
  target_include_directories(sphparam_batch SYSTEM PRIVATE ${XXHASH_INCLUDE_DIR})
  embed_texts(sphparam_batch src/batch/batch_page.css src/batch/batch_page.js)
endif()
