# Draco's decoder becomes part of `io`: those of its objects that decode, and no library to link.
# Debian's Draco has a tinygltf of another version in it; linked as a library it would be called in the
# place of ours. Its symbols give way to those of a program that has a Draco of its own.
find_package(draco REQUIRED)
add_library(sphparam_draco OBJECT src/io/formats/gltf/draco/draco_decoding.cpp)
target_include_directories(sphparam_draco PRIVATE src include)
target_include_directories(sphparam_draco SYSTEM PRIVATE
  $<TARGET_PROPERTY:draco::draco_static,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(sphparam_draco PRIVATE Eigen3::Eigen)
target_compile_features(sphparam_draco PRIVATE cxx_std_20)
target_compile_options(sphparam_draco PRIVATE ${SPHPARAM_HARDENING})
set_target_properties(sphparam_draco PROPERTIES POSITION_INDEPENDENT_CODE ON
  INTERPROCEDURAL_OPTIMIZATION OFF)

set(draco_inside ${CMAKE_CURRENT_BINARY_DIR}/draco_inside${CMAKE_CXX_OUTPUT_EXTENSION})
add_custom_command(OUTPUT ${draco_inside}
  COMMAND ${CMAKE_LINKER} -r -o ${draco_inside}
    $<TARGET_OBJECTS:sphparam_draco> $<TARGET_FILE:draco::draco_static>
  COMMAND ${CMAKE_OBJCOPY} --wildcard --weaken-symbol=*5draco* ${draco_inside}
  DEPENDS sphparam_draco $<TARGET_OBJECTS:sphparam_draco>
  COMMENT "Draco's decoder in one object"
  COMMAND_EXPAND_LISTS VERBATIM)
set_source_files_properties(${draco_inside} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
target_sources(sphparam_io PRIVATE ${draco_inside})
