# FBX, COLLADA, 3DS and X3D, by assimp, in a module that is opened when such a file is read; without assimp there is
# none, and such files are refused with what would help.
find_package(assimp QUIET)
if(assimp_FOUND)
  add_library(sphparam_scene_assimp MODULE src/io/assimp/scene_module.cpp)
  target_include_directories(sphparam_scene_assimp PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(sphparam_scene_assimp PRIVATE cxx_std_20)
  target_compile_options(sphparam_scene_assimp PRIVATE ${SPHPARAM_HARDENING})
  target_link_libraries(sphparam_scene_assimp PRIVATE assimp::assimp)
  set_target_properties(sphparam_scene_assimp PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/sphparam)
  add_dependencies(sphparam_io sphparam_scene_assimp)
  install(TARGETS sphparam_scene_assimp LIBRARY DESTINATION lib/sphparam COMPONENT image)
  if(CMAKE_LIBRARY_ARCHITECTURE)
    install(TARGETS sphparam_scene_assimp LIBRARY DESTINATION ${module_of_packages}
      COMPONENT debian_image EXCLUDE_FROM_ALL)
  endif()
endif()
