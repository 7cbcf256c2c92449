# Texts that the library carries, styles and scripts of its pages: embed_texts(TARGET FILE…) makes
# of each src/ROOM/NAME.css a header "embedded/NAME.css.h" with sphparam::embedded::NAME_css. Made
# again when a file changes.
function(embed_texts target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/embedded_texts)
  foreach(path IN LISTS ARGN)
    get_filename_component(file ${path} NAME)
    string(MAKE_C_IDENTIFIER ${file} name)
    file(READ ${CMAKE_CURRENT_SOURCE_DIR}/${path} text)
    configure_file(${CMAKE_CURRENT_SOURCE_DIR}/cmake/embedded_text.h.in
      ${folder}/embedded/${file}.h @ONLY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  endforeach()
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
