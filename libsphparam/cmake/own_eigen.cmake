# Gives templates of Eigen in a static library names of its own: cmake -DARCHIVE=… -DNM=… -DOBJCOPY=… -P …
#
# A program that uses Eigen too has templates by the same names, compiled with its own options, and of two
# by one name a linker keeps one for both. With other vectors they agree neither in how memory is allocated
# (a crash) nor, fused or reassociated, in the last bits. Names get an ending, as compilers name clones;
# functions of sphparam keep theirs, whatever they take. So do groups ("n"): of two by one name a linker drops
# one, with the functions in it.
execute_process(COMMAND ${NM} ${ARCHIVE} OUTPUT_VARIABLE symbols ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[ ][VWun] _Z[^\n]*5Eigen[^\n]*" shared "${symbols}")
list(TRANSFORM shared REPLACE "^ . " "")
list(FILTER shared EXCLUDE REGEX "^_Z(Z|GVZ)?NK?8sphparam|\\.sphparam$")
list(REMOVE_DUPLICATES shared)
if(shared)
  list(TRANSFORM shared REPLACE ".+" "\\0 \\0.sphparam\n" OUTPUT_VARIABLE renamed)
  string(JOIN "" renamed ${renamed})
  file(WRITE ${ARCHIVE}.renamed "${renamed}")
  execute_process(COMMAND ${OBJCOPY} --redefine-syms=${ARCHIVE}.renamed ${ARCHIVE}
    COMMAND_ERROR_IS_FATAL ANY)
endif()
