# npm_package(RESULT NAME VERSION SHA256): the folder of a package of npm, fetched by npm and unpacked
# below npm/ in the build tree; empty where there is no npm or no network. Only the bytes of that hash
# are taken.
function(npm_package result name version sha256)
  string(REGEX REPLACE "^@" "" plain_name ${name})
  string(REPLACE "/" "-" plain_name ${plain_name})
  set(folder ${PROJECT_BINARY_DIR}/npm/${plain_name}-${version})
  set(archive ${folder}.tgz)  # as npm names it
  set(${result} ${folder}/package PARENT_SCOPE)
  if(EXISTS ${folder}/package/package.json)
    return()
  endif()
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/npm)
  execute_process(
    COMMAND npm pack ${name}@${version} --silent --pack-destination ${PROJECT_BINARY_DIR}/npm
    RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE complaint TIMEOUT 120)
  if(NOT code EQUAL 0 OR NOT EXISTS ${archive})
    file(REMOVE ${archive})
    message(STATUS "${name} ${version} cannot be had from npm: ${code} ${complaint}")
    set(${result} "" PARENT_SCOPE)
    return()
  endif()
  file(SHA256 ${archive} found)
  if(NOT found STREQUAL sha256)
    file(REMOVE ${archive})
    message(FATAL_ERROR "${name} ${version}: npm sent other bytes (SHA-256 ${found})")
  endif()
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${folder})
endfunction()
